// The views of a render.

#include "render/film/film_view.h"
#include "render/integrators/first_hit_view.h"
#include "render/media_testing.h"
#include "render/strategy_scenes.h"

namespace {

using namespace candela;
using namespace candela::test;

Film film_of(Document d, View view) {
  d.settings.view = view;
  return render(d);
}

/// A tilted smooth triangle pair seen from the front, left half one material, right half another.
Document two_squares() {
  SceneMaker s(8, 4, 4);
  int left = s.diffuse(vec3(0.2f)), right = s.diffuse(vec3(0.6f));
  s.rectangle({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, left);
  s.rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, right);
  s.camera({0, 0, 5}, {0, 0, 0}, 2 * std::atan(0.2f) * 180 / kPi);
  return s.document;
}

TEST(ViewRender, NormalsFaceTheViewerAndDifferWhereShadingIsSmooth) {
  Document d = two_squares();
  EXPECT_EQ(film_of(d, View::geometric_normal).mean(1, 1), vec3(0.5f, 0.5f, 1));
  d.scene.camera.position.z = -5; // from behind
  EXPECT_EQ(film_of(d, View::geometric_normal).mean(1, 1), vec3(0.5f, 0.5f, 0));

  SceneMaker s(16, 16, 1);
  s.mesh(sphere_mesh(8, 12, true), s.diffuse(vec3(0.5f)));
  s.camera({0, 0, 5}, {0, 0, 0}, 20);
  Film smooth = film_of(s.document, View::normal), flat = film_of(s.document, View::geometric_normal);
  int different = 0;
  for (int y = 4; y < 12; ++y)
    for (int x = 4; x < 12; ++x) different += smooth.mean(x, y) != flat.mean(x, y);
  EXPECT_GT(different, 50);
}

/// Of a fog that fills the scene up to a wall, of a cloud before the wall, and of an endless one.
TEST(ViewRender, OpticalDepthIsThatOfAllMediaBeforeTheFirstSurface) {
  SceneMaker s(4, 4, 16);
  s.document.scene.medium = add_medium(s, {0.1f, 0.2f, 0.3f}, vec3(0.5f));
  s.rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, s.diffuse(vec3(0.5f)));
  s.camera({0, 0, 5}, {0, 0, 0}, 1e-3f);
  EXPECT_NEAR(film_of(s.document, View::optical_depth).mean(1, 1).x, 1, 1e-4f);
  VolumeGrid grid = random_grid({9, 9, 30}, 1);
  for (std::size_t i = 0; i < grid.density.size(); ++i) grid.density[i] = i < grid.density.size() / 2 ? 2 : 0;
  s.sphere({0, 0, 2}, 1, boundary(s, add_grid(s, std::move(grid), {0, 0, 2}, vec3(2), vec3(3), vec3(1))));
  EXPECT_NEAR(film_of(s.document, View::optical_depth).mean(1, 1).x, 0.2f * 3 + 3 * 2 * 1, 0.2f);
  s.document.scene.instances.clear();
  EXPECT_EQ(film_of(s.document, View::optical_depth).mean(1, 1).x, kGreatestOpticalDepth);
  s.document.scene.medium.clear();
  EXPECT_EQ(film_of(s.document, View::optical_depth).mean(1, 1).x, 0);
}

TEST(ViewRender, UvRunsOverTheSurfaceAndMaterialsHaveTheirOwnColors) {
  Film uv = film_of(two_squares(), View::uv);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      // A pixel is a quarter of a square wide (and half of one high), its samples lie anywhere in it.
      EXPECT_NEAR(uv.mean(x, y).r, (x % 4 + 0.5f) / 4, 0.125f);
      EXPECT_EQ(uv.mean(x, y).b, 0);
    }
  Film material = film_of(two_squares(), View::material);
  EXPECT_EQ(material.mean(0, 0), material.mean(3, 3));
  EXPECT_EQ(material.mean(4, 0), material.mean(7, 3));
  EXPECT_GT(glm::length(material.mean(0, 0) - material.mean(7, 0)), 0.1f);
}

TEST(ViewRender, BvhCostCountsWhatIntersectTests) {
  Document d = cornell_flush(8, 8, 1, true).document;
  Film film = film_of(d, View::bvh_cost);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_GE(film.mean(x, y).x, 1);
  SceneMaker one(2, 2, 1); // a root that is a leaf: one pack, no node
  one.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, one.diffuse(vec3(1)));
  EXPECT_EQ(film_of(one.document, View::bvh_cost).mean(0, 0), vec3(1));
}

TEST(ViewRender, TheLightShareIsWhatTheStrategyFinds) {
  Document d = cornell_flush(8, 8, 64, true).document;
  auto shares = [&](LightSampling how) {
    d.settings.path.light_sampling = how;
    Film film = film_of(d, View::light_share);
    std::vector<vec3> out;
    resolve_view(film, View::light_share, 1, out);
    return out;
  };
  for (vec3 share : shares(LightSampling::bsdf)) EXPECT_EQ(share, vec3(0));
  for (vec3 share : shares(LightSampling::nee)) EXPECT_EQ(share, vec3(1));
  double sum = 0;
  for (vec3 share : shares(LightSampling::mis)) {
    EXPECT_TRUE(share.x >= 0 && share.x <= 1) << share.x;
    sum += static_cast<double>(share.x);
  }
  EXPECT_GT(sum / 64, 0.5); // the lamp is small: light sampling finds most of its light
  EXPECT_LT(sum / 64, 1);
}

TEST(ViewRender, DepthSharesAddUpToOneAndFollowTheLimit) {
  Document d = cornell_flush(8, 8, 64, true).document;
  auto shares = [&](int max_depth) {
    d.settings.path.max_depth = max_depth;
    std::vector<vec3> out;
    resolve_view(film_of(d, View::depth_share), View::depth_share, 1, out);
    return out;
  };
  for (vec3 share : shares(-1)) {
    EXPECT_NEAR(share.x + share.y + share.z, 1, 1e-5f);
    EXPECT_GT(share.z, 0);
  }
  for (vec3 share : shares(3)) EXPECT_EQ(share.z, 0);
  // A pixel of the ceiling sees no lamp directly: nothing is left of it at two segments.
  for (vec3 share : shares(2)) EXPECT_TRUE(share == vec3(1, 0, 0) || share == vec3(0));
}

TEST(ViewRender, VarianceSamplesAndNonFiniteComeFromTheFilmOfRadiance) {
  for (View view : {View::variance, View::samples, View::nonfinite})
    EXPECT_EQ(accumulated_view(view), View::radiance);
  Film film(2, 1);
  for (int i = 0; i < 4; ++i) film.add(0, 0, vec3(i < 2 ? 1.0f : 3.0f));
  film.add_nonfinite(1, 0);
  film.add_nonfinite(1, 0);
  auto value = [&](View view, int x) {
    std::vector<vec3> out;
    resolve_view(film, view, 1, out);
    return out[static_cast<std::size_t>(x)];
  };
  EXPECT_NEAR(value(View::variance, 0).x, 4.0f / 3, 1e-5f); // sum of squares 4 over n - 1
  EXPECT_EQ(value(View::samples, 0), vec3(4));
  EXPECT_EQ(value(View::samples, 1), vec3(0));
  EXPECT_EQ(value(View::nonfinite, 1), vec3(2));
  EXPECT_EQ(value(View::radiance, 0), vec3(2));
}

TEST(Film, HalvesAreTheEvenAndTheOddSamples) {
  Film film(1, 1);
  for (float v : {1.0f, 10.0f, 2.0f, 20.0f, 3.0f}) film.add(0, 0, vec3(v));
  EXPECT_NEAR(film.half_image(0).at(0, 0).x, 2, 1e-6f);
  EXPECT_NEAR(film.half_image(1).at(0, 0).x, 15, 1e-6f);
  EXPECT_EQ(Film(1, 1).half_image(1).at(0, 0), vec3(0));
}

} // namespace
