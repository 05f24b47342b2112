#pragma once
// Renders for tests, and statistical tests of their samples against an expected radiance.

#include "core/hash.h"
#include "render/film/render_pass.h"
#include "support/materials.h"
#include "support/scenes.h"
#include "support/seed.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

namespace candela::test {

/// A sampler seed of this run, another one for every `salt`.
inline int sampler_seed(std::uint64_t salt = 0) {
  return static_cast<int>(hash_combine(fresh_seed(), salt) >> 33);
}

/// A material of the type that absorbs nothing.
inline Material lossless(std::string_view type, float ior = 1.5f) {
  Material m = material_of_type(type);
  set_if_there(m, "diffuse", vec3(type == "diffuse" ? 1.0f : 0.0f));
  set_if_there(m, "specular", vec3(1));
  set_if_there(m, "ior", ior);
  set_if_there(m, "exponent", 20.0f);
  return m;
}

/// All of stop.spp, in one pass.
inline Film render(const Document& document, const PassOptions& options = {}) {
  const FilmSettings& size = document.settings.film;
  Film film(size.width, size.height);
  std::atomic<bool> stop{false};
  SampleRange range{0, static_cast<std::uint32_t>(document.settings.stop.spp)};
  PassResult result = render_pass(*RenderScene::build(document), document, range, film, stop, options);
  EXPECT_TRUE(result.completed);
  EXPECT_EQ(result.nonfinite.count, 0u);
  return film;
}

/// Pixels whose expectation is the same: their means are independent under every sampler, so that their
/// spread gives the error without any assumption about the samples within a pixel.
inline RunningStatistics over_pixels(const Film& film, int channel) {
  RunningStatistics s;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) s.add(static_cast<double>(film.mean(x, y)[channel]));
  return s;
}

/// The mean is `exact` to within `tolerance` (relative), with so many samples that chance could not bring an
/// error of that size in or hide it, and no farther off than chance has it. Float arithmetic may be off by
/// 2e-5.
inline void expect_radiance(const RunningStatistics& s, double exact, double tolerance, int tests) {
  double deviation = std::sqrt(s.variance_of_mean());
  EXPECT_LT(6 * deviation, tolerance * exact) << "too few samples to tell";
  EXPECT_NEAR(s.mean(), exact, tolerance * exact);
  EXPECT_GT(z_test(s, exact, 2e-5 * exact), sidak_threshold(tests))
      << "mean " << s.mean() << ", exact " << exact << ", standard deviation of the mean " << deviation
      << "; " << seed_note();
}

/// Unit-radius sphere of 2 rings * segments triangles, with a vertex's normal if `smooth`; outward winding.
inline Mesh sphere_mesh(unsigned rings, unsigned segments, bool smooth) {
  Mesh mesh;
  for (unsigned i = 0; i <= rings; ++i)
    for (unsigned j = 0; j < segments; ++j) {
      float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
      vec3 p(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      if (i == 0 || i == rings) p = {0, 0, i == 0 ? 1.0f : -1.0f};
      mesh.positions.push_back(p);
      if (smooth) mesh.normals.push_back(p);
    }
  for (unsigned i = 0; i < rings; ++i)
    for (unsigned j = 0; j < segments; ++j) {
      unsigned a = i * segments + j, b = i * segments + (j + 1) % segments;
      if (i > 0) mesh.triangles.emplace_back(a, a + segments, b);
      if (i + 1 < rings) mesh.triangles.emplace_back(b, a + segments, b + segments);
    }
  return mesh;
}

} // namespace candela::test
