#include "render/world/scene_portals.h"

#include "core/error.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// Cells along a chart's side, and looks along a cell's: about half as many as the panorama has texels,
/// within limits, for a chart takes time to make, and the processor's cache should hold it. A constant light
/// is as even as anything.
struct Resolution {
  int side, lookups;
};
Resolution resolution(const EnvironmentMap* map) {
  constexpr int kLeast = 64, kMost = 256, kLookups = 2, kMostLookups = 8;
  if (map == nullptr) return {kLeast, kLookups};
  // Along the side of half a sphere.
  const auto texels =
      static_cast<int>(std::sqrt(0.5 * static_cast<double>(map->panorama()->image.pixels.size())));
  const int side = std::clamp(texels / kLookups, kLeast, kMost);
  return {side, std::clamp((texels + side - 1) / side, kLookups, kMostLookups)};
}

} // namespace

ScenePortals::ScenePortals(const std::vector<LightDesc>& lights) {
  for (const LightDesc& desc : lights)
    if (const auto* portal = std::get_if<PortalLightModel>(&desc.model))
      if (!is_black(desc.color * desc.scale)) portals_.push_back(portal_rectangle(*portal));
  if (portals_.size() > PortalGuide::kMostPortals)
    throw Error(ExitCode::limit, fmt::format("lights: there are more than {} portals: leave out the smallest",
                                             PortalGuide::kMostPortals));
}

void ScenePortals::give(Light& light, const ScenePortals* previous, const Progress* progress) {
  auto* environment = std::get_if<EnvironmentLight>(&light);
  auto* constant = std::get_if<ConstantLight>(&light);
  if (portals_.empty() || (environment == nullptr && constant == nullptr)) return;
  EnvironmentLight made_for;
  if (environment != nullptr) {
    made_for.map = environment->map, made_for.world_from_map = environment->world_from_map;
    made_for.factor = environment->factor / max_component(environment->factor); // a dimmer keeps the charts
  }
  std::vector<std::shared_ptr<const PortalChart>> charts;
  for (const PortalRectangle& portal : portals_)
    charts.push_back(chart(made_for, portal.axes, previous, progress));
  guides_.push_back(std::make_unique<const PortalGuide>(portals_, charts));
  (environment != nullptr ? environment->portals : constant->portals) = guides_.back().get();
}

const std::shared_ptr<const PortalChart>& ScenePortals::chart(const EnvironmentLight& light,
                                                              const PortalAxes& axes,
                                                              const ScenePortals* previous,
                                                              const Progress* progress) {
  auto fits = [&](const KnownChart& known) {
    return known.chart->axes() == axes && known.light.map == light.map &&
           known.light.world_from_map == light.world_from_map && known.light.factor == light.factor;
  };
  const auto own = std::ranges::find_if(charts_, fits);
  if (own != charts_.end()) return own->chart;
  std::shared_ptr<const PortalChart> made;
  if (previous != nullptr) {
    const auto known = std::ranges::find_if(previous->charts_, fits);
    if (known != previous->charts_.end()) made = known->chart;
  }
  if (!made) {
    const Resolution r = resolution(light.map);
    auto radiance = [&](vec3 direction) {
      return light.map != nullptr ? light.radiance_from(direction) : Spectrum(1);
    };
    made = std::make_shared<const PortalChart>(axes, r.side, r.lookups, radiance, progress);
  }
  return charts_.emplace_back(KnownChart{light, made}).chart;
}

std::size_t ScenePortals::memory_bytes() const {
  std::size_t bytes = 0;
  for (const KnownChart& known : charts_) bytes += known.chart->memory_bytes();
  return bytes;
}

} // namespace candela
