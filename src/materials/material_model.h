#pragma once
// The interface of all models of materials. One model is one file of this folder, and an entry of the list in
// materials/material.h.
//
//   kName        what files call it
//   rows()       an std::array of ModelRow, one for each of its values
//   closure(at)  the closure of bsdf/ at a hit: at(parameter) is the value of a parameter there
//
// A model whose inside light may enter also has:
//
//   absorption   sigma_a of the inside, 1/scene unit
//   ior          index of refraction of the inside (optional)
//   priority     which body fills the place where several overlap (optional, with ior)
//
// or, if the inside is a medium that follows from its values, matter(): that medium, or nothing.

#include "materials/parameter.h"

#include <array>
#include <variant>

namespace candela {

/// The row of one value of a model.
template <class Model>
struct ModelRow : FieldInfo {
  /// A parameter may be a texture; a plain value is the same everywhere.
  std::variant<NumberParameter Model::*, ColorParameter Model::*, vec3 Model::*, bool Model::*, int Model::*>
      member;
  /// Whether it means the same as other models' values of the same key, so that a change of the type keeps
  /// it.
  bool kept = true;
};

// The rows that several models have alike.

constexpr FieldInfo reflectance_row(std::string_view key, std::string_view help) {
  return {key, FieldType::color, 0, 1, "", help};
}

} // namespace candela
