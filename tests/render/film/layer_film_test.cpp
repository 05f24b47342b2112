// Light layers of a film: any mix of them is what its own samples would give.

#include "render/film/layer_film.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

using test::fresh_seed;
using test::seed_note;

constexpr std::size_t kLayers = 3;

struct Sample {
  ivec2 pixel;
  std::array<vec3, kLayers> layers;
};

std::vector<Sample> random_samples(int width, int height, int per_pixel, std::mt19937_64& random) {
  std::exponential_distribution<float> value(1);
  std::vector<Sample> samples;
  for (int i = 0; i < per_pixel; ++i)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        Sample& s = samples.emplace_back(Sample{{x, y}, {}});
        const float common = value(random); // layers of a sample are correlated
        for (vec3& layer : s.layers)
          if (random() % 3 != 0) layer = {common * value(random), value(random), 0.1f + common};
      }
  return samples;
}

struct Films {
  Film film;
  LayerFilm layers;

  Films(int width, int height, ivec2 origin = ivec2(0), std::uint32_t first = 0)
      : film(width, height, origin, first) {
    layers.resize(kLayers, width, height);
  }
  void add(const Sample& s, ivec2 shift = ivec2(0)) {
    const ivec2 at = s.pixel - shift;
    layers.add(at.x, at.y, film.count(at.x, at.y), s.layers);
    film.add(at.x, at.y, s.layers[0] + s.layers[1] + s.layers[2]);
  }
  Film mixed(const std::array<vec3, kLayers>& factors) const {
    Film out;
    layers.mix(film, factors, out);
    return out;
  }
};

void expect_near(vec3 a, vec3 b, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], relative * (1e-3f + std::abs(b[c])));
}

void expect_same_samples(const Film& a, const Film& b) {
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  const Image halves[2][2] = {{a.half_image(0), a.half_image(1)}, {b.half_image(0), b.half_image(1)}};
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      EXPECT_EQ(a.count(x, y), b.count(x, y));
      EXPECT_EQ(a.tried(x, y), b.tried(x, y));
      expect_near(a.mean(x, y), b.mean(x, y), 1e-6f);
      // Sums of squares are floats, to which n values are added: each rounding is relative to the sum, which
      // the variance is only a part of.
      const float n = static_cast<float>(a.count(x, y)), rounding = 2 * (n + 8) * 0x1p-24f;
      const vec3 mean = b.mean(x, y), variance = b.variance_of_mean(x, y);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a.variance_of_mean(x, y)[c], variance[c],
                    rounding * (variance[c] + sqr(mean[c]) / std::max(n - 1, 1.0f)));
      // Odd samples are kept as floats, and the even ones are what is left of the sum: the error of both is
      // one of rounding of the larger, also where the other is 0.
      const vec3 larger = glm::max(glm::abs(halves[1][0].at(x, y)), glm::abs(halves[1][1].at(x, y)));
      for (int half : {0, 1})
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(halves[0][half].at(x, y)[c], halves[1][half].at(x, y)[c], 1e-5f * larger[c]);
    }
}

TEST(LayerFilm, AMixIsTheFilmOfItsOwnSamples) {
  std::mt19937_64 random(fresh_seed());
  SCOPED_TRACE(seed_note());
  for (int count : {1, 2, 5, 64}) {
    const std::array<vec3, kLayers> factors{vec3(0), vec3(0.25f, 1, 7), vec3(3)};
    Films kept(3, 2);
    Film expected(3, 2);
    for (const Sample& s : random_samples(3, 2, count, random)) {
      kept.add(s);
      vec3 sum(0);
      for (std::size_t i = 0; i < kLayers; ++i) sum += factors[i] * s.layers[i];
      expected.add(s.pixel.x, s.pixel.y, sum);
    }
    expect_same_samples(kept.mixed(factors), expected);
    expect_same_samples(kept.mixed({vec3(1), vec3(1), vec3(1)}), kept.film);
    EXPECT_EQ(kept.mixed({vec3(0), vec3(0), vec3(1)}).image().pixels, kept.layers.image(kept.film, 2).pixels);
    EXPECT_EQ(kept.mixed({vec3(0), vec3(0), vec3(0)}).mean(1, 1), vec3(0));
  }
}

TEST(LayerFilm, LaterSamplesOfAPartAreAppended) {
  std::mt19937_64 random(fresh_seed());
  SCOPED_TRACE(seed_note());
  for (int before : {2, 3}) {
    Films whole(4, 3), first(4, 3), later(2, 2, {1, 1}, static_cast<std::uint32_t>(before));
    for (const Sample& s : random_samples(4, 3, before, random)) whole.add(s), first.add(s);
    for (const Sample& s : random_samples(4, 3, 5, random))
      if (s.pixel.x >= 1 && s.pixel.x < 3 && s.pixel.y >= 1) whole.add(s), later.add(s, {1, 1});
    first.layers.append(later.layers, first.film, later.film);
    first.film.append(later.film);
    const std::array<vec3, kLayers> factors{vec3(2), vec3(0, 1, 0.5f), vec3(1)};
    expect_same_samples(first.mixed(factors), whole.mixed(factors));
  }
}

TEST(LayerFilm, ClearsWhatAPassVisits) {
  std::mt19937_64 random(fresh_seed());
  Films kept(5, 5);
  for (const Sample& s : random_samples(5, 5, 1, random)) kept.add({s.pixel, {vec3(1), vec3(1), vec3(1)}});
  kept.layers.clear(2, 4);
  const Image image = kept.layers.image(kept.film, 1);
  EXPECT_EQ(image.at(2, 0), vec3(0));
  EXPECT_EQ(image.at(2, 4), vec3(0));
  EXPECT_EQ(image.at(4, 4), vec3(1)) << "skipped";
  EXPECT_EQ(image.at(1, 2), vec3(1));
  kept.layers.clear();
  Films fresh(5, 5);
  EXPECT_EQ(kept.layers, fresh.layers);
}

} // namespace
} // namespace candela
