#pragma once
// Sums of samples, per pixel. One thread owns a pixel during a pass and adds its samples in their order, so
// the sums do not depend on how passes, tiles or threads divide the work.

#include "core/math.h"
#include "imaging/image.h"

#include <cstdint>
#include <vector>

namespace candela {

class Film {
public:
  Film() = default;
  /// Of a window of the frame that begins at `origin`; the coordinates of pixels count from there. A film of
  /// a part costs what the part costs. Its samples are those from index `first_sample` on.
  Film(int width, int height, ivec2 origin = ivec2(0), std::uint32_t first_sample = 0);

  /// Another window. What pixels hold afterwards is of no meaning until clear(); the memory is kept.
  void resize(int width, int height, ivec2 origin = ivec2(0), std::uint32_t first_sample = 0);
  /// Forgets the samples of the pixels whose x and y are multiples of `lattice`, but not both of
  /// `skip_lattice` (0: none is skipped), as a pass of that SampleRange visits them.
  void clear(int lattice = 1, int skip_lattice = 0);

  int width() const { return width_; }
  int height() const { return height_; }
  ivec2 origin() const { return origin_; }
  std::uint32_t first_sample() const { return first_sample_; }

  void add(int x, int y, vec3 radiance) {
    Pixel& p = pixel(x, y);
    for (int c = 0; c < 3; ++c) {
      double v = static_cast<double>(radiance[c]);
      p.sum[c] += v;
      p.sum_of_squares[c] += v * v;
    }
    if (p.count % 2 == 1) p.odd += radiance;
    ++p.count;
  }
  void add_nonfinite(int x, int y) { ++pixel(x, y).nonfinite; }

  /// The index of the pixel's next sample: as many as were added, finite or not, after first_sample().
  std::uint32_t tried(int x, int y) const {
    return first_sample_ + pixel(x, y).count + pixel(x, y).nonfinite;
  }
  bool has_samples(int x, int y) const { return tried(x, y) > first_sample_; }
  int count(int x, int y) const { return static_cast<int>(pixel(x, y).count); }
  vec3 mean(int x, int y) const; ///< 0 where there is no sample
  /// Of the mean, unbiased, per channel; 0 below two samples.
  vec3 variance_of_mean(int x, int y) const;

  /// Mean over the channels of variance_of_mean / (mean^2 + 0.01): the pixel's share of the expected relMSE.
  double relative_variance(int x, int y) const;
  /// Samples that were NaN or infinite and are in no sum.
  int nonfinite(int x, int y) const { return static_cast<int>(pixel(x, y).nonfinite); }
  /// Adaptive sampling has found the pixel good enough.
  bool stopped(int x, int y) const { return pixel(x, y).stopped; }
  void stop(int x, int y) { pixel(x, y).stopped = true; }

  /// What a pixel's samples add up to.
  struct Sums {
    glm::dvec3 sum{0}, sum_of_squares{0};
    vec3 odd{0}; ///< of the second, fourth, ... sample
  };
  /// The pixel becomes that of `counted`, with other sums (LayerFilm::mix).
  void set(int x, int y, const Sums& sums, const Film& counted);

  /// Adds the pixels of a film whose window lies within this one's: `later` holds the samples that come next.
  void append(const Film& later);

  /// All bits that a film is of.
  bool operator==(const Film&) const = default;

  Image image() const;
  Image variance_image() const;
  /// Mean of every other sample, beginning with the first (half = 0) or the second (1): two estimates of the
  /// same image that share no sample, as denoisers want them. 0 where there is none.
  Image half_image(int half) const;

private:
  struct Pixel { ///< doubles, so that a million samples lose nothing
    double sum[3] = {0, 0, 0};
    double sum_of_squares[3] = {0, 0, 0};
    vec3 odd{0}; ///< sum of the second, fourth, ... sample; floats suffice for a denoiser
    std::uint32_t count = 0;
    std::uint32_t nonfinite : 31 = 0;
    std::uint32_t stopped : 1 = 0;

    bool operator==(const Pixel&) const = default;
  };
  Pixel& pixel(int x, int y) { return const_cast<Pixel&>(static_cast<const Film&>(*this).pixel(x, y)); }
  const Pixel& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }

  int width_ = 0, height_ = 0;
  ivec2 origin_{0};
  std::uint32_t first_sample_ = 0;
  std::vector<Pixel> pixels_;
};

} // namespace candela
