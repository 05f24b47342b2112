#include "scene/light_layers.h"

#include <fmt/format.h>

namespace candela {

namespace {

bool may_shine(const Material& material) {
  const ColorParameter& emission = material.emission;
  return emission.is_textured() || emission.value != vec3(0);
}

/// Of the scene, whatever the settings.
LightLayers layers_of(const SceneDesc& scene) {
  LightLayers layers;
  layers.names = used_group_names(scene);
  if (layers.names.empty() || layers.names.size() > kMostLiveGroups) return layers;
  auto layer = [&](const std::string& group) {
    const auto at = group.empty() ? layers.names.end() : std::ranges::find(layers.names, group);
    return static_cast<std::uint8_t>(at - layers.names.begin());
  };
  for (const MediumDesc& medium : scene.media) layers.has_rest |= medium.emission != vec3(0);
  for (const LightDesc& light : scene.lights) {
    layers.has_rest |= light.group.empty();
    layers.of_light.push_back(layer(light.group));
  }
  for (const Material& material : scene.materials) {
    layers.has_rest |= material.group.empty() && may_shine(material);
    layers.of_material.push_back(layer(material.group));
  }
  return layers;
}

/// layers_problem() of the document with these layers.
std::string problem_of(const Document& document, const LightLayers& layers) {
  const RenderSettings& settings = document.settings;
  if (layers.empty()) return "no light belongs to a group; give lights or materials a \"group\"";
  if (settings.film.light_groups == LightGroupsIn::scene) return "film.light_groups is scene; set it to film";
  if (accumulated_view(settings.view) != View::radiance || settings.integrator == Integrator::ao)
    return "the picture shows no radiance; set view = radiance, and another integrator than ao";
  if (settings.adaptive.error > 0)
    return "adaptive sampling stops pixels for one mix of them; set adaptive.error = 0";
  if (layers.names.size() > kMostLiveGroups)
    return fmt::format("there are {} groups; use {} at most", layers.names.size(), kMostLiveGroups);
  const std::size_t bytes = static_cast<std::size_t>(settings.film.width) *
                            static_cast<std::size_t>(settings.film.height) *
                            layer_bytes_per_pixel(layers.count());
  if (bytes > kMostLayerBytes)
    return fmt::format("{} layers of {}x{} pixels take {:.1f} GB, more than {:.1f}; use fewer groups or a "
                       "smaller picture",
                       layers.count(), settings.film.width, settings.film.height,
                       1e-9 * static_cast<double>(bytes), 1e-9 * static_cast<double>(kMostLayerBytes));
  return {};
}

} // namespace

LightLayers light_layers(const Document& document) {
  LightLayers layers = layers_of(document.scene);
  return problem_of(document, layers).empty() ? layers : LightLayers();
}

std::string layers_problem(const Document& document) {
  return problem_of(document, layers_of(document.scene));
}

LightMix light_mix(const SceneDesc& scene, const LightLayers& layers) {
  LightMix mix;
  for (const std::string& name : layers.names) mix.push_back(light_factor(scene, name));
  if (layers.has_rest) mix.push_back(light_factor(scene, ""));
  return mix;
}

bool is_plain(const LightMix& mix) {
  return std::ranges::all_of(mix, [](vec3 factor) { return factor == vec3(1); });
}

Invalidates compare_light_groups(const Document& before, const Document& after) {
  const SceneDesc &a = before.scene, &b = after.scene;
  const bool same_factors = a.light_groups == b.light_groups;
  const bool same_members =
      std::ranges::equal(a.materials, b.materials, {}, &Material::group, &Material::group) &&
      std::ranges::equal(a.lights, b.lights, {}, &LightDesc::group, &LightDesc::group);
  if (same_factors && same_members) return Invalidates::nothing;
  const LightLayers layers = light_layers(after);
  if (light_layers(before) != layers) return Invalidates::scene;
  if (!layers.empty()) return same_factors ? Invalidates::nothing : Invalidates::display;
  return has_scaled_groups(a) || has_scaled_groups(b) ? Invalidates::scene : Invalidates::nothing;
}

} // namespace candela
