// Cost of random numbers and of warps, in the pattern of a path: one start per sample, then a few draws per
// bounce.

#include "materials/direction_sampling.h"
#include "sampling/sampler.h"
#include "sampling/spherical_rectangle.h"
#include "sampling/warp.h"

#include <benchmark/benchmark.h>

namespace {

using namespace candela;

constexpr int kBounces = 8;
constexpr Dimension kDraws[] = {Dimension::light_position, Dimension::bsdf_direction, Dimension::lens,
                                Dimension::film};

/// Items are 2-D draws; start() and set_bounce() are spread over them.
void bm_get_2d(benchmark::State& state, SamplerType type) {
  Sampler sampler(type, 1, 4);
  std::uint32_t sample = 0;
  for (auto _ : state) {
    sampler.start({sample & 255, 7}, sample >> 8);
    ++sample;
    vec2 sum(0);
    for (std::uint32_t bounce = 0; bounce < kBounces; ++bounce) {
      sampler.set_bounce(bounce);
      for (Dimension d : kDraws) sum += sampler.get_2d(d);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * kBounces * static_cast<std::int64_t>(std::size(kDraws)));
}
BENCHMARK_CAPTURE(bm_get_2d, independent, SamplerType::independent);
BENCHMARK_CAPTURE(bm_get_2d, stratified, SamplerType::stratified);
BENCHMARK_CAPTURE(bm_get_2d, sobol, SamplerType::sobol);
BENCHMARK_CAPTURE(bm_get_2d, halton, SamplerType::halton);
BENCHMARK_CAPTURE(bm_get_2d, pmj02, SamplerType::pmj02);
BENCHMARK_CAPTURE(bm_get_2d, lattice, SamplerType::lattice);
BENCHMARK_CAPTURE(bm_get_2d, blue_noise, SamplerType::blue_noise);

void bm_get_1d(benchmark::State& state, SamplerType type) {
  Sampler sampler(type, 1, 4);
  std::uint32_t sample = 0;
  for (auto _ : state) {
    sampler.start({sample & 255, 7}, sample >> 8);
    ++sample;
    float sum = 0;
    for (std::uint32_t bounce = 0; bounce < kBounces; ++bounce) {
      sampler.set_bounce(bounce);
      for (Dimension d : kDraws) sum += sampler.get_1d(d);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * kBounces * static_cast<std::int64_t>(std::size(kDraws)));
}
BENCHMARK_CAPTURE(bm_get_1d, independent, SamplerType::independent);
BENCHMARK_CAPTURE(bm_get_1d, stratified, SamplerType::stratified);
BENCHMARK_CAPTURE(bm_get_1d, sobol, SamplerType::sobol);
BENCHMARK_CAPTURE(bm_get_1d, halton, SamplerType::halton);
BENCHMARK_CAPTURE(bm_get_1d, pmj02, SamplerType::pmj02);
BENCHMARK_CAPTURE(bm_get_1d, lattice, SamplerType::lattice);
BENCHMARK_CAPTURE(bm_get_1d, blue_noise, SamplerType::blue_noise);

/// A warp over precomputed points of the unit square.
template <class Warp>
void bm_warp(benchmark::State& state, Warp warp) {
  std::vector<vec3> points(1024);
  Sampler sampler(SamplerType::independent, 1);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    sampler.start({0, 0}, i);
    points[i] = vec3(sampler.get_2d(Dimension::film), sampler.get_1d(Dimension::lens));
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(warp(points[i++ & 1023]));
  state.SetItemsProcessed(state.iterations());
}

const Bsdf kDiffuse = Diffuse{vec3(0.5f)}, kPhong = Phong{vec3(0.4f), vec3(0.5f), 40},
           kGgx = Ggx{vec3(0.9f), 0.3f}, kGlass = Dielectric{1.5f, vec3(1)};

void bm_bsdf_sample(benchmark::State& state, Bsdf bsdf) {
  vec3 wo = glm::normalize(vec3(0.3f, -0.5f, 0.7f));
  bm_warp(state, [&](vec3 u) { return bsdf_sample(bsdf, wo, u); });
}
void bm_bsdf_eval_pdf(benchmark::State& state, Bsdf bsdf) {
  vec3 wo = glm::normalize(vec3(0.3f, -0.5f, 0.7f));
  bm_warp(state, [&](vec3 u) { return bsdf_eval_pdf(bsdf, wo, vec3(0.6f * u.x, 0.6f * u.y, 0.8f)); });
}

BENCHMARK_CAPTURE(bm_warp, disc, [](vec3 u) { return sample_uniform_disc({u.x, u.y}); });
BENCHMARK_CAPTURE(bm_warp, cosine_hemisphere, [](vec3 u) { return sample_cosine_hemisphere({u.x, u.y}); });
BENCHMARK_CAPTURE(bm_warp, triangle, [](vec3 u) { return sample_uniform_triangle({u.x, u.y}); });
BENCHMARK_CAPTURE(bm_warp, gaussian, [](vec3 u) { return TruncatedGaussian(0.5f, 1.5f).sample(u.x); });
BENCHMARK_CAPTURE(bm_warp, rectangle_construct, [](vec3 u) {
  return SphericalRectangle({-0.5f, -0.3f, 1}, {1, 0, 0}, {0, 0.7f, 0}, u).solid_angle;
});
BENCHMARK_CAPTURE(bm_warp, rectangle_construct_sample, [](vec3 u) {
  return SphericalRectangle({-0.5f, -0.3f, 1}, {1, 0, 0}, {0, 0.7f, 0}, u).sample({u.x, u.y});
});
BENCHMARK_CAPTURE(bm_bsdf_sample, diffuse, kDiffuse);
BENCHMARK_CAPTURE(bm_bsdf_sample, phong, kPhong);
BENCHMARK_CAPTURE(bm_bsdf_sample, ggx, kGgx);
BENCHMARK_CAPTURE(bm_bsdf_sample, dielectric, kGlass);
BENCHMARK_CAPTURE(bm_bsdf_eval_pdf, diffuse, kDiffuse);
BENCHMARK_CAPTURE(bm_bsdf_eval_pdf, phong, kPhong);
BENCHMARK_CAPTURE(bm_bsdf_eval_pdf, ggx, kGgx);

} // namespace
