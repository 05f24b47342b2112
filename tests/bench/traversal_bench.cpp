// Rays per second of the acceleration structure and of Embree, for the same rays in one run: absolute numbers
// drift with the machine, ratios do not. Single rays on both sides (rtcIntersect1, rtcOccluded1; robust
// scenes), and camera rays in packets (Accel::intersect of many, rtcIntersect16).
//
//   traversal_bench [--short] [--scene NAME] [--threads N] [--rays-only | --builds-only]
//
// Each line: scene, ray set, threads, Mrays/s of ours (high build), of Embree (MEDIUM and HIGH builds), the
// ratios, and whether the lower one reaches its target. Packets have no target: their benefit is measured in
// whole renders. The rates of building come first.

#include "accel/accel.h"
#include "bench_scenes.h"
#include "core/basis.h"
#include "core/hash.h"
#include "sponza_scene.h"
#include "stopwatch.h"
#ifdef CANDELA_BENCH_EMBREE
#include "embree_scene.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <omp.h>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace candela;
using namespace candela::bench;

struct Options {
  bool quick = false;
  std::string scene;
  int threads = 2;
  bool rays_only = false, builds_only = false;
};

float random(std::uint32_t index, std::uint32_t dimension) {
  return to_unit_float(hash32(index + hash32(dimension)));
}

/// A pinhole camera's rays, tile by tile as in a renderer: one sample a pixel of all tiles, or more samples
/// of correspondingly fewer tiles.
std::vector<Ray> primary_rays(const View& view, std::uint32_t size, std::uint32_t samples = 1) {
  constexpr std::uint32_t kTile = 16;
  Basis frame = Basis::from_normal(glm::normalize(view.target - view.eye));
  vec3 right = glm::normalize(glm::cross(frame.n, vec3(0, 1, 0))), up = glm::cross(right, frame.n);
  float scale = std::tan(0.5f * view.fov_y);
  std::vector<Ray> rays;
  for (std::uint32_t tile = 0; tile < (size / kTile) * (size / kTile); tile += samples)
    for (std::uint32_t sample = 0; sample < kTile * kTile * samples; ++sample) {
      auto n = static_cast<std::uint32_t>(rays.size()), i = sample / samples;
      float x = static_cast<float>(tile % (size / kTile) * kTile + i % kTile) + random(n, 0);
      float y = static_cast<float>(tile / (size / kTile) * kTile + i / kTile) + random(n, 1);
      float s = scale * (2 * x / static_cast<float>(size) - 1),
            t = scale * (1 - 2 * y / static_cast<float>(size));
      rays.push_back({view.eye, 0, glm::normalize(frame.n + s * right + t * up), kInfinity});
    }
  return rays;
}

struct RaySets {
  std::vector<Ray> primary, diffuse, shadow;
};

RaySets make_rays(const BenchScene& scene, const Accel& accel, std::uint32_t size) {
  RaySets sets;
  sets.primary = primary_rays(scene.view, size);
  for (std::uint32_t i = 0; i < sets.primary.size(); ++i) {
    const Ray& ray = sets.primary[i];
    auto hit = accel.intersect(ray);
    if (!hit) continue;
    uvec3 t = scene.mesh.triangles[hit->primitive];
    vec3 a = scene.mesh.vertices[t.x], b = scene.mesh.vertices[t.y], c = scene.mesh.vertices[t.z];
    vec3 n = glm::normalize(glm::cross(b - a, c - a));
    if (glm::dot(n, ray.direction) > 0) n = -n;
    vec3 p = ray.at(hit->t) + n * (1e-4f * hit->t);
    float r = std::sqrt(random(i, 2)), phi = 2 * kPi * random(i, 3);
    vec3 local(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r));
    sets.diffuse.push_back({p, 0, Basis::from_normal(n).to_world(local), kInfinity});
    vec3 light = scene.view.light + scene.view.light_size * vec3(random(i, 4) - 0.5f, 0, random(i, 5) - 0.5f);
    sets.shadow.push_back({p, 0, light - p, 0.999f});
  }
  return sets;
}

/// The least time of a few runs, in seconds, which is disturbed least by other programs.
double least_seconds(int repeats, const std::function<void()>& f) {
  double best = 1e30;
  for (int i = 0; i < repeats; ++i) {
    auto start = std::chrono::steady_clock::now();
    f();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

/// The least time of each chunk of rays over all rounds, and the total number of hits.
struct Measured {
  std::vector<double> chunk_seconds;
  std::size_t hits = 0;
};

/// Repeatedly traces the rays with each of `tracers` in turn (functions from rays to their number of hits),
/// and keeps the least time of every 2048 rays: on a shared machine, the least time of short pieces
/// approximates an undisturbed run, and alternating distributes the remaining disturbance equally. Returns
/// the rays per second of each.
template <class... Tracers>
std::vector<std::pair<double, std::size_t>> measure(const std::vector<Ray>& rays, int threads, int rounds,
                                                    const Tracers&... tracers) {
  constexpr std::size_t kChunk = 2048;
  std::size_t chunks = (rays.size() + kChunk - 1) / kChunk;
  std::vector<Measured> measured(sizeof...(Tracers));
  for (Measured& m : measured) m.chunk_seconds.assign(chunks, 1e30);
#pragma omp parallel num_threads(threads)
  for (int round = 0; round < rounds; ++round) {
    std::size_t which = 0;
    auto trace_all = [&](const auto& tracer) {
      Measured& m = measured[which++];
      std::size_t hits = 0;
#pragma omp barrier
      for (auto c = static_cast<std::size_t>(omp_get_thread_num()); c < chunks;
           c += static_cast<std::size_t>(threads)) {
        const auto chunk = std::span(rays).subspan(c * kChunk, std::min(kChunk, rays.size() - c * kChunk));
        double s = least_seconds(1, [&] { hits += tracer(chunk); });
        m.chunk_seconds[c] = std::min(m.chunk_seconds[c], s);
      }
      if (round == 0) {
#pragma omp atomic
        m.hits += hits;
      }
    };
    (trace_all(tracers), ...);
  }
  std::vector<std::pair<double, std::size_t>> result;
  for (const Measured& m : measured) {
    double seconds = 0;
    for (double s : m.chunk_seconds) seconds += s / threads;
    result.emplace_back(static_cast<double>(rays.size()) / seconds, m.hits);
  }
  return result;
}

/// Times builds in turn, so that disturbances affect all equally.
void report_build(const BenchScene& scene, int threads, const Options& options) {
  AccelInput input;
  input.vertices = scene.mesh.vertices, input.triangles = scene.mesh.triangles;
  const int repeats = options.quick ? 1 : scene.mesh.triangles.size() < 200000 ? 20 : 5;
  omp_set_num_threads(threads);
  struct Timed {
    const char* name;
    std::function<BuildTime()> build;
    BuildTime least = {};
  };
  auto ours = [&](BuildQuality quality) {
    return [&input, quality] {
      Stopwatch watch;
      const Accel accel = Accel::build(input, quality);
      return watch.elapsed();
    };
  };
  std::vector<Timed> builds{{"fast", ours(BuildQuality::fast)}, {"high", ours(BuildQuality::high)}};
#ifdef CANDELA_BENCH_EMBREE
  auto theirs = [&](RTCBuildQuality quality, bool robust) {
    return [&scene, threads, quality, robust] {
      return EmbreeScene(scene.mesh, quality, threads, robust).build_time();
    };
  };
  builds.push_back({"Embree medium", theirs(RTC_BUILD_QUALITY_MEDIUM, true)});
  builds.push_back({"Embree high", theirs(RTC_BUILD_QUALITY_HIGH, true)});
  // Robust scenes have no spatial splits, which our high quality has.
  builds.push_back({"Embree high, not robust", theirs(RTC_BUILD_QUALITY_HIGH, false)});
#endif
  for (int i = 0; i < repeats; ++i)
    for (Timed& timed : builds) timed.least.keep_least(timed.build());
  const auto million = static_cast<double>(scene.mesh.triangles.size()) * 1e-6;
  for (const Timed& timed : builds)
    fmt::print("{:8} build {}T  {:23} {:5.2f} Mtriangles/s, {:5.2f} per second of processor time\n",
               scene.name, threads, timed.name, million / timed.least.wall, million / timed.least.processor);
#ifdef CANDELA_BENCH_EMBREE
  auto ratio = [&](const char* what, std::size_t i, std::size_t j) {
    const BuildTime &a = builds[i].least, &b = builds[j].least;
    fmt::print("{:8} build {}T  {:31} ratio {:.2f}, by processor time {:.2f}\n", scene.name, threads, what,
               b.wall / a.wall, b.processor / a.processor);
    return b.wall >= a.wall;
  };
  const bool fast = ratio("fast / Embree medium", 0, 2);
  ratio("high / Embree high", 1, 3);
  const bool high = ratio("high / Embree high, not robust", 1, 4);
  fmt::print("{:8} build {}T  as fast as Embree at the same quality: {}\n", scene.name, threads,
             fast && high ? "pass" : "FAIL");
#endif
}

/// Rays per second of tinybvh's BVH8_CPU relative to Embree for primary, diffuse and shadow rays, measured
/// once; used as targets.
struct Target {
  std::string_view scene;
  std::array<double, 3> ratio;
};
constexpr std::array<Target, 4> kTargets{{{"cornell", {20.7 / 13.6, 13.4 / 10.9, 27.2 / 17.3}},
                                          {"bunny", {8.8 / 9.9, 6.5 / 7.4, 6.8 / 7.6}},
                                          {"sponza", {6.9 / 6.3, 3.7 / 4.2, 10.8 / 9.1}},
                                          {"sphere", {6.4 / 7.0, 3.7 / 4.7, 4.2 / 5.0}}}};

/// The target of the ratio to Embree: at least 1, and that of tinybvh.
double target_ratio(std::string_view scene, std::size_t set) {
  double result = 1;
  for (const Target& t : kTargets)
    if (t.scene == scene) result = std::max(result, t.ratio[set]);
  return result;
}

/// The contents of a line.
struct Rated {
  std::string_view scene, rays;
  int threads;
  double target; ///< 0 for none
};

/// Our rate and, if available, those of Embree's builds.
void print_rates(const Rated& rated, const std::vector<std::pair<double, std::size_t>>& rates) {
  auto [ours, hits] = rates[0];
  std::string line = fmt::format("{:8} {:8} {}T  Mrays/s: ours {:6.2f}", rated.scene, rated.rays,
                                 rated.threads, ours * 1e-6);
  double least_ratio = kInfinity;
  for (std::size_t i = 1; i < rates.size(); ++i) {
    auto [theirs, their_hits] = rates[i];
    least_ratio = std::min(least_ratio, ours / theirs);
    line += fmt::format(" | Embree {} {:6.2f} ratio {:.2f} hits {:+d}", i == 1 ? "medium" : "high",
                        theirs * 1e-6, ours / theirs, static_cast<std::ptrdiff_t>(their_hits - hits));
  }
  if (rates.size() > 1 && rated.target > 0)
    line += fmt::format(" | target {:.2f} {}", rated.target, least_ratio >= rated.target ? "pass" : "FAIL");
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void report_rays(const BenchScene& scene, const Options& options) {
  AccelInput input;
  input.vertices = scene.mesh.vertices, input.triangles = scene.mesh.triangles;
  omp_set_num_threads(options.threads);
  Accel accel = Accel::build(input);
  AccelStats stats = accel.stats();
  const std::size_t triangles = stats.count(PrimitiveKind::triangle);
  fmt::print("{:8} {} triangles, {} nodes, {} leaves ({:.2f} triangles), depth {}, cost {:.2f}, {:.1f} "
             "bytes/triangle\n",
             scene.name, triangles, stats.nodes, stats.leaves,
             static_cast<double>(triangles) / static_cast<double>(stats.leaves), stats.depth, stats.sah_cost,
             static_cast<double>(stats.bytes) / static_cast<double>(triangles));
  RaySets sets = make_rays(scene, accel, options.quick ? 128 : 384);
#ifdef CANDELA_BENCH_EMBREE
  EmbreeScene medium(scene.mesh, RTC_BUILD_QUALITY_MEDIUM, options.threads);
  EmbreeScene high(scene.mesh, RTC_BUILD_QUALITY_HIGH, options.threads);
#endif
  struct Set {
    const char* name;
    std::size_t index;
    const std::vector<Ray>& rays;
    bool any;
  };
  for (Set set : {Set{"primary", 0, sets.primary, false}, Set{"diffuse", 1, sets.diffuse, false},
                  Set{"shadow", 2, sets.shadow, true}})
    for (int threads = 1; threads <= options.threads; threads *= 2) {
      auto tracer = [&](const auto& of) {
        return [&of, any = set.any](std::span<const Ray> rays) {
          std::size_t hits = 0;
          for (const Ray& ray : rays) hits += any ? of.occluded(ray) : bool(of.intersect(ray));
          return hits;
        };
      };
      print_rates({scene.name, set.name, threads, target_ratio(scene.name, set.index)},
                  measure(set.rays, threads, options.quick ? 2 : 15, tracer(accel)
#ifdef CANDELA_BENCH_EMBREE
                                                                         ,
                          tracer(medium), tracer(high)
#endif
                              ));
    }
  for (std::uint32_t samples : {1u, 16u}) {
    const std::vector<Ray> rays = primary_rays(scene.view, options.quick ? 128 : 512, samples);
    auto ours = [&](std::span<const Ray> some) {
      std::vector<const Ray*> pointers;
      for (const Ray& ray : some) pointers.push_back(&ray);
      std::vector<Hit> hits(some.size());
      accel.intersect(pointers, hits);
      return static_cast<std::size_t>(
          std::count_if(hits.begin(), hits.end(), [](const Hit& hit) { return hit.t < kInfinity; }));
    };
#ifdef CANDELA_BENCH_EMBREE
    auto theirs = [](const EmbreeScene& of) {
      return [&of](std::span<const Ray> some) {
        std::size_t hits = 0;
        for (std::size_t i = 0; i + 16 <= some.size(); i += 16) hits += of.intersect_16(&some[i]);
        return hits;
      };
    };
#endif
    const std::string name = fmt::format("packets of {} spp", samples);
    print_rates({scene.name, name, 1, 0}, measure(rays, 1, options.quick ? 2 : 15, ours
#ifdef CANDELA_BENCH_EMBREE
                                                  ,
                                                  theirs(medium), theirs(high)
#endif
                                                      ));
  }
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    std::string_view arg = argv[i];
    if (arg == "--short")
      options.quick = true;
    else if (arg == "--rays-only")
      options.rays_only = true;
    else if (arg == "--builds-only")
      options.builds_only = true;
    else if (arg == "--scene" && i + 1 < argc)
      options.scene = argv[++i];
    else if (arg == "--threads" && i + 1 < argc)
      options.threads = std::max(1, std::atoi(argv[++i]));
    else {
      fmt::print(stderr,
                 "usage: {} [--short] [--scene cornell|bunny|sponza|sphere|needles] [--threads N] "
                 "[--rays-only | --builds-only]\n",
                 argv[0]);
      return 2;
    }
  }
#ifndef CANDELA_BENCH_EMBREE
  fmt::print("built without Embree: our numbers only\n");
#endif
  auto wanted = [&](std::string_view name) { return options.scene.empty() || options.scene == name; };
  std::vector<BenchScene> scenes;
  if (wanted("cornell")) scenes.push_back(cornell_box());
  auto add_if_there = [&](BenchScene scene, const char* file) {
    if (scene.mesh.triangles.empty())
      fmt::print("{}: no " CANDELA_SHARED_DATA "/{}, left out\n", scene.name, file);
    else
      scenes.push_back(std::move(scene));
  };
  if (wanted("bunny")) add_if_there(bunny(), "meshes/stanford-bunny.obj");
  if (wanted("sponza")) add_if_there(sponza(), "mitsuba/sponza/sponza.serialized");
  if (wanted("sphere")) scenes.push_back(displaced_sphere(options.quick ? 64 : 572));
  if (wanted("needles")) scenes.push_back(needles(options.quick ? 2000 : 60000));
  for (const BenchScene& scene : scenes) {
    if (!options.rays_only && scene.mesh.triangles.size() > 1000)
      for (int threads = 1; threads <= options.threads; threads *= 2) report_build(scene, threads, options);
    if (!options.builds_only) report_rays(scene, options);
  }
}
