// No radiance is NaN or infinite, whatever the scene, and every picture ends: tests that hang have failed.

#include "render/random_scene.h"

namespace candela::test {
namespace {

void expect_finite_pictures(std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const Document document = random_scene(hash_combine(fresh_seed(), i));
    ASSERT_EQ(document_problem(document), "") << "scene " << i << "; " << seed_note();
    const FilmSettings& size = document.settings.film;
    Film film(size.width, size.height);
    const std::atomic<bool> never{false};
    const SampleRange range{0, static_cast<std::uint32_t>(document.settings.stop.spp)};
    const PassResult result = render_pass(*RenderScene::build(document), document, range, film, never);
    EXPECT_TRUE(result.completed);
    EXPECT_EQ(result.nonfinite.count, 0u) << "scene " << i << "; " << seed_note();
    // The one with negative lobes may make negative pixels.
    const bool may_be_negative = document.settings.film.filter == FilterType::mitchell;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const vec3 mean = film.mean(x, y);
        ASSERT_TRUE(std::isfinite(mean.x + mean.y + mean.z) && (may_be_negative || min_component(mean) >= 0))
            << "scene " << i << ", pixel " << x << " " << y << ": " << mean.x << " " << mean.y << " "
            << mean.z << "; " << seed_note();
      }
  }
}

TEST(RandomScene, IsTheSameOfTheSameSeed) {
  const Document a = random_scene(5), b = random_scene(5), c = random_scene(6);
  EXPECT_TRUE(same_content(a, b));
  EXPECT_FALSE(same_content(a, c));
}

TEST(RandomScene, AHundredHaveFinitePictures) { expect_finite_pictures(100); }
TEST(RandomSceneHeavy, TenThousandHaveFinitePictures) { expect_finite_pictures(10000); }

} // namespace
} // namespace candela::test
