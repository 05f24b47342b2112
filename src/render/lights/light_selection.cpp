#include "render/lights/light_selection.h"

namespace candela {

LightSelection::LightSelection(std::span<const Light> lights, std::span<const std::uint32_t> members,
                               LightChoiceBy how, float scene_radius, const Progress* progress) {
  auto is_unbounded = [&](std::uint32_t i) { return !light_bounds(lights[i]); };
  auto unbounded = static_cast<std::size_t>(std::ranges::count_if(members, is_unbounded));
  by_power_ = how == LightChoiceBy::power || unbounded > LightTree::kMaxUnboundedLights;
  if (by_power_) {
    std::vector<float> power(lights.size(), 0.0f);
    for (std::uint32_t i : members) {
      check_now_and_then(progress, i);
      power[i] = light_power(lights[i], scene_radius);
    }
    powers_ = AliasTable(power);
  } else {
    tree_ = LightTree(lights, members, progress);
  }
}

} // namespace candela
