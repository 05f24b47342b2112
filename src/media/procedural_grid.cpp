#include "media/procedural_grid.h"

#include "core/noise.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace candela {

namespace {

struct Matter {
  float density = 0, temperature = 0;
};

/// 0 up to 0, 1 from `width` on.
float ramp(float x, float width) { return glm::smoothstep(0.0f, width, x); }

/// 0 at the faces of the box [-half, half], 1 from `width` inside of them on.
float inside_box(vec3 p, vec3 half, float width) { return ramp(min_component(half - glm::abs(p)), width); }

std::uint32_t seed_of(const ProceduralGrid& desc, std::uint32_t use) {
  return hash32(static_cast<std::uint32_t>(desc.seed) * 4u + hash32(use));
}

// A pattern is made of its description. half() is half of its box; at(p) is what is at a place in it.

/// A heap of puffs on a flat base, whose surface is moved in and out by ever smaller round billows.
class CumulusPattern {
public:
  static constexpr vec3 kProportions{1, 0.6f, 0.8f};

  explicit CumulusPattern(const ProceduralGrid& desc) : desc_(desc) {
    const float large = 0.75f + 0.5f * desc.coverage;
    for (std::uint32_t i = 0; i < kPuffs; ++i) {
      const auto random = [&](std::uint32_t use) { return to_unit_float(seed_of(desc, 100 + 8 * i + use)); };
      // Those near the middle are larger and higher.
      const float around = 2 * kPi * (static_cast<float>(i) * 0.618034f + 0.25f * random(0));
      const float out = std::sqrt((static_cast<float>(i) + 0.5f) / kPuffs);
      const float radius = large * (0.4f - 0.2f * out) * (0.75f + 0.5f * random(1));
      const float height = (1 - out) * 0.6f * random(2) * large;
      puffs_[i] = {vec3(0.72f * out * std::cos(around), kBase + 0.5f * radius + height,
                        0.55f * out * std::sin(around)),
                   radius};
    }
  }

  Matter at(vec3 p) const {
    if (p.y < kBase - 0.05f) return {};
    // The base is a little uneven.
    const std::uint32_t seed = seed_of(desc_, 1);
    float inside = -10; // > 0: distance to the surface of the heap
    for (const Puff& puff : puffs_) {
      const float d = puff.radius - glm::distance(p, puff.center);
      const float h = std::clamp(0.5f + 0.5f * (inside - d) / kBlend, 0.0f, 1.0f); // a smooth maximum
      inside = glm::mix(d, inside, h) + kBlend * h * (1 - h);
    }
    const float f = 0.5f * desc_.frequency, bump = 0.75f / std::max(desc_.frequency, 1.0f);
    if (inside < -1.6f * bump) return {};
    const vec3 warp(gradient_noise(f * p, seed + 1), gradient_noise(f * p, seed + 2),
                    gradient_noise(f * p, seed + 3));
    const vec3 q = p + (0.12f / std::max(f, 0.5f)) * warp;
    inside += bump * (2.2f * billow_octaves(2 * f * q, desc_.octaves, seed + 4) - 1.25f);
    inside += 0.5f * bump * noise_octaves(f * q, desc_.octaves, seed + 5);
    const float base = p.y - kBase + 0.03f * gradient_noise(1.5f * f * p, seed + 6);
    const float edge = 0.01f + 0.3f * desc_.softness;
    // Thinner where it ends, and at the base.
    return {ramp(inside, edge) * ramp(base, 0.03f + 0.2f * desc_.softness) *
            inside_box(p, kProportions, 0.06f)};
  }

private:
  struct Puff {
    vec3 center;
    float radius;
  };
  static constexpr std::uint32_t kPuffs = 18;
  static constexpr float kBase = -0.46f, kBlend = 0.06f;

  ProceduralGrid desc_;
  std::array<Puff, kPuffs> puffs_{};
};

/// A ball of noise that a flow has drawn into curls.
class SmokePattern {
public:
  static constexpr vec3 kProportions{1, 1, 1};

  explicit SmokePattern(const ProceduralGrid& desc) : desc_(desc) {}

  Matter at(vec3 p) const {
    if (length_squared(p) > 1) return {};
    const std::uint32_t seed = seed_of(desc_, 2);
    const float f = 0.5f * desc_.frequency;
    const float stride = 1 / (kSteps * std::max(0.5f * f, 0.2f));
    vec3 q = p; // where what is here has come from
    for (int i = 0; i < kSteps; ++i) {
      q -= (0.1f * stride) * curl_noise(0.8f * f * q, seed + 1);
      q -= (0.07f * stride) * curl_noise(2.2f * f * q, seed + 2);
    }
    const float distance = glm::length(q);
    const float ball = 0.74f - distance; // > 0 inside
    if (ball < -0.25f) return {};
    // Sheets of smoke: where noise is near 0.
    const float n = noise_octaves(1.3f * f * q, desc_.octaves, seed + 3);
    const float sheets = 1 - std::min(std::abs(n) * glm::mix(5.0f, 2.2f, desc_.coverage), 1.0f);
    const float body = std::clamp(0.5f + 1.4f * noise_octaves(0.9f * f * q, desc_.octaves, seed + 4) +
                                      (desc_.coverage - 0.5f),
                                  0.0f, 1.0f);
    const float edge = 0.02f + 0.4f * desc_.softness;
    return {
        std::min(ramp(ball, edge) * (0.75f * sheets * sheets + 0.55f * body * sheets + 0.1f * body), 1.0f) *
        inside_box(p, kProportions, 0.1f)};
  }

private:
  static constexpr int kSteps = 6;
  ProceduralGrid desc_;
};

/// Tongues that rise, narrow and come apart; hottest in the middle of their foot.
class FlamePattern {
public:
  static constexpr vec3 kProportions{0.5f, 1, 0.5f};

  explicit FlamePattern(const ProceduralGrid& desc) : desc_(desc) {}

  Matter at(vec3 p) const {
    const float h = 0.5f * (p.y + 1); // from the foot to the top
    if (h < 0.02f || h > 0.98f) return {};
    const std::uint32_t seed = seed_of(desc_, 3);
    const float f = desc_.frequency;
    // Flames are drawn upwards: their features are long, and sway more the higher they are.
    const float sway = 0.3f * h;
    vec3 q = p;
    for (std::uint32_t i = 0; i < 2; ++i) {
      const float scale = i == 0 ? 0.5f : 1.3f, far = i == 0 ? 0.8f * sway : 0.45f * sway;
      const vec3 place = scale * f * vec3(p.x, 0.45f * p.y, p.z);
      q.x += far * gradient_noise(place, seed + 1 + 2 * i);
      q.z += far * gradient_noise(place, seed + 2 + 2 * i);
    }
    const float r = std::sqrt(sqr(q.x) + sqr(q.z));
    const float foot = 0.24f + 0.2f * desc_.coverage;
    if (r > foot + 0.1f) return {};
    // Tongues: what rises over some places of the foot reaches higher than over others.
    const vec3 rising(q.x, 0.16f * q.y, q.z);
    const float tongue = 0.55f + 0.6f * desc_.coverage * (1 - sqr(r / foot)) +
                         0.75f * noise_octaves(0.9f * f * rising, 2, seed + 7);
    const float wisps = noise_octaves(1.6f * f * vec3(q.x, 0.35f * q.y, q.z), desc_.octaves, seed + 8);
    const float swell = std::pow(std::min(h / 0.14f, 1.0f), 0.5f); // the foot is round
    const float core =
        std::min(tongue - h, 1.4f * (swell * (1 - 0.45f * h) - r / foot)) + (0.08f + 0.55f * h) * wisps;
    const float there = ramp(core, 0.03f + 0.4f * desc_.softness) * inside_box(p, kProportions, 0.08f);
    if (there <= 0) return {};
    const float heat = ramp(core, 0.8f) * (1 - 0.3f * h);
    return {there * (1 - 0.5f * h), std::clamp(0.6f + 0.4f * heat, 0.0f, 1.0f)};
  }

private:
  ProceduralGrid desc_;
};

/// Calls fill(slice) for each of `count` slices, on several threads; stops early when cancelled.
template <class Fill>
void fill_slices(int count, int threads, const Progress* progress, Fill fill) {
  std::atomic<int> next{0};
  auto work = [&] {
    for (int slice; (slice = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
      if (progress != nullptr && progress->cancelled()) return;
      fill(slice);
    }
  };
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> others;
  for (int i = 1; i < std::min(threads, count); ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (progress != nullptr) progress->check();
}

template <class Pattern>
std::shared_ptr<const VolumeGrid> made(const ProceduralGrid& desc, const Progress* progress, int threads) {
  const Pattern pattern(desc);
  constexpr vec3 half = Pattern::kProportions; // of the box, whose longest side is 2
  auto grid = std::make_shared<VolumeGrid>();
  const auto resolution = static_cast<float>(
      std::clamp(desc.resolution, ProceduralGrid::kLeastResolution, ProceduralGrid::kMostResolution));
  grid->cells = glm::max(glm::ivec3(glm::round(half * resolution)), glm::ivec3(1));
  grid->bounds = {-half, half};
  constexpr bool kIsHot = std::is_same_v<Pattern, FlamePattern>;
  grid->density.resize(grid->cell_count());
  if (kIsHot) grid->temperature.resize(grid->cell_count());
  fill_slices(grid->cells.z, threads, progress, [&](int z) {
    std::size_t cell = static_cast<std::size_t>(z) * static_cast<std::size_t>(grid->cells.x) *
                       static_cast<std::size_t>(grid->cells.y);
    for (int y = 0; y < grid->cells.y; ++y)
      for (int x = 0; x < grid->cells.x; ++x, ++cell) {
        const vec3 share = (vec3(x, y, z) + 0.5f) / vec3(grid->cells);
        const Matter matter = pattern.at(half * (2.0f * share - 1.0f));
        grid->density[cell] = std::clamp(matter.density, 0.0f, 1.0f);
        if (kIsHot) grid->temperature[cell] = matter.temperature;
      }
  });
  return grid;
}

} // namespace

vec3 procedural_proportions(int pattern) {
  constexpr vec3 kAll[] = {CumulusPattern::kProportions, SmokePattern::kProportions,
                           FlamePattern::kProportions};
  return kAll[std::clamp(pattern, 0, 2)];
}

std::shared_ptr<const VolumeGrid> make_procedural_grid(const ProceduralGrid& desc, const Progress* progress,
                                                       int threads) {
  switch (desc.pattern) {
  case 0: return made<CumulusPattern>(desc, progress, threads);
  case 1: return made<SmokePattern>(desc, progress, threads);
  default: return made<FlamePattern>(desc, progress, threads);
  }
}

} // namespace candela
