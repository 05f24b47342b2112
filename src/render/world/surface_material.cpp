#include "render/world/surface_material.h"

#include "materials/material_parts.h"

namespace candela {

namespace {

bool is_common(const Material& material, const ParameterRef& parameter) {
  return parameter.number == &material.opacity || parameter.number == &material.bump ||
         parameter.color == &material.emission || parameter.color == &material.normal_map;
}

/// The value of a parameter, whose use names a lookup of the model.
struct ParameterAt {
  const TexturedModel& textured;
  const TexturePoint& point;

  template <class T>
  T operator()(const Parameter<T>& parameter) const {
    if (!parameter.is_textured()) return parameter.value;
    const TexturedParameter& lookup = textured.lookups[static_cast<std::size_t>(parameter.use.texture)];
    if constexpr (std::is_same_v<T, float>)
      return lookup.number(point);
    else
      return lookup.color(point);
  }
};

Bsdf closure_at(const TexturedModel& textured, const TexturePoint& point) {
  return with_closure(textured.model, ParameterAt{textured, point},
                      [](const auto& closure) { return Bsdf(closure); });
}

/// Adds the closures of a blend of that weight, and those of blends in it, unless they have no share here.
void mix_parts(const TexturedModel& blend, float weight, const TexturePoint& point, std::span<BlendPart> out,
               std::uint32_t& count) {
  const auto& model = std::get<BlendMaterial>(blend.model);
  const float second = std::clamp(ParameterAt{blend, point}(model.weight), 0.0f, 1.0f);
  for (std::size_t k = 0; k < 2; ++k) {
    const float share = weight * (k == 0 ? 1 - second : second);
    if (!(share > 0)) continue;
    const TexturedModel* part = blend.parts[k];
    if (part != nullptr && part->mixed > 0)
      mix_parts(*part, share, point, out, count);
    else
      out[count++] = {part != nullptr ? closure_at(*part, point) : Bsdf(Blend()), share};
  }
}

Bsdf mixture_at(const TexturedModel& blend, const TexturePoint& point, BlendArena& arena) {
  const std::span<BlendPart> parts = arena.allocate(blend.mixed);
  std::uint32_t count = 0;
  mix_parts(blend, 1, point, parts, count);
  if (count == 1) return parts[0].bsdf; // a mask, mostly
  return Blend{parts.data(), count};
}

/// The material on whose side `material` is seen; null where that side has none.
const Material* seen_side(const Material* material, bool outside, std::span<const Material> all) {
  while (const auto* sides = std::get_if<TwoSidedMaterial>(&material->model)) {
    const int side = outside ? sides->front : sides->back;
    if (side < 0) return nullptr;
    material = &all[static_cast<std::size_t>(side)];
  }
  return material;
}

/// Whether it looks different from either side.
bool has_sides(const Material& material, std::span<const Material> all) {
  bool found = std::holds_alternative<TwoSidedMaterial>(material.model);
  each_part(material, [&](const MaterialField&, int part) {
    found |= part >= 0 && has_sides(all[static_cast<std::size_t>(part)], all);
  });
  return found;
}

} // namespace

Bsdf make_bsdf(const Material& material) {
  return with_closure(
      material.model, [](const auto& parameter) { return parameter.value; },
      [](const auto& closure) { return Bsdf(closure); });
}

Bsdf evaluate_bsdf(const SurfaceMaterial& material, const TexturePoint& point, BlendArena& arena) {
  const TexturedModel& textured = *material.textured;
  return textured.mixed == 0 ? closure_at(textured, point) : mixture_at(textured, point, arena);
}

TexturedParameter SurfaceMaterials::textured_parameter(const MaterialField& row,
                                                       const ParameterRef& parameter, const Sources& from) {
  TexturedParameter out;
  out.use = parameter.use();
  out.texture = from.textures[static_cast<std::size_t>(out.use.texture)].get();
  out.factor = parameter.number != nullptr ? vec3(parameter.number->value) : parameter.color->value;
  out.offset = parameter.number != nullptr ? vec3(parameter.number->offset) : parameter.color->offset;
  out.lowest = static_cast<float>(row.minimum);
  out.highest = static_cast<float>(row.maximum);
  const ImageTexture* image = out.texture->image();
  if (out.is_filtered() && image != nullptr && from.pyramids)
    out.pyramid = from.pyramids(*image, out.use.color_space);
  filters_textures_ |= out.is_filtered();
  return out;
}

TexturedModel SurfaceMaterials::textured_model(const Material& material, const Sources& from) {
  Material numbered = material; // whose uses name lookups rather than textures
  TexturedModel out;
  each_parameter(numbered, [&](const MaterialField& row, const ParameterRef& parameter) {
    if (parameter.use().texture < 0 || is_common(numbered, parameter)) return;
    const TexturedParameter lookup = textured_parameter(row, parameter, from);
    out.is_filtered |= lookup.is_filtered();
    out.asks_place |= lookup.asks_place();
    parameter.use().texture = static_cast<int>(out.lookups.size());
    out.lookups.push_back(lookup);
  });
  out.model = numbered.model;
  return out;
}

const TexturedModel* SurfaceMaterials::blend_part(int index, bool outside, const Sources& from,
                                                  BlendTraits& traits) {
  const Material* part =
      index < 0 ? nullptr : seen_side(&from.all[static_cast<std::size_t>(index)], outside, from.all);
  if (part == nullptr) return nullptr;
  if (std::holds_alternative<BlendMaterial>(part->model)) return blend_model(*part, outside, from, traits);
  const TexturedModel* model = &models_.emplace_back(textured_model(*part, from));
  const Bsdf constant = make_bsdf(*part);
  const bool textured = !model->lookups.empty();
  const std::optional<Interior> inside = interior(part->model);
  traits.textured |= textured;
  traits.oriented |= textured ? has_tangent(constant) : is_anisotropic(constant);
  traits.has_priority |= inside && inside->priority > 0;
  return model;
}

const TexturedModel* SurfaceMaterials::blend_model(const Material& blend, bool outside, const Sources& from,
                                                   BlendTraits& traits) {
  const auto& names = std::get<BlendMaterial>(blend.model);
  TexturedModel model = textured_model(blend, from);
  traits.textured |= !model.lookups.empty();
  model.parts = {blend_part(names.first, outside, from, traits),
                 blend_part(names.second, outside, from, traits)};
  for (const TexturedModel* part : model.parts) {
    model.mixed += part != nullptr ? std::max<std::size_t>(part->mixed, 1) : 1;
    model.is_filtered |= part != nullptr && part->is_filtered;
    model.asks_place |= part != nullptr && part->asks_place;
  }
  return &models_.emplace_back(std::move(model));
}

void SurfaceMaterials::set_blend(SurfaceMaterial& out, const Material& blend, bool outside,
                                 const Sources& from) {
  BlendTraits traits;
  const TexturedModel* model = blend_model(blend, outside, from, traits);
  out.oriented = traits.oriented;
  // What depends on the hit is made there, parts included, so that each hit may change its own.
  if (traits.textured || traits.oriented || traits.has_priority)
    out.textured = model;
  else
    out.bsdf = mixture_at(*model, vec2(0), constant_parts_);
}

void SurfaceMaterials::set_scattering(SurfaceMaterial& out, const Material& material, bool outside,
                                      const Sources& from) {
  const Material* side = seen_side(&material, outside, from.all);
  if (side == nullptr) {
    out.bsdf = Blend();
    set_relief(out, material, from);
    return;
  }
  if (std::holds_alternative<BlendMaterial>(side->model)) {
    set_blend(out, *side, outside, from);
  } else {
    out.bsdf = make_bsdf(*side);
    TexturedModel textured = textured_model(*side, from);
    if (!textured.lookups.empty()) out.textured = &models_.emplace_back(std::move(textured));
    // Of one with textures nobody knows before the hit.
    out.oriented = out.textured != nullptr ? has_tangent(out.bsdf) : is_anisotropic(out.bsdf);
  }
  const auto* subsurface = std::get_if<Subsurface>(&out.bsdf);
  out.diffuses = subsurface != nullptr && subsurface->method != SubsurfaceMethod::random_walk;
  out.varies = out.textured != nullptr || out.oriented || out.diffuses;
  const bool has_relief = side->normal_map.is_textured() || side->bump.is_textured();
  set_relief(out, has_relief ? *side : material, from);
}

void SurfaceMaterials::set_relief(SurfaceMaterial& out, const Material& material, const Sources& from) {
  auto& m = const_cast<Material&>(material);
  for (const MaterialField& row : common_material_fields()) {
    if (row.parameter == nullptr) continue;
    const ParameterRef parameter = row.parameter(m);
    if (parameter.use().texture < 0) continue;
    if (parameter.color == &m.normal_map)
      out.normal_texture = keep(textured_parameter(row, parameter, from));
    else if (parameter.number == &m.bump)
      out.bump_texture = keep(textured_parameter(row, parameter, from));
  }
}

void SurfaceMaterials::set_common(SurfaceMaterial& out, const Material& material, const Sources& from) {
  out.invisible = is_null(material);
  if (out.invisible) {
    out.opacity = 0;
    return;
  }
  auto& m = const_cast<Material&>(material);
  for (const MaterialField& row : common_material_fields()) {
    if (row.parameter == nullptr) continue;
    const ParameterRef parameter = row.parameter(m);
    if (parameter.use().texture < 0) continue;
    if (parameter.number == &m.opacity)
      out.opacity_texture = keep(textured_parameter(row, parameter, from));
    else if (parameter.color == &m.emission)
      out.emission_texture = keep(textured_parameter(row, parameter, from));
  }
  out.opacity = material.opacity.value;
  out.emission = material.emission.value;
  out.emissive = !is_black(material.emission.value) ||
                 (out.emission_texture != nullptr && max_component(material.emission.offset) > 0);
  out.two_sided_emission = material.two_sided_emission;
}

SurfaceMaterial SurfaceMaterials::made(const Material& material, bool outside, const Sources& from) {
  SurfaceMaterial out;
  set_scattering(out, material, outside, from);
  set_common(out, material, from);
  out.is_textured = out.textured != nullptr || out.has_relief();
  out.asks_place = out.textured != nullptr && out.textured->asks_place;
  for (const TexturedParameter* lookup :
       {out.emission_texture, out.opacity_texture, out.normal_texture, out.bump_texture})
    out.asks_place |= lookup != nullptr && lookup->asks_place();
  return out;
}

void SurfaceMaterials::add(const Material& material,
                           const std::vector<std::shared_ptr<const Texture>>& textures,
                           const MipPyramidSource& pyramids, std::span<const Material> all) {
  const Sources from{textures, pyramids, all};
  SurfaceMaterial& out = materials_.emplace_back(made(material, true, from));
  if (has_sides(material, all)) out.back = &backs_.emplace_back(made(material, false, from));
}

void SurfaceMaterials::set_medium_inside(std::size_t i, MediumId medium) {
  auto set = [&](SurfaceMaterial& material) {
    material.media.inside = medium;
    material.varies |= medium.priority > 0;
  };
  set(materials_[i]);
  if (materials_[i].back != nullptr) set(*materials_[i].back);
}

std::size_t SurfaceMaterials::memory_bytes() const {
  return (materials_.size() + backs_.size()) * sizeof(SurfaceMaterial) + constant_parts_.memory_bytes() +
         models_.size() * sizeof(TexturedModel) + parameters_.size() * sizeof(TexturedParameter);
}

} // namespace candela
