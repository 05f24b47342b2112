#include "core/error.h"
#include "materials/material_parts.h"
#include "render/world/scene_parts.h"

namespace candela {

/// Of bodies that are filled alike. `ior` is 1 where nobody asks for it.
std::uint16_t SceneMaterials::medium_index(const Interior& inside, float ior) {
  const HomogeneousMedium matter = inside.matter.value_or(HomogeneousMedium{inside.absorption});
  const vec3 a = matter.sigma_a, s = matter.sigma_s;
  const auto [entry, is_new] =
      known_media_.try_emplace({inside.medium, std::array{a.x, a.y, a.z, s.x, s.y, s.z, ior}},
                               static_cast<std::uint16_t>(media_.size()));
  if (!is_new) return entry->second;
  const auto desc = std::ranges::find(source_media_, inside.medium, &MediumDesc::name);
  media_.push_back(desc != source_media_.end()
                       ? make_medium(*desc, {inside.absorption, source_estimator_, &grids_})
                       : Medium(matter));
  media_iors_.push_back(ior);
  if (media_.size() >= MediumId::kNone)
    throw Error(ExitCode::limit, "materials: there are more than 65534 different insides: use fewer");
  return entry->second;
}

void SceneMaterials::add_media(const std::vector<const Material*>& materials) {
  std::vector<std::optional<Interior>> interiors;
  bool any = !source_world_.empty();
  for (std::size_t i = 0; i < materials.size(); ++i) {
    std::optional<Interior>& inside = interiors.emplace_back(interior(materials, i));
    if (!inside) continue;
    if (materials_[i].emissive) inside->priority = 0; // light sampling counts on its surface's being there
    has_priorities_ |= inside->priority > 0;
    any |= inside->priority > 0 || !is_black(inside->absorption) || !inside->medium.empty() ||
           inside->matter.has_value();
  }
  if (!any) return;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!interiors[i]) continue;
    const Interior& inside = *interiors[i];
    const std::uint16_t index = medium_index(inside, has_priorities_ ? inside.ior : 1);
    materials_.set_medium_inside(i, {index, static_cast<std::int16_t>(inside.priority)});
  }
  if (!source_world_.empty()) world_medium_ = {medium_index({.medium = source_world_}, 1), 0};
  grids_.trim();
  for (const Medium& medium : media_) {
    has_scattering_ |= medium_scatters(medium);
    has_emission_ |= medium_emits(medium);
  }
}

} // namespace candela
