#include "render/lights/light_tree.h"

#include "core/color.h"

#include <stdexcept>

namespace candela {

struct LightTree::BinaryNode {
  LightBounds bounds;
  std::uint32_t light = kNone; ///< of a leaf
  std::uint32_t left = kNone, right = kNone;
};

namespace {

/// Relative; a sphere touched by the horizon must not slip below it by rounding.
constexpr float kSphereSlack = 1 + 1e-4f;
/// Keeps what a point light does to a point that it sits on finite.
constexpr float kLeastDistance2 = 1e-30f;

/// The share of irradiance on a facing plane that the point scatters, relative: of light from one direction.
float response(const LightSamplingContext& ctx, vec3 direction) {
  const LobeProxy& lobe = ctx.lobe;
  const float cosine = ctx.cosine_factor(direction);
  if (!ctx.accepts(direction)) return 0;
  const float off = 1 + lobe.sharpness * (1 - glm::dot(direction, ctx.lobe_axis));
  return lobe.diffuse * cosine + lobe.peak / sqr(off);
}
/// Of light from everywhere, whose irradiance is that of an average plane: a surface that transmits gets it
/// on both sides, and a point in a medium four times as much, for it has no cosine.
float mean_response(const LightSamplingContext& ctx) {
  const float sides = ctx.domain == ScatteringDomain::hemisphere ? 1.0f
                      : ctx.domain == ScatteringDomain::sphere   ? 2.0f
                                                                 : 4.0f;
  return sides * (ctx.lobe.diffuse + ctx.lobe.lobe_albedo() * kInvPi);
}

constexpr int kBins = 12;

/// How the lights are best split in two: the bin of an axis that the right half begins with.
struct Split {
  int axis = -1, bin = 0;
};

int bin_of(float value, float lo, float hi) {
  return std::clamp(static_cast<int>(kBins * ((value - lo) / (hi - lo))), 0, kBins - 1);
}

} // namespace

LightTree::LightTree(std::span<const Light> lights, std::span<const std::uint32_t> members,
                     const Progress* progress)
    : places_(lights.size()) {
  std::vector<BinaryNode> leaves;
  double greatest = 0;
  for (std::uint32_t i : members) {
    check_now_and_then(progress, i);
    double strength = 0;
    if (auto bounds = light_bounds(lights[i])) {
      strength = bounds->intensity;
      if (strength > 0) leaves.push_back({*bounds, i, kNone, kNone});
    } else if (strength = light_typical_irradiance(lights[i]); strength > 0) {
      if (unbounded_.size() == kMaxUnboundedLights) throw std::invalid_argument("too many unbounded lights");
      places_[i] = {0, static_cast<std::uint32_t>(kWidth + unbounded_.size())};
      unbounded_.push_back({i, lights[i], {}});
    }
    greatest = std::max(greatest, strength);
  }
  count_ = leaves.size() + unbounded_.size();
  if (count_ == 0) return;
  only_ = leaves.empty() ? unbounded_[0].light : leaves[0].light;
  scale_ = 1 / greatest;
  for (Unbounded& one : unbounded_)
    for (EnvironmentDensity density : {EnvironmentDensity::full, EnvironmentDensity::compensated})
      one.irradiance[density == EnvironmentDensity::compensated] =
          static_cast<float>(light_mean_irradiance(one.what, density) * scale_);
  std::vector<BinaryNode> nodes;
  if (leaves.empty()) {
    nodes_.emplace_back();
  } else {
    std::uint32_t root = build(leaves, nodes, progress);
    flatten(nodes, root, {});
  }
}

/// Splits where the halves' SAOH costs have the least sum, weighted against thin boxes (section 4.4).
std::uint32_t LightTree::build(std::span<BinaryNode> leaves, std::vector<BinaryNode>& nodes,
                               const Progress* progress) {
  if (leaves.size() == 1) {
    nodes.push_back(leaves[0]);
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
  if (progress != nullptr) progress->check();
  Bounds3 centers;
  for (const BinaryNode& leaf : leaves) centers.grow(leaf.bounds.center);
  Split best;
  double least = std::numeric_limits<double>::infinity();
  float longest = max_component(centers.diagonal());
  for (int axis = 0; axis < 3; ++axis) {
    const float lo = centers.lo[axis], hi = centers.hi[axis];
    if (!(hi - lo > 0)) continue;
    std::array<std::optional<LightBounds>, kBins> bins;
    auto add = [](std::optional<LightBounds>& to, const std::optional<LightBounds>& more) {
      if (more) to = to ? merge(*to, *more) : *more;
    };
    for (const BinaryNode& leaf : leaves)
      add(bins[static_cast<std::size_t>(bin_of(leaf.bounds.center[axis], lo, hi))], leaf.bounds);
    std::array<double, kBins> right_cost{};
    std::optional<LightBounds> right, left;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      add(right, bins[b]);
      right_cost[b] = saoh_cost(*right);
    }
    double thinness = static_cast<double>(longest) / static_cast<double>(hi - lo);
    for (std::size_t b = 1; b < kBins; ++b) {
      add(left, bins[b - 1]);
      double cost = thinness * (saoh_cost(*left) + right_cost[b]);
      if (cost < least) least = cost, best = {axis, static_cast<int>(b)};
    }
  }
  std::size_t half = leaves.size() / 2;
  if (best.axis >= 0) {
    const float lo = centers.lo[best.axis], hi = centers.hi[best.axis];
    auto middle = std::partition(leaves.begin(), leaves.end(), [&](const BinaryNode& leaf) {
      return bin_of(leaf.bounds.center[best.axis], lo, hi) < best.bin;
    });
    half = static_cast<std::size_t>(middle - leaves.begin());
  }
  std::uint32_t left = build(leaves.first(half), nodes, progress),
                right = build(leaves.subspan(half), nodes, progress);
  nodes.push_back({merge(nodes[left].bounds, nodes[right].bounds), kNone, left, right});
  return static_cast<std::uint32_t>(nodes.size() - 1);
}

/// Makes a wide node of a binary one by opening the branch whose lights differ most, as long as there is
/// room.
std::uint32_t LightTree::flatten(const std::vector<BinaryNode>& nodes, std::uint32_t root, Place parent) {
  std::vector<std::uint32_t> branches{root};
  while (branches.size() < kWidth) {
    auto widest = branches.end();
    double most = -1;
    for (auto b = branches.begin(); b != branches.end(); ++b)
      if (nodes[*b].light == kNone && saoh_cost(nodes[*b].bounds) > most)
        most = saoh_cost(nodes[*b].bounds), widest = b;
    if (widest == branches.end()) break;
    std::uint32_t right = nodes[*widest].right;
    *widest = nodes[*widest].left;
    branches.insert(widest + 1, right);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back().parent = parent;
  for (std::uint32_t lane = 0; lane < branches.size(); ++lane) {
    const BinaryNode& from = nodes[branches[lane]];
    const LightBounds& b = from.bounds;
    Node& node = nodes_[index];
    node.x[lane] = b.center.x, node.y[lane] = b.center.y, node.z[lane] = b.center.z;
    node.radius[lane] = kSphereSlack * b.radius;
    node.least_d2[lane] = std::max(sqr(node.radius[lane]), kLeastDistance2);
    node.axis_x[lane] = b.axis.x, node.axis_y[lane] = b.axis.y, node.axis_z[lane] = b.axis.z;
    node.cos_o[lane] = b.theta_o < kPi ? std::cos(b.theta_o) : -1;
    node.sin_o[lane] = b.theta_o < kPi ? std::sin(b.theta_o) : 0;
    node.cos_e[lane] = b.theta_e < 0.5f * kPi ? std::cos(b.theta_e) : 0;
    node.other_side[lane] = b.two_sided ? 1.0f : -1.0f;
    node.intensity[lane] = static_cast<float>(b.intensity * scale_);
    if (from.light != kNone) {
      node.below[lane] = from.light;
      node.leaves |= 1u << lane;
      places_[from.light] = {index, lane};
    } else {
      std::uint32_t below = flatten(nodes, branches[lane], {index, lane});
      nodes_[index].below[lane] = below; // the vector may have moved
    }
  }
  return index;
}

float LightTree::importance(const Node& node, const LightSamplingContext& ctx, Importances& out) {
  const bool glossy = ctx.lobe.peak > 0;
  auto with = [&](auto domain) {
    return glossy ? importance_as<true, domain()>(node, ctx, out)
                  : importance_as<false, domain()>(node, ctx, out);
  };
  switch (ctx.domain) {
  case ScatteringDomain::hemisphere: break;
  case ScatteringDomain::sphere:
    return with(std::integral_constant<ScatteringDomain, ScatteringDomain::sphere>());
  case ScatteringDomain::volume:
    return with(std::integral_constant<ScatteringDomain, ScatteringDomain::volume>());
  }
  return with(std::integral_constant<ScatteringDomain, ScatteringDomain::hemisphere>());
}

/// Estimates of what the branches' light contributes to the point (section 4.3, eq. 3; without trigonometry
/// as in pbrt-v4), and their sum. Sines and cosines clamp at 0: cos_minus(a, b) is cos(max(a - b, 0)).
template <bool kGlossy, ScatteringDomain kDomain>
float LightTree::importance_as(const Node& n, const LightSamplingContext& ctx, Importances& out) {
  Lanes w;
  const vec3 p = ctx.position, up = ctx.normal, axis = ctx.lobe_axis;
  const LobeProxy lobe = ctx.lobe;
  for (std::size_t i = 0; i < kWidth; ++i) {
    const float dx = n.x[i] - p.x, dy = n.y[i] - p.y, dz = n.z[i] - p.z; // towards the light
    const float d2 = std::max(dx * dx + dy * dy + dz * dz, kLeastDistance2);
    const float inverse = 1 / std::sqrt(d2);
    const float cosine = (dx * up.x + dy * up.y + dz * up.z) * inverse;
    const float cos_up = kDomain == ScatteringDomain::sphere ? std::abs(cosine) : cosine;
    float cos_w = -(dx * n.axis_x[i] + dy * n.axis_y[i] + dz * n.axis_z[i]) * inverse;
    cos_w = std::max(cos_w, -n.other_side[i] * cos_w);
    const float sin_w = std::sqrt(std::max(1 - cos_w * cos_w, 0.0f));
    const float sin_up = std::sqrt(std::max(1 - cos_up * cos_up, 0.0f));
    // The angle b that the sphere covers: all around for a point in it.
    const float ratio = n.radius[i] * inverse;
    const bool inside = ratio >= 1;
    const float sin_b = select(inside, 0.0f, ratio);
    const float cos_b = select(inside, -1.0f, std::sqrt(std::max(1 - ratio * ratio, 0.0f)));
    // Off the normals: theta_w - theta_o - theta_b at least.
    const bool among = cos_w >= n.cos_o[i];
    const float cos_x = select(among, 1.0f, cos_w * n.cos_o[i] + sin_w * n.sin_o[i]);
    const float sin_x = select(among, 0.0f, sin_w * n.cos_o[i] - cos_w * n.sin_o[i]);
    const float cos_off = select(cos_x >= cos_b, 1.0f, cos_x * cos_b + sin_x * sin_b);
    // And off the point's normal, if it has one.
    const float cos_in = select(cos_up >= cos_b, 1.0f, cos_up * cos_b + sin_up * sin_b);
    const float emitted = select(cos_off >= n.cos_e[i], std::max(cos_off, 0.0f), 0.0f);
    float received = kDomain == ScatteringDomain::volume ? 1.0f : std::max(cos_in, 0.0f);
    if constexpr (kGlossy) {
      const float cos_m = (dx * axis.x + dy * axis.y + dz * axis.z) * inverse;
      const float sin_m = std::sqrt(std::max(1 - cos_m * cos_m, 0.0f));
      const float cos_near = select(cos_m >= cos_b, 1.0f, cos_m * cos_b + sin_m * sin_b);
      const float off = 1 + lobe.sharpness * (1 - cos_near);
      received = select(received > 0, lobe.diffuse * received + lobe.peak / (off * off), 0.0f);
    }
    w[i] = n.intensity[i] * emitted * received / std::max(d2, n.least_d2[i]);
  }
  float sum = 0;
  for (std::size_t i = 0; i < kWidth; ++i) out.each[i] = w[i], out.sum[i] = sum += w[i];
  return sum;
}

float LightTree::root_importance(const LightSamplingContext& ctx, Importances& out) const {
  float sum = importance(nodes_[0], ctx, out);
  for (std::size_t i = 0; i < unbounded_.size(); ++i) {
    float importance_here = unbounded_[i].irradiance[ctx.mis_with_bsdf] * mean_response(ctx);
    if (is_delta_light(unbounded_[i].what)) { // its one sample tells the irradiance
      auto s = sample_light(unbounded_[i].what, ctx, vec2(0));
      if (s)
        importance_here = static_cast<float>(scale_ * static_cast<double>(luminance(s->radiance))) *
                          response(ctx, s->direction);
    }
    out.each[kWidth + i] = importance_here;
    out.sum[kWidth + i] = sum += importance_here;
  }
  return sum;
}

std::optional<LightChoice> LightTree::descend(const LightSamplingContext& ctx, float u) const {
  Importances found;
  float sum = root_importance(ctx, found), pmf = 1;
  std::size_t branches = kWidth + unbounded_.size();
  const Node* node = nodes_.data();
  while (sum > 0) {
    // The first branch whose sum is above u's share; there is one, for u times the whole rounds to less than
    // the whole, and its importance is not 0, for its sum is above its predecessor's.
    const float share = u * sum;
    std::size_t lane = 0;
    for (std::size_t i = 0; i < kWidth; ++i) lane += found.sum[i] <= share ? 1 : 0;
    for (std::size_t i = kWidth; i < branches; ++i) lane += found.sum[i] <= share ? 1 : 0;
    const float importance_here = found.each[lane];
    u = std::clamp((share - (lane > 0 ? found.sum[lane - 1] : 0)) / importance_here, 0.0f, kOneMinusEpsilon);
    pmf *= importance_here / sum;
    if (lane >= kWidth) return LightChoice{unbounded_[lane - kWidth].light, pmf, u};
    if ((node->leaves >> lane & 1) != 0) return LightChoice{node->below[lane], pmf, u};
    node = &nodes_[node->below[lane]];
    branches = kWidth;
    sum = importance(*node, ctx, found);
  }
  return std::nullopt;
}

float LightTree::ascend(const LightSamplingContext& ctx, std::uint32_t light) const {
  Importances found;
  float pmf = 1;
  for (Place at = places_[light]; at.node != kNone; at = nodes_[at.node].parent) {
    float sum = at.node == 0 ? root_importance(ctx, found) : importance(nodes_[at.node], ctx, found);
    if (!(found.each[at.lane] > 0)) return 0;
    pmf *= found.each[at.lane] / sum;
    if (at.node == 0) return pmf;
  }
  return 0;
}

} // namespace candela
