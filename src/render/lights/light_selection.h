#pragma once
// Light selection for next-event estimation.

#include "render/lights/light_tree.h"
#include "sampling/distribution.h"
#include "scene/document.h"

namespace candela {

/// Selects among some of a scene's lights, according to path.light_choice: in proportion to power, or to the
/// estimated contribution to the shading point. Lights of which too many are unbounded (kMaxUnboundedLights)
/// are chosen by power in any case.
class LightSelection {
public:
  LightSelection() = default;
  /// Among those of `lights` that `members` indexes, in a scene of the given radius. Throws Cancelled soon
  /// after `progress` is told to end; it may be null.
  LightSelection(std::span<const Light> lights, std::span<const std::uint32_t> members, LightChoiceBy how,
                 float scene_radius, const Progress* progress = nullptr);

  /// Nothing that shines.
  bool empty() const { return by_power_ ? powers_.empty() : tree_.empty(); }
  /// Whether the choice depends on the shading point.
  bool depends_on_context() const { return !by_power_ && tree_.size() > 1; }
  /// A light for u in [0, 1), monotonic in u but for choices by power; nothing where none seems to reach the
  /// point.
  std::optional<LightChoice> choose(const LightSamplingContext& ctx, float u) const {
    if (!by_power_) return tree_.choose(ctx, u);
    AliasTable::Sample s = powers_.sample(u);
    return LightChoice{s.index, s.pmf, s.u};
  }
  /// Probability with which choose() gives a light.
  float pmf(const LightSamplingContext& ctx, std::uint32_t light) const {
    if (!by_power_) return tree_.pmf(ctx, light);
    return powers_.empty() ? 0 : powers_.pmf(light);
  }
  std::size_t memory_bytes() const { return tree_.memory_bytes(); }

private:
  bool by_power_ = false;
  AliasTable powers_;
  LightTree tree_;
};

} // namespace candela
