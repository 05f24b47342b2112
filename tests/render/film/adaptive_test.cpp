// Adaptive sampling.

#include "imaging/compare.h"
#include "render/film/film_view.h"
#include "render/strategy_scenes.h"

#include <set>

namespace {

using namespace candela;
using namespace candela::test;

const std::atomic<bool> kNever{false};

Document adaptive_document(float error, int min_spp) {
  Document d = cornell_flush(40, 27, 64, true).document; // blocks of several sizes
  d.settings.adaptive.error = error;
  d.settings.adaptive.min_spp = min_spp;
  return d;
}

void expect_equal_films(const Film& a, const Film& b) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      ASSERT_EQ(a.count(x, y), b.count(x, y)) << x << ", " << y;
      ASSERT_EQ(a.mean(x, y), b.mean(x, y)) << x << ", " << y;
      ASSERT_EQ(a.stopped(x, y), b.stopped(x, y)) << x << ", " << y;
    }
}

TEST(AdaptiveRender, DoesNotDependOnThreadsOrOnHowPassesDivideTheSamples) {
  Document d = adaptive_document(0.1f, 4);
  auto scene = RenderScene::build(d);
  auto render_in = [&](std::initializer_list<std::uint32_t> ends, int threads) {
    Film film(40, 27);
    PassOptions options;
    options.threads = threads;
    std::uint32_t begin = 0;
    for (std::uint32_t end : ends) {
      render_pass(*scene, d, {begin, end}, film, kNever, options);
      begin = end;
    }
    return film;
  };
  Film whole = render_in({64}, 1);
  expect_equal_films(render_in({1, 2, 5, 11, 12, 40, 64}, 3), whole);
  std::set<int> counts;
  for (int y = 0; y < 27; ++y)
    for (int x = 0; x < 40; ++x) counts.insert(whole.count(x, y));
  EXPECT_GT(counts.size(), 3u) << "every block took the same number";
}

TEST(AdaptiveRender, StoppedBlocksAreAsGoodAsAskedAndOthersContinue) {
  const float error = 0.1f;
  Document d = adaptive_document(error, 8);
  Film film = render(d);
  int stopped = 0, going = 0;
  for (int y0 = 0; y0 < 27; y0 += 8)
    for (int x0 = 0; x0 < 40; x0 += 8) {
      double sum = 0;
      int pixels = 0;
      for (int y = y0; y < std::min(y0 + 8, 27); ++y)
        for (int x = x0; x < x0 + 8; ++x, ++pixels) {
          sum += film.relative_variance(x, y);
          EXPECT_EQ(film.count(x, y), film.count(x0, y0));
          EXPECT_EQ(film.stopped(x, y), film.stopped(x0, y0));
        }
      double relative_error = std::sqrt(sum / pixels);
      if (film.stopped(x0, y0)) {
        ++stopped;
        EXPECT_LE(relative_error, static_cast<double>(error));
        EXPECT_EQ(film.count(x0, y0) % 8, 0);
      } else {
        ++going;
        EXPECT_EQ(film.count(x0, y0), 64);
        EXPECT_GT(relative_error, static_cast<double>(error));
      }
    }
  EXPECT_GT(stopped, 2);
  EXPECT_GT(going, 0);
}

TEST(AdaptiveRender, SaysWhenNothingIsLeftToDo) {
  Document d = adaptive_document(1, 2);
  auto scene = RenderScene::build(d);
  Film film(40, 27);
  PassResult result;
  for (std::uint32_t i = 0; i < 4096 && !result.converged; i += 64)
    result = render_pass(*scene, d, {i, i + 64}, film, kNever);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(render_pass(*scene, d, {5000, 5001}, film, kNever).rays.samples, 0u);
  d.settings.adaptive.error = 0;
  EXPECT_FALSE(render_pass(*scene, d, {5000, 5001}, film, kNever).converged);
}

TEST(NoiseStatistical, TheEstimateIsTheErrorAgainstAReference) {
  Document d = cornell_flush(16, 16, 8192, true).document;
  d.settings.path.component = PathComponent::direct; // no rare paths: a hundred renders tell
  d.settings.sampler.seed = sampler_seed(99);
  Image reference = render(d).image();
  d.settings.sampler.type = SamplerType::independent;
  d.settings.stop.spp = 64;
  RunningStatistics ratio;
  for (std::uint64_t i = 0; i < 100; ++i) {
    d.settings.sampler.seed = sampler_seed(i);
    Film film = render(d);
    const double estimate = estimated_relmse(film);
    ratio.add(estimate / compare_images(film.image(), reference).rel_mse);
    std::vector<vec3> variance;
    std::vector<std::uint32_t> samples;
    resolve_statistics(film, variance, samples);
    EXPECT_EQ(estimated_relmse(film.image().pixels, variance, samples), estimate);
  }
  // The estimate divides by the noisy mean and the measure by the true one: some percent at 64 samples.
  EXPECT_GT(z_test(ratio, 1, 0.03), sidak_threshold(1)) << ratio.mean() << "; " << seed_note();
  EXPECT_LT(std::sqrt(ratio.variance_of_mean()), 0.03) << "too few renders to tell";
}

TEST(NoiseEstimate, KnowsOnlyPixelsOfTwoSamples) {
  Film film(3, 1);
  EXPECT_EQ(estimated_relmse(film), std::numeric_limits<double>::infinity());
  film.add(0, 0, vec3(0));
  film.add(0, 0, vec3(1)); // mean 0.5, variance of the mean 0.25
  film.add(1, 0, vec3(1)); // it may be noise or not
  EXPECT_FLOAT_EQ(static_cast<float>(estimated_relmse(film)), 0.25f / 0.26f);
  std::vector<vec3> variance;
  std::vector<std::uint32_t> samples;
  resolve_statistics(film, variance, samples);
  EXPECT_EQ(estimated_relmse(film.image().pixels, variance, samples), estimated_relmse(film));
}

TEST(NoiseChecks, AreFixedNumbersThatGrow) {
  int spp = 0, checks = 0;
  while (spp < 1'000'000) {
    int next = next_noise_check(spp);
    ASSERT_GT(next, spp);
    ASSERT_TRUE(is_noise_check(next));
    ASSERT_LE(next - spp, std::max(8, spp / 4));
    if (next - spp > 1) { ASSERT_FALSE(is_noise_check(spp + 1)); }
    spp = next;
    ++checks;
  }
  EXPECT_LT(checks, 200);
  EXPECT_FALSE(is_noise_check(0));
}

} // namespace
