#pragma once
// The values of bodies that light enters, which several materials have alike.

#include "materials/material_model.h"

namespace candela {

constexpr FieldInfo interior_ior_row() {
  return {"ior", FieldType::real,
          0.1,   10,
          "",    "Index of refraction, inside over outside; with a priority, over vacuum"};
}
constexpr FieldInfo crossing_row() {
  return {"transmittance", FieldType::color, 0, 1, "", "Tint of each crossing of the surface"};
}
constexpr FieldInfo absorption_row() {
  return {"absorption",
          FieldType::color,
          0,
          1e6,
          "1/scene unit",
          "Absorption coefficient inside (Beer-Lambert): transmittance over d is exp(-absorption d)",
          Invalidates::image,
          {},
          true};
}
constexpr FieldInfo priority_row() {
  return {"priority",
          FieldType::integer,
          0,
          1000,
          "",
          "Which body fills the place where several overlap, such as ice in water: the one of highest "
          "priority; surfaces of the others inside it are skipped. With a priority, ior is over vacuum "
          "(of a textured one, its factor). 0: no surface is skipped and ior is inside over outside, as "
          "for emitting surfaces"};
}

} // namespace candela
