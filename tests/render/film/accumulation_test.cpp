// An accumulation gives the same bits for any division into passes, interrupted and saved anywhere, and stops
// by its criteria.

#include "render/film/accumulation.h"
#include "render/film/film_view.h"
#include "render/film/render_pass.h"
#include "render/strategy_scenes.h"

#include <random>

namespace {

using namespace candela;
using namespace candela::test;

constexpr int kWidth = 37, kHeight = 23;

Document small_document(int spp) {
  Document d = cornell_flush(kWidth, kHeight, spp, true).document;
  d.settings.sampler.seed = sampler_seed(3);
  return d;
}

/// Renders `document` by another program of passes than the accumulation's.
Film reference(const RenderScene& scene, const Document& document, std::uint32_t spp) {
  Film film(kWidth, kHeight);
  EXPECT_TRUE(render_pass(scene, document, {0, spp}, film, {}).completed);
  return film;
}

/// Two samples of another seed.
Accumulation used_accumulation(const RenderScene& scene, Document document) {
  document.settings.sampler.seed ^= 1;
  document.settings.stop.spp = 2;
  Accumulation a(document.settings.film, {});
  CpuPassRenderer renderer;
  a.advance(renderer, scene, document, {});
  return a;
}

/// Ends every other pass early, after a part of its window.
class ImpatientRenderer final : public PassRenderer {
public:
  explicit ImpatientRenderer(std::mt19937_64& random) : random_(random) {}

  PassResult render(const PassJob& job, const PassFilms& films, const StopCondition& stop) override {
    ++passes;
    if (random_() % 2 == 0) return cpu_.render(job, films, stop);
    PassJob part = job;
    part.window = {0, 0, static_cast<int>(random_() % kWidth), static_cast<int>(random_() % kHeight)};
    if (!job.window.empty()) {
      part.window.x = job.window.x, part.window.y = job.window.y;
      part.window.width = std::min(part.window.width, job.window.width);
      part.window.height = std::min(part.window.height, job.window.height);
    }
    PassResult result;
    if (!part.window.empty()) result = cpu_.render(part, films, stop);
    result.completed = result.converged = false;
    return result;
  }
  int passes = 0;

private:
  std::mt19937_64& random_;
  CpuPassRenderer cpu_{2};
};

TEST(AccumulationRender, AnyPortionsStopsAndCopiesGiveTheSameBits) {
  std::mt19937_64 random(fresh_seed());
  SCOPED_TRACE(seed_note());
  const Document d = small_document(23);
  auto scene = RenderScene::build(d);
  const Film expected = reference(*scene, d, 23);
  for (int coarsest : {1, 2, 8, 64}) {
    Accumulation a = used_accumulation(*scene, d); // the film holds another picture
    a.restart(d.settings.film, {.coarsest = coarsest, .components = coarsest == 8});
    ImpatientRenderer renderer(random);
    while (!a.finished(d.settings.stop)) {
      ASSERT_LT(renderer.passes, 10000);
      const Portion portion{1, static_cast<int>(random() % 5)};
      const RayCounts before = a.rays();
      const Accumulation::Step step =
          a.step(a.next(d.settings.stop, portion), renderer, *scene, d, StopCondition());
      EXPECT_EQ(a.rays().samples, before.samples + step.rays.samples);
      if (random() % 3 == 0) a = Accumulation(Accumulation::State(a.state())); // saved and loaded
    }
    EXPECT_TRUE(a.film() == expected) << "coarsest " << coarsest;
    EXPECT_EQ(a.rays().samples, 23u * kWidth * kHeight) << "no sample is traced twice";
    EXPECT_EQ(a.spp(), 23);
    EXPECT_FALSE(a.open());
    EXPECT_GT(a.first_pass_seconds(), 0);
    EXPECT_GE(a.seconds(), a.first_pass_seconds());
    for (const Film& part : a.state().components) EXPECT_EQ(part.width() > 0 ? part.count(3, 3) : 23, 23);
  }
}

TEST(AccumulationRender, AFilmIsUsedAgain) {
  Document d = small_document(3);
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  Accumulation a;
  for (const int coarsest : {1, 16, 1, 4}) {
    ++d.settings.sampler.seed;
    a.restart(d.settings.film, {.coarsest = coarsest});
    EXPECT_EQ(a.spp(), 0);
    EXPECT_TRUE(a.advance(renderer, *scene, d, {}));
    EXPECT_TRUE(a.film() == reference(*scene, d, 3)) << coarsest;
    EXPECT_EQ(a.rays().samples, 3u * kWidth * kHeight);
  }
}

TEST(AccumulationRender, HalvesOfTheSamplesMergeToTheWhole) {
  for (const std::uint32_t half : {4u, 5u}) { // an even and an odd number
    Document d = small_document(11);
    auto scene = RenderScene::build(d);
    CpuPassRenderer renderer;
    Accumulation whole(d.settings.film, {.components = true});
    whole.advance(renderer, *scene, d, {});
    Document part = d;
    part.settings.stop.spp = static_cast<int>(half);
    Accumulation first(d.settings.film, {.components = true});
    first.advance(renderer, *scene, part, {});
    part.settings.stop.spp = 11 - static_cast<int>(half);
    Accumulation second(d.settings.film, {.coarsest = 8, .components = true, .first_sample = half});
    second.advance(renderer, *scene, part, {});

    Accumulation gap(d.settings.film, {.components = true, .first_sample = half + 1});
    gap.advance(renderer, *scene, part, {});
    const Film before = first.film();
    EXPECT_FALSE(first.merge(gap)) << "a sample is missing between them";
    EXPECT_FALSE(first.merge(first)) << "they are the same samples";
    EXPECT_TRUE(first.film() == before);
    ASSERT_TRUE(first.merge(second));
    EXPECT_EQ(first.spp(), 11);
    EXPECT_EQ(first.rays().samples, whole.rays().samples);
    EXPECT_EQ(first.rays().closest, whole.rays().closest);
    EXPECT_EQ(first.rays().shadow, whole.rays().shadow);
    EXPECT_TRUE(first.finished(d.settings.stop));
    const Image odd = first.film().half_image(1), odd_expected = whole.film().half_image(1);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_EQ(first.film().count(x, y), 11);
        for (int c = 0; c < 3; ++c) {
          ASSERT_FLOAT_EQ(first.film().mean(x, y)[c], whole.film().mean(x, y)[c]);
          ASSERT_NEAR(odd.at(x, y)[c], odd_expected.at(x, y)[c], 1e-5f * (1 + odd_expected.at(x, y)[c]));
          ASSERT_FLOAT_EQ(first.state().components[1].mean(x, y)[c],
                          whole.state().components[1].mean(x, y)[c]);
        }
      }
    // It is an accumulation like any other: the next sample is its twelfth.
    d.settings.stop.spp = 12;
    first.advance(renderer, *scene, d, {});
    EXPECT_EQ(first.rays().samples, 12u * kWidth * kHeight);
    EXPECT_EQ(first.film().count(5, 5), 12);
  }
}

TEST(AccumulationRender, WindowsMergeToTheWhole) {
  Document d = small_document(6);
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  Accumulation all(d.settings.film, {});
  const CropWindow windows[] = {{0, 0, 20, 9}, {20, 0, 17, 9}, {0, 9, kWidth, 14}};
  for (const CropWindow& w : windows) {
    EXPECT_FALSE(all.finished(d.settings.stop));
    Accumulation part(d.settings.film, {.window = w});
    part.advance(renderer, *scene, d, {});
    ASSERT_TRUE(all.merge(part));
    EXPECT_FALSE(all.merge(part)) << "it has them";
  }
  EXPECT_TRUE(all.finished(d.settings.stop));
  EXPECT_TRUE(all.film() == reference(*scene, d, 6));

  Accumulation rest(d.settings.film, {});
  Accumulation corner(d.settings.film, {.window = windows[0]});
  corner.advance(renderer, *scene, d, {});
  ASSERT_TRUE(rest.merge(corner));
  EXPECT_TRUE(rest.advance(renderer, *scene, d, {})) << "what is missing is rendered";
  EXPECT_TRUE(rest.film() == reference(*scene, d, 6));
  EXPECT_EQ(rest.rays().samples, 6u * kWidth * kHeight);
}

TEST(AccumulationRender, WhatCannotBeMergedIsRefused) {
  Document d = small_document(4);
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  Accumulation whole(d.settings.film, {}), nothing(d.settings.film, {.first_sample = 4});
  whole.advance(renderer, *scene, d, {});
  EXPECT_FALSE(whole.merge(nothing)) << "its first pass is not complete";
  Accumulation components(d.settings.film, {.components = true, .first_sample = 4});
  components.advance(renderer, *scene, d, {});
  EXPECT_FALSE(whole.merge(components)) << "one keeps components, one does not";
  Accumulation window(d.settings.film, {.window = {3, 3, 8, 8}});
  window.advance(renderer, *scene, d, {});
  EXPECT_FALSE(window.merge(whole)) << "it has no room";
  EXPECT_EQ(whole.spp(), 4);
}

TEST(AccumulationRender, StopsAtTheSampleCountTheNoiseAndTheConvergence) {
  Document d = small_document(0);
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  d.settings.stop.noise = 0.1f;
  Accumulation noisy(d.settings.film, {});
  noisy.advance(renderer, *scene, d, {});
  EXPECT_TRUE(is_noise_check(noisy.spp()));
  EXPECT_LE(std::sqrt(estimated_relmse(reference(*scene, d, static_cast<std::uint32_t>(noisy.spp())))), 0.1);
  int before = 0; // the check before that one
  while (next_noise_check(before) < noisy.spp()) before = next_noise_check(before);
  ASSERT_GT(before, 0);
  EXPECT_GT(std::sqrt(estimated_relmse(reference(*scene, d, static_cast<std::uint32_t>(before)))), 0.1);

  d.settings.stop.spp = before + 1; // the first of the rules
  Accumulation both(d.settings.film, {.coarsest = 8});
  both.advance(renderer, *scene, d, {});
  EXPECT_EQ(both.spp(), before + 1);

  d.settings.stop = {0, 0, 0};
  d.settings.adaptive = {0.5f, 4};
  Accumulation adaptive(d.settings.film, {.coarsest = 4});
  EXPECT_TRUE(adaptive.advance(renderer, *scene, d, {}));
  EXPECT_TRUE(adaptive.converged());
  Film expected(kWidth, kHeight);
  while (!render_pass(*scene, d, {0, 1u << 16}, expected, {}).converged) {}
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_TRUE(adaptive.film().stopped(x, y));
      ASSERT_EQ(adaptive.film().count(x, y), expected.count(x, y));
      ASSERT_EQ(adaptive.film().mean(x, y), expected.mean(x, y));
    }
}

TEST(AccumulationRender, TheTimeEndsAPassButNotAFirstOneThatIsToBeWhole) {
  Document d = small_document(0);
  d.settings.stop.time = 1e-6f; // over before anything is rendered
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  Accumulation cut(d.settings.film, {.coarsest = 8});
  EXPECT_TRUE(cut.advance(renderer, *scene, d, {}));
  EXPECT_EQ(cut.spp(), 0);
  Accumulation whole(d.settings.film, {.coarsest = 8, .whole_first_pass = true});
  EXPECT_TRUE(whole.advance(renderer, *scene, d, {}));
  EXPECT_EQ(whole.spp(), 1);
  EXPECT_EQ(whole.rays().samples, 1u * kWidth * kHeight);
  EXPECT_EQ(whole.fraction(d.settings.stop), 1);
}

TEST(AccumulationRender, AnOpenPassIsCompletedBeyondALoweredSampleCount) {
  Document d = small_document(9);
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  Accumulation a(d.settings.film, {});
  d.settings.stop.spp = 5;
  a.advance(renderer, *scene, d, {});
  d.settings.stop.spp = 6;
  /// Half of a pass.
  struct Half final : PassRenderer {
    PassResult render(const PassJob& job, const PassFilms& films, const StopCondition& stop) override {
      PassJob part = job;
      part.window = {0, 0, kWidth, kHeight / 2};
      PassResult result = CpuPassRenderer().render(part, films, stop);
      result.completed = false;
      return result;
    }
  } half;
  a.step(a.next(d.settings.stop, {}), half, *scene, d, StopCondition());
  EXPECT_TRUE(a.open());
  d.settings.stop.spp = 3;
  EXPECT_FALSE(a.finished(d.settings.stop));
  EXPECT_TRUE(a.advance(renderer, *scene, d, {}));
  EXPECT_TRUE(a.film() == reference(*scene, d, 6));
}

TEST(AccumulationRender, IsToldToStop) {
  const Document d = small_document(0); // endless
  auto scene = RenderScene::build(d);
  CpuPassRenderer renderer;
  std::atomic<bool> stop{false};
  Accumulation a(d.settings.film, {});
  Accumulation::Limits limits{stop, {1, 2}, [&](const Accumulation& now) { stop = now.spp() >= 7; }};
  EXPECT_FALSE(a.advance(renderer, *scene, d, limits));
  EXPECT_EQ(a.spp(), 8) << "1 + 1 + 2 + 2 + 2: how long a sample takes is known from the second pass";
}

} // namespace
