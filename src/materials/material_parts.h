#pragma once
// Materials that name others of the scene (blend, two_sided).

#include "materials/material.h"

namespace candela {

/// Combined materials in combined materials, at most.
inline constexpr int kMostNesting = 16;

/// Calls visit(row, index of a material or -1) for each material that this one names.
template <class Visit>
void each_part(const Material& material, Visit visit) {
  if (material.model.index() < std::variant_size_v<ScatteringModel>) return;
  auto& m = const_cast<Material&>(material);
  for (const MaterialField& row : material_fields(material))
    if (row.type == FieldType::material) visit(row, *static_cast<const int*>(row.address(m)));
}

/// Whether `whole` is `part`, or names it, itself or through others. The materials have no cycles.
bool contains_material(std::span<const Material> materials, int whole, int part);

struct PartsProblem {
  std::size_t material; ///< of the row
  std::string_view key; ///< the row's
  std::string cause, remedy;
};
/// The first problem of references among a scene's materials: out of range, a cycle (the cause names it), a
/// null material, more parts or deeper ones than there may be.
std::optional<PartsProblem> parts_problem(std::span<const Material> materials);

/// Of the i-th material: that of its model, or of the first of its parts that has one.
std::optional<Interior> interior(std::span<const Material* const> materials, std::size_t i);

} // namespace candela
