#include "imaging/compare.h"
#include "render/denoise/denoiser.h"
#include "render/denoise/feature_film.h"
#include "render/render_testing.h"

#include <random>

namespace candela {
namespace {

using test::SceneMaker;

Image filled(int width, int height, vec3 value) {
  return {width, height,
          std::vector<vec3>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value)};
}

NoisyImage noiseless(const Image& image) {
  return {{image, image}, filled(image.width, image.height, vec3(0))};
}

/// Halves with normal errors of the given deviation, and the variance of their mean.
NoisyImage noisy(const Image& image, float deviation, std::mt19937& random) {
  NoisyImage out = noiseless(image);
  std::normal_distribution<float> error(0, deviation);
  for (Image& half : out.half)
    for (vec3& pixel : half.pixels) pixel += vec3(error(random), error(random), error(random));
  out.variance = filled(image.width, image.height, vec3(deviation * deviation / 2));
  return out;
}

/// A wall with a checkered texture under a light that grows to the right. Its sides are no multiples of the
/// denoiser's tiles.
struct Wall {
  static constexpr int kWidth = 83, kHeight = 45;
  Image albedo = filled(kWidth, kHeight, vec3(0)), color = albedo, position = albedo;

  Wall() {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        bool light = (x / 12 + y / 12) % 2 == 0;
        albedo.at(x, y) = light ? vec3(0.9f, 0.8f, 0.8f) : vec3(0.1f, 0.1f, 0.05f);
        color.at(x, y) = albedo.at(x, y) * (0.5f + static_cast<float>(x) / kWidth);
        position.at(x, y) = vec3(static_cast<float>(x) / kWidth, static_cast<float>(y) / kWidth, 0);
      }
  }
  DenoiseInput input(float deviation, std::mt19937& random) const {
    return {noisy(color, deviation, random), noiseless(albedo),
            noiseless(filled(kWidth, kHeight, vec3(0, 0, 1))), noiseless(position)};
  }
};

TEST(Denoiser, LeavesAConstantImage) {
  const vec3 value(0.3f, 20, 1e-4f);
  const Image image = filled(70, 21, value), flat = filled(70, 21, vec3(0));
  auto result = denoise({noiseless(image), noiseless(flat), noiseless(flat), noiseless(flat)});
  ASSERT_TRUE(result);
  for (const vec3& pixel : result->pixels)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(pixel[c], value[c], 1e-5f * value[c]);
}

TEST(Denoiser, LeavesABlackImage) {
  const Image black = filled(3, 2, vec3(0));
  auto result = denoise({noiseless(black), noiseless(black), noiseless(black), noiseless(black)});
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, black);
}

TEST(Denoiser, DoesNotDependOnThreads) {
  std::mt19937 random(1);
  DenoiseInput input = Wall().input(0.1f, random);
  auto one = denoise(input, {1, nullptr});
  for (int threads : {2, 5}) EXPECT_EQ(denoise(input, {threads, nullptr}), one) << threads;
}

TEST(Denoiser, StopsWhereItIsTold) {
  std::mt19937 random(1);
  std::atomic<bool> stop{true};
  EXPECT_FALSE(denoise(Wall().input(0.1f, random), {1, &stop}));
}

TEST(Denoiser, TakesWhatIsNotFiniteFromAroundIt) {
  std::mt19937 random(1);
  Wall wall;
  DenoiseInput input = wall.input(0.02f, random);
  input.color.half[0].at(18, 18).x = std::numeric_limits<float>::quiet_NaN();
  input.color.half[1].at(0, 0).y = kInfinity;
  input.color.variance.at(Wall::kWidth - 1, Wall::kHeight - 1).z = kInfinity;
  auto result = denoise(input);
  ASSERT_TRUE(result);
  for (const vec3& pixel : result->pixels) ASSERT_TRUE(is_finite(pixel));
  for (ivec2 p : {ivec2(18, 18), ivec2(0, 0), ivec2(Wall::kWidth - 1, Wall::kHeight - 1)})
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(result->at(p.x, p.y)[c], wall.color.at(p.x, p.y)[c], 0.1f);
}

TEST(Denoiser, IsFiniteWhereNothingIs) {
  const Image nan = filled(20, 20, vec3(std::numeric_limits<float>::quiet_NaN())),
              flat = filled(20, 20, vec3(0));
  auto result = denoise({noiseless(nan), noiseless(flat), noiseless(flat), noiseless(flat)});
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, flat);
}

// The texture's edges are sharp: hardly anywhere (a pixel in one of 40 runs has that much noise) is the
// result as far off as it would be along all edges had it mixed two squares, whose colours are 0.35 apart at
// the least.
TEST(DenoiserStatistical, KeepsTextures) {
  SCOPED_TRACE(test::seed_note());
  std::mt19937 random(static_cast<std::uint32_t>(test::fresh_seed()));
  Wall wall;
  const float deviation = 0.05f;
  DenoiseInput input = wall.input(deviation, random);
  auto result = denoise(input);
  ASSERT_TRUE(result);
  double error = 0;
  int mixed = 0;
  for (std::size_t i = 0; i < wall.color.pixels.size(); ++i) {
    vec3 d = result->pixels[i] - wall.color.pixels[i];
    error += static_cast<double>(glm::dot(d, d)) / 3;
    mixed += max_component(glm::abs(d)) > 0.15f;
  }
  EXPECT_LT(mixed, 8);
  error /= static_cast<double>(wall.color.pixels.size());
  EXPECT_LT(error, 0.5 * static_cast<double>(deviation * deviation / 2)) << "of the noisy mean's error";
}

struct Rendered {
  DenoiseInput input;
  Image noisy;
};

Rendered render_halves(const Document& document, int spp) {
  const FilmSettings& size = document.settings.film;
  auto scene = RenderScene::build(document);
  Film all(size.width, size.height), halves[2] = {all, all};
  std::atomic<bool> stop{false};
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(spp); ++i)
    render_pass(*scene, document, {i, i + 1}, halves[i % 2], stop);
  render_pass(*scene, document, {0, static_cast<std::uint32_t>(spp)}, all, stop);
  Rendered r;
  r.input.color = {{halves[0].image(), halves[1].image()}, all.variance_image()};
  FeatureFilm features(size.width, size.height);
  EXPECT_TRUE(render_features(*scene, document, static_cast<std::uint32_t>(spp), features, stop));
  features.resolve(r.input.albedo, r.input.normal, r.input.position);
  r.noisy = all.image();
  return r;
}

// What it is for: less error, at the same brightness. Of paths that do not split, whose noise is worth it:
// measured 3.4 to 4.0 times less in a dozen runs.
TEST(DenoiserStatistical, LowersTheErrorOfARender) {
  SCOPED_TRACE(test::seed_note());
  SceneMaker maker = test::cornell_flush(64, 64, 512, true);
  maker.document.settings.sampler.seed = test::sampler_seed(1);
  const Image reference = test::render(maker.document).image();
  maker.document.settings.sampler.seed = test::sampler_seed(2);
  maker.document.settings.path.split = 1;
  Rendered r = render_halves(maker.document, 16);
  auto result = denoise(r.input);
  ASSERT_TRUE(result);
  ComparisonResult before = compare_images(r.noisy, reference), after = compare_images(*result, reference);
  EXPECT_EQ(after.nonfinite, 0);
  EXPECT_LT(after.rel_mse, before.rel_mse / 2.5);
  for (double ratio : compare_images(*result, r.noisy).mean_ratio) EXPECT_NEAR(ratio, 1, 0.01);
}

Document mirror_before_wall() {
  SceneMaker s(16, 16, 4);
  Material mirror;
  mirror.model = MirrorMaterial{vec3(0.5f)};
  int silver = s.material(mirror), red = s.diffuse(vec3(0.8f, 0.1f, 0.1f));
  s.rectangle(vec3(0), vec3(10, 0, 0), vec3(0, 10, 0), silver); // seen from +z
  s.rectangle(vec3(0, 0, 8), vec3(-10, 0, 0), vec3(0, 10, 0), red);
  s.camera(vec3(0, 0, 4), vec3(0), 40);
  return s.document;
}

TEST(FeatureFilm, LooksThroughMirrors) {
  Document document = mirror_before_wall();
  std::atomic<bool> stop{false};
  FeatureFilm film(16, 16);
  ASSERT_TRUE(render_features(*RenderScene::build(document), document, 4, film, stop));
  NoisyImage albedo, normal, position;
  film.resolve(albedo, normal, position);
  const float extent = glm::length(vec3(20, 20, 8)); // the scene's diagonal, about its middle at z = 4
  for (std::size_t i = 0; i < 256; ++i)
    for (int h = 0; h < 2; ++h) {
      ASSERT_NEAR(albedo.half[h].pixels[i].x, 0.4f, 1e-5f);
      ASSERT_NEAR(albedo.half[h].pixels[i].y, 0.05f, 1e-5f);
      ASSERT_NEAR(normal.half[h].pixels[i].z, -1, 1e-5f);
      ASSERT_NEAR(position.half[h].pixels[i].z, 4 / extent, 1e-5f);
    }
}

TEST(FeatureFilm, DoesNotDependOnThreadsOrPortions) {
  Document document = test::cornell_flush(33, 20, 8, true).document;
  auto scene = RenderScene::build(document);
  std::atomic<bool> stop{false};
  auto gather = [&](const std::vector<std::uint32_t>& portions, int threads) {
    FeatureFilm film(33, 20);
    for (std::uint32_t spp : portions)
      EXPECT_TRUE(render_features(*scene, document, spp, film, stop, threads));
    NoisyImage albedo, normal, position;
    film.resolve(albedo, normal, position);
    return std::vector{albedo.half[0], normal.half[1], position.variance};
  };
  auto whole = gather({8}, 1);
  EXPECT_EQ(gather({8}, 3), whole);
  EXPECT_EQ(gather({2, 3, 8}, 2), whole);
  EXPECT_EQ(gather({8, 4}, 2), whole) << "a film has what it has";
}

TEST(FeatureFilm, StopsWhereItIsTold) {
  Document document = mirror_before_wall();
  std::atomic<bool> stop{true};
  FeatureFilm film(16, 16);
  EXPECT_FALSE(render_features(*RenderScene::build(document), document, 4, film, stop));
}

} // namespace
} // namespace candela
