// The same bits for any number of threads, passes, order, crops and replays.

#include "render/media_testing.h"
#include "render/strategy_scenes.h"

namespace {

using namespace candela;
using namespace candela::test;

const std::atomic<bool> kNeverStop{false};

/// Sums and squares of sums, by what the film tells: equal bits of both make equal films in all that is
/// shown.
void expect_equal_pixel(const Film& a, const Film& b, int ax, int ay, int bx, int by) {
  ASSERT_EQ(a.count(ax, ay), b.count(bx, by));
  ASSERT_EQ(a.mean(ax, ay), b.mean(bx, by)) << ax << ", " << ay;
  ASSERT_EQ(a.variance_of_mean(ax, ay), b.variance_of_mean(bx, by)) << ax << ", " << ay;
}
void expect_equal(const Film& a, const Film& b) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) expect_equal_pixel(a, b, x, y, x, y);
}

std::vector<Document> documents() {
  std::vector<Document> all;
  int type = 0;
  for (NamedScene& s : strategy_scenes()) {
    s.document.settings.film.width = 37; // no multiple of a tile
    s.document.settings.film.height = 21;
    s.document.settings.sampler.type = static_cast<SamplerType>(type++ % 3);
    s.document.settings.sampler.seed = sampler_seed(7);
    s.document.scene.camera.aperture_radius = 0.01f;
    all.push_back(s.document);
  }
  Document fog = foggy_room(21, 1, true).document;
  fog.settings.film.width = 37;
  fog.settings.sampler.seed = sampler_seed(8);
  all.push_back(fog);
  return all;
}

Film film_of(const RenderScene& scene, const Document& d, const std::vector<SampleRange>& ranges,
             const PassOptions& options) {
  Film film(d.settings.film.width, d.settings.film.height);
  for (const SampleRange& range : ranges)
    EXPECT_TRUE(render_pass(scene, d, range, film, kNeverStop, options).completed);
  return film;
}

TEST(DeterminismRender, ThreadsPortionsAndLatticesMakeNoDifference) {
  for (const Document& d : documents()) {
    auto scene = RenderScene::build(d);
    PassOptions one{1, {}}, two{2, {}}, five{5, {}};
    Film plain = film_of(*scene, d, {{0, 6}}, one);
    expect_equal(film_of(*scene, d, {{0, 6}}, two), plain);
    expect_equal(film_of(*scene, d, {{0, 6}}, five), plain);
    expect_equal(film_of(*scene, d, {{0, 1}, {1, 2}, {2, 5}, {5, 6}}, five), plain);
    expect_equal(film_of(*scene, d, {{0, 1, 8, 0}, {0, 1, 4, 8}, {0, 1, 2, 4}, {0, 1, 1, 2}, {1, 6}}, two),
                 plain);
  }
}

TEST(DeterminismRender, BuildingAgainMakesNoDifference) {
  Document d = documents()[4];
  auto first = RenderScene::build(d);
  auto reused = RenderScene::build(d, first.get());
  EXPECT_EQ(&reused->geometry(), &first->geometry());
  expect_equal(film_of(*RenderScene::build(d), d, {{0, 2}}, {}), film_of(*first, d, {{0, 2}}, {}));
  expect_equal(film_of(*reused, d, {{0, 2}}, {}), film_of(*first, d, {{0, 2}}, {}));
  Document moved = d;
  moved.scene.instances[0].world_from_object[3].y -= 0.5f;
  auto rebuilt = RenderScene::build(moved, first.get());
  EXPECT_NE(&rebuilt->geometry(), &first->geometry());
  expect_equal(film_of(*rebuilt, moved, {{0, 2}}, {}),
               film_of(*RenderScene::build(moved), moved, {{0, 2}}, {}));
}

TEST(DeterminismRender, ALatticeVisitsEveryPixelOnce) {
  Document d = documents()[0];
  auto scene = RenderScene::build(d);
  Film film(37, 21);
  int done = 0;
  for (SampleRange range :
       {SampleRange{0, 1, 8, 0}, SampleRange{0, 1, 4, 8}, SampleRange{0, 1, 2, 4}, SampleRange{0, 1, 1, 2}}) {
    auto pass = render_pass(*scene, d, range, film, kNeverStop);
    done += static_cast<int>(pass.rays.samples);
    for (int y = 0; y < 21; ++y)
      for (int x = 0; x < 37; ++x)
        ASSERT_EQ(film.count(x, y), x % range.lattice == 0 && y % range.lattice == 0 ? 1 : 0);
  }
  EXPECT_EQ(done, 37 * 21);
}

TEST(DeterminismRender, ACropIsAWindowOfTheWhole) {
  Document d = documents()[3];
  auto scene = RenderScene::build(d);
  Film whole = film_of(*scene, d, {{0, 3}}, {});
  CropWindow crop{5, 3, 20, 17};
  Film part = film_of(*scene, d, {{0, 3}}, {2, crop});
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) {
      bool inside = x >= 5 && x < 25 && y >= 3 && y < 20;
      if (inside)
        expect_equal_pixel(part, whole, x, y, x, y);
      else
        ASSERT_EQ(part.count(x, y), 0);
    }
  Film over = film_of(*scene, d, {{0, 1}}, {2, {30, 15, 100, 100}}); // reaches beyond the film
  EXPECT_EQ(over.count(36, 20), 1);
  EXPECT_EQ(over.count(29, 20), 0);
  Film beside = film_of(*scene, d, {{0, 1}}, {2, {100, 0, 5, 5}});
  EXPECT_EQ(beside.count(36, 20), 0);
}

TEST(DeterminismRender, ASampleReplaysAlone) {
  for (const Document& d : documents()) {
    auto scene = RenderScene::build(d);
    Film film(37, 21);
    render_pass(*scene, d, {5, 6}, film, kNeverStop);
    int lit = 0;
    for (unsigned y = 0; y < 21; ++y)
      for (unsigned x = 0; x < 37; ++x) {
        const vec3 again = replay_sample(*scene, d, {x, y}, 5);
        ASSERT_EQ(again, film.mean(static_cast<int>(x), static_cast<int>(y)));
        lit += !is_black(again);
      }
    EXPECT_GT(lit, 20); // of the darkest scene a quarter of 777 is
  }
}

TEST(DeterminismRender, AnotherSeedIsAnotherImage) {
  Document d = documents()[0];
  auto scene = RenderScene::build(d);
  Film a = film_of(*scene, d, {{0, 1}}, {});
  d.settings.sampler.seed ^= 1;
  Film b = film_of(*scene, d, {{0, 1}}, {});
  int different = 0;
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) different += a.mean(x, y) != b.mean(x, y);
  EXPECT_GT(different, 200);
}

TEST(DeterminismRender, AStopSetBeforehandLeavesTheFilmEmpty) {
  Document d = documents()[0];
  auto scene = RenderScene::build(d);
  Film film(37, 21);
  std::atomic<bool> stop{true};
  EXPECT_FALSE(render_pass(*scene, d, {0, 4}, film, stop).completed);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) ASSERT_EQ(film.count(x, y), 0);
}

// --- Samples that are not finite ---

/// A wall that shines with 3e38 and mirrors itself in another one: one emission is a float, two are not.
SceneMaker overflowing() {
  SceneMaker s(19, 17, 1);
  Material m;
  m.model = MirrorMaterial();
  m.emission = vec3{3e38f, 0, 0};
  int mat = s.material(m);
  s.rectangle({0, 0, 0}, {0, 0.01f, 0}, {0.01f, 0, 0}, mat);  // facing -z, the camera's way
  s.rectangle({0, 0, -1}, {0.01f, 0, 0}, {0, 0.01f, 0}, mat); // facing it
  s.camera({0, 0, -0.5f}, {0, 0, 0}, 0.5f);
  return s;
}

TEST(NonFiniteRender, IsCountedLocatedAndKeptOutOfTheFilm) {
  SceneMaker s = overflowing();
  auto scene = RenderScene::build(s.document);
  for (int threads : {1, 3}) {
    Film film(19, 17);
    PassResult result = render_pass(*scene, s.document, {3, 5}, film, kNeverStop, {threads, {}});
    EXPECT_TRUE(result.completed);
    ASSERT_GT(result.nonfinite.count, NonFiniteLog::kMaxRecords);
    ASSERT_EQ(result.nonfinite.records.size(), NonFiniteLog::kMaxRecords);
    std::uint64_t in_film = 0;
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 19; ++x) {
        in_film += static_cast<std::uint64_t>(film.count(x, y));
        EXPECT_TRUE(is_finite(film.mean(x, y)));
        EXPECT_TRUE(is_finite(film.variance_of_mean(x, y)));
      }
    EXPECT_EQ(in_film + result.nonfinite.count, result.rays.samples);
    EXPECT_EQ(result.rays.samples, 2u * 19 * 17);
    for (const NonFiniteSample& bad : result.nonfinite.records) {
      EXPECT_LT(bad.pixel.x, 19u);
      EXPECT_GE(bad.sample, 3u);
      EXPECT_LT(bad.sample, 5u);
      EXPECT_FALSE(is_finite(replay_sample(*scene, s.document, bad.pixel, bad.sample)));
      EXPECT_EQ(bad.depth, 2); // the emission seen in the mirror
    }
    EXPECT_EQ(result.nonfinite.records[0].pixel, uvec2(0, 0));
    EXPECT_EQ(result.nonfinite.records[0].sample, 3u);
    EXPECT_EQ(result.nonfinite.records[1].sample, 4u);
  }
}

TEST(NonFiniteRender, HugeValuesThatAreStillFloatsCount) {
  SceneMaker s(8, 8, 1);
  s.rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, s.diffuse(vec3(0.5f)));
  LightDesc l;
  l.model = PointLightModel{.position = {0, 0, 2}};
  l.color = vec3(1e9f);
  l.scale = 1e9f;
  s.document.scene.lights.push_back(l);
  s.document.scene.lights.push_back(l);
  s.camera({0, 0, 3}, {0, 0, 0}, 5);
  auto scene = RenderScene::build(s.document);
  Film film(8, 8);
  EXPECT_EQ(render_pass(*scene, s.document, {0, 1}, film, kNeverStop).nonfinite.count,
            0u); // huge, but floats
  EXPECT_GT(film.mean(4, 4).r, 1e15f);
}

} // namespace
