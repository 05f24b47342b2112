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

/// Irradiance in luminance (W/m^2) of a light without bounds, of those that are the same for all points: on
/// an average plane.
double irradiance_everywhere(const Light& light, EnvironmentAim aim) {
  if (const auto* c = std::get_if<ConstantLight>(&light))
    return static_cast<double>(kPi * luminance(c->radiance));
  if (const auto* e = std::get_if<EnvironmentLight>(&light))
    return 0.25 * static_cast<double>(luminance(e->factor) * e->map->total_luminance(aim));
  return 0;
}

/// Of the others: what they would be, for a scale to judge them by.
double usual_irradiance(const Light& light) {
  if (const auto* d = std::get_if<DirectionalLight>(&light))
    return static_cast<double>(luminance(d->irradiance));
  if (const auto* p = std::get_if<PointLight>(&light)) return static_cast<double>(luminance(p->intensity));
  if (const auto* s = std::get_if<SpotLight>(&light)) return static_cast<double>(luminance(s->intensity));
  return irradiance_everywhere(light, EnvironmentAim::all);
}

/// What the reference makes of irradiance on a facing plane, relative: of light from one direction.
float response(const LightReference& ref, vec3 direction) {
  const Gloss& g = ref.gloss;
  const float cosine = glm::dot(direction, ref.normal), cos_in = std::abs(cosine);
  if (!ref.accepts(cosine)) return 0;
  const float off = 1 + g.sharpness * (1 - glm::dot(direction, ref.mirrored));
  return g.diffuse * cos_in + g.peak / sqr(off);
}
/// Of light from everywhere.
float mean_response(const LightReference& ref) {
  return ref.gloss.diffuse + ref.gloss.lobe_albedo() * kInvPi;
}

constexpr int kBins = 12;

/// How the lights are best cut in two: the bin of an axis that the right half begins with.
struct Cut {
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
    } else if (strength = usual_irradiance(lights[i]); strength > 0) {
      if (apart_.size() == kMostApart) throw std::invalid_argument("too many lights without bounds");
      places_[i] = {0, static_cast<std::uint32_t>(kWidth + apart_.size())};
      apart_.push_back({i, lights[i], {}});
    }
    greatest = std::max(greatest, strength);
  }
  count_ = leaves.size() + apart_.size();
  if (count_ == 0) return;
  only_ = leaves.empty() ? apart_[0].light : leaves[0].light;
  scale_ = 1 / greatest;
  for (Apart& a : apart_)
    for (EnvironmentAim aim : {EnvironmentAim::all, EnvironmentAim::bright})
      a.irradiance[aim == EnvironmentAim::bright] =
          static_cast<float>(irradiance_everywhere(a.what, aim) * scale_);
  std::vector<BinaryNode> nodes;
  if (leaves.empty()) {
    nodes_.emplace_back();
  } else {
    std::uint32_t root = build(leaves, nodes, progress);
    flatten(nodes, root, {});
  }
}

/// Cuts where the halves' spreads have the least sum, weighted against thin boxes (section 4.4).
std::uint32_t LightTree::build(std::span<BinaryNode> leaves, std::vector<BinaryNode>& nodes,
                               const Progress* progress) {
  if (leaves.size() == 1) {
    nodes.push_back(leaves[0]);
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
  if (progress != nullptr) progress->check();
  Bounds3 centers;
  for (const BinaryNode& leaf : leaves) centers.grow(leaf.bounds.center);
  Cut best;
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
      right_cost[b] = spread(*right);
    }
    double thinness = static_cast<double>(longest) / static_cast<double>(hi - lo);
    for (std::size_t b = 1; b < kBins; ++b) {
      add(left, bins[b - 1]);
      double cost = thinness * (spread(*left) + right_cost[b]);
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
      if (nodes[*b].light == kNone && spread(nodes[*b].bounds) > most)
        most = spread(nodes[*b].bounds), widest = b;
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

float LightTree::judge(const Node& node, const LightReference& ref, Weights& weights) {
  const bool glossy = ref.gloss.peak > 0;
  if (ref.transmits)
    return glossy ? judge_as<true, true>(node, ref, weights) : judge_as<false, true>(node, ref, weights);
  return glossy ? judge_as<true, false>(node, ref, weights) : judge_as<false, false>(node, ref, weights);
}

/// Estimates of what the branches' light does at the reference (section 4.3, eq. 3; without trigonometry as
/// in pbrt-v4), and their sum. Sines and cosines clamp at 0: cos_minus(a, b) is cos(max(a - b, 0)).
template <bool kGlossy, bool kTransmits>
float LightTree::judge_as(const Node& n, const LightReference& ref, Weights& weights) {
  Lanes w;
  const vec3 p = ref.position, up = ref.normal, mirrored = ref.mirrored;
  const Gloss gloss = ref.gloss;
  for (std::size_t i = 0; i < kWidth; ++i) {
    const float dx = n.x[i] - p.x, dy = n.y[i] - p.y, dz = n.z[i] - p.z; // towards the light
    const float d2 = std::max(dx * dx + dy * dy + dz * dz, kLeastDistance2);
    const float inverse = 1 / std::sqrt(d2);
    const float cosine = (dx * up.x + dy * up.y + dz * up.z) * inverse;
    const float cos_up = kTransmits ? std::abs(cosine) : cosine; // what is behind is accepted, or is not
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
    // And off the reference's normal.
    const float cos_in = select(cos_up >= cos_b, 1.0f, cos_up * cos_b + sin_up * sin_b);
    const float shine = select(cos_off >= n.cos_e[i], std::max(cos_off, 0.0f), 0.0f);
    float made = std::max(cos_in, 0.0f);
    if constexpr (kGlossy) {
      const float cos_m = (dx * mirrored.x + dy * mirrored.y + dz * mirrored.z) * inverse;
      const float sin_m = std::sqrt(std::max(1 - cos_m * cos_m, 0.0f));
      const float cos_near = select(cos_m >= cos_b, 1.0f, cos_m * cos_b + sin_m * sin_b);
      const float off = 1 + gloss.sharpness * (1 - cos_near);
      made = select(made > 0, gloss.diffuse * made + gloss.peak / (off * off), 0.0f);
    }
    w[i] = n.intensity[i] * shine * made / std::max(d2, n.least_d2[i]);
  }
  float sum = 0;
  for (std::size_t i = 0; i < kWidth; ++i) weights.each[i] = w[i], weights.sum[i] = sum += w[i];
  return sum;
}

float LightTree::judge_root(const LightReference& ref, Weights& weights) const {
  float sum = judge(nodes_[0], ref, weights);
  for (std::size_t i = 0; i < apart_.size(); ++i) {
    float worth = apart_[i].irradiance[ref.also_by_chance] * mean_response(ref);
    if (is_delta_light(apart_[i].what)) { // there is one sample, and it tells all
      auto s = sample_light(apart_[i].what, ref, vec2(0));
      if (s)
        worth = static_cast<float>(scale_ * static_cast<double>(luminance(s->radiance))) *
                response(ref, s->direction);
    }
    weights.each[kWidth + i] = worth;
    weights.sum[kWidth + i] = sum += worth;
  }
  return sum;
}

std::optional<LightChoice> LightTree::descend(const LightReference& ref, float u) const {
  Weights weights;
  float sum = judge_root(ref, weights), pmf = 1;
  std::size_t branches = kWidth + apart_.size();
  const Node* node = nodes_.data();
  while (sum > 0) {
    // The first branch whose sum is above u's share; there is one, for u times the whole rounds to less than
    // the whole, and it is worth something, for its sum is above its predecessor's.
    const float share = u * sum;
    std::size_t lane = 0;
    for (std::size_t i = 0; i < kWidth; ++i) lane += weights.sum[i] <= share ? 1 : 0;
    for (std::size_t i = kWidth; i < branches; ++i) lane += weights.sum[i] <= share ? 1 : 0;
    const float worth = weights.each[lane];
    u = std::clamp((share - (lane > 0 ? weights.sum[lane - 1] : 0)) / worth, 0.0f, kOneMinusEpsilon);
    pmf *= worth / sum;
    if (lane >= kWidth) return LightChoice{apart_[lane - kWidth].light, pmf, u};
    if ((node->leaves >> lane & 1) != 0) return LightChoice{node->below[lane], pmf, u};
    node = &nodes_[node->below[lane]];
    branches = kWidth;
    sum = judge(*node, ref, weights);
  }
  return std::nullopt;
}

float LightTree::ascend(const LightReference& ref, std::uint32_t light) const {
  Weights weights;
  float pmf = 1;
  for (Place at = places_[light]; at.node != kNone; at = nodes_[at.node].parent) {
    float sum = at.node == 0 ? judge_root(ref, weights) : judge(nodes_[at.node], ref, weights);
    if (!(weights.each[at.lane] > 0)) return 0;
    pmf *= weights.each[at.lane] / sum;
    if (at.node == 0) return pmf;
  }
  return 0;
}

} // namespace candela
