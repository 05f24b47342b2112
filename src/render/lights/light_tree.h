#pragma once
// Light selection by estimated contribution to a point.

#include "core/progress.h"
#include "lights/light.h"

#include <array>
#include <span>
#include <vector>

namespace candela {

/// A light, drawn at random.
struct LightChoice {
  std::uint32_t light;
  float pmf;
  float u; ///< what is left of the random number, uniform in [0, 1) again
};

/// A tree over lights (Conty Estevez & Kulla 2018; pbrt-v4, section 12.6.3), eight branches a node: sampling
/// descends in proportion to a conservative estimate of each branch's irradiance, eight at a time in vector
/// code; up to eight lights have a branch each. Unbounded lights (without a place, or with another fall-off)
/// are estimated one by one together with the root's branches. For glossy BSDFs, the estimate depends on the
/// least angle between a branch and the lobe's axis: on Veach's plates (tests/bench/versus_cycles) relMSE x
/// spp falls from 0.064 to 0.014.
///
/// Every light that contributes to a point has a probability above 0: only lights are left out that face
/// away, or that are completely on a side from which the point accepts no light
/// (LightSamplingContext::accepts).
class LightTree {
public:
  /// Of lights that light_bounds() has nothing for.
  static constexpr std::size_t kMaxUnboundedLights = 64;

  LightTree() = default;
  /// Over those of `lights` that `members` indexes. Throws std::invalid_argument where too many are
  /// unbounded. Throws Cancelled soon after `progress` is told to end; it may be null.
  LightTree(std::span<const Light> lights, std::span<const std::uint32_t> members,
            const Progress* progress = nullptr);

  /// No light that shines.
  bool empty() const { return count_ == 0; }
  /// Lights that shine.
  std::size_t size() const { return count_; }
  /// A light for u in [0, 1); monotonic in u, in an order that keeps neighbours together. Nothing where none
  /// seems to reach the point, which may be so for some u only.
  std::optional<LightChoice> choose(const LightSamplingContext& ctx, float u) const {
    if (count_ == 1) return LightChoice{only_, 1, u};
    return descend(ctx, u);
  }
  /// Probability of choose() to give a light, which is one of all `lights`.
  float pmf(const LightSamplingContext& ctx, std::uint32_t light) const {
    if (count_ == 1) return light == only_ ? 1.0f : 0.0f;
    return ascend(ctx, light);
  }
  std::size_t memory_bytes() const { return nodes_.size() * sizeof(Node) + places_.size() * sizeof(Place); }

private:
  static constexpr std::size_t kWidth = 8;
  using Lanes = std::array<float, kWidth>;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// A branch of a node, or where there is none, kNone; beyond kWidth come the root's unbounded lights.
  struct Place {
    std::uint32_t node = kNone, lane = 0;
  };
  /// LightBounds of eight branches. Those that there are not have no intensity.
  struct alignas(32) Node {
    Lanes x{}, y{}, z{}, radius{};
    Lanes least_d2{}; ///< what squared distances are taken for at least
    Lanes axis_x{}, axis_y{}, axis_z{}, cos_o{}, sin_o{}, cos_e{};
    Lanes other_side{}; ///< 1 if what looks away shines as well, else -1
    Lanes intensity{};
    std::array<std::uint32_t, kWidth> below{}; ///< a node, or a light where `leaf` has its bit
    std::uint32_t leaves = 0;
    Place parent;
  };
  struct Unbounded {
    std::uint32_t light;
    Light what;
    /// light_mean_irradiance, scaled, by whether the density is compensated.
    std::array<float, 2> irradiance;
  };
  struct BinaryNode;
  /// Importances of branches, and their running sums.
  struct Importances {
    std::array<float, kWidth + kMaxUnboundedLights> each, sum;
  };

  static std::uint32_t build(std::span<BinaryNode> leaves, std::vector<BinaryNode>& nodes,
                             const Progress* progress);
  std::uint32_t flatten(const std::vector<BinaryNode>& nodes, std::uint32_t root, Place parent);
  std::optional<LightChoice> descend(const LightSamplingContext& ctx, float u) const;
  float ascend(const LightSamplingContext& ctx, std::uint32_t light) const;
  static float importance(const Node& node, const LightSamplingContext& ctx, Importances& out);
  template <bool kGlossy, ScatteringDomain kDomain>
  static float importance_as(const Node& node, const LightSamplingContext& ctx, Importances& out);
  float root_importance(const LightSamplingContext& ctx, Importances& out) const;

  std::vector<Node> nodes_; ///< the root first, whatever the lights
  std::vector<Unbounded> unbounded_;
  std::vector<Place> places_; ///< of each light
  std::size_t count_ = 0;     ///< of lights that shine
  std::uint32_t only_ = 0;    ///< the light, if there is but one
  double scale_ = 1;          ///< makes the greatest intensity or irradiance 1, so that no sum overflows
};

} // namespace candela
