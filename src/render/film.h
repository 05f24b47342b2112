#pragma once
// Sums of samples, per pixel. One thread owns a pixel during a pass and adds its samples in their order, so
// the sums do not depend on how passes, tiles or threads divide the work.

#include "render/frame.h"

namespace candela {

class Film {
public:
  Film() = default;
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  void add(int x, int y, vec3 radiance) {
    Pixel& p = pixel(x, y);
    for (int c = 0; c < 3; ++c) {
      double v = static_cast<double>(radiance[c]);
      p.sum[c] += v;
      p.sum_of_squares[c] += v * v;
    }
    ++p.count;
  }

  int count(int x, int y) const { return static_cast<int>(pixel(x, y).count); }
  vec3 mean(int x, int y) const; ///< 0 where there is no sample
  /// Of the mean, unbiased, per channel; 0 below two samples.
  vec3 variance_of_mean(int x, int y) const;

  Image image() const;
  Image variance_image() const;
  /// The mean with the holes of a coarse first pass filled from the top left pixel of each block.
  void resolve(int coarseness, std::vector<vec3>& out) const;

private:
  struct Pixel { ///< doubles, so that a million samples lose nothing
    double sum[3] = {0, 0, 0};
    double sum_of_squares[3] = {0, 0, 0};
    std::uint32_t count = 0;
  };
  Pixel& pixel(int x, int y) { return const_cast<Pixel&>(static_cast<const Film&>(*this).pixel(x, y)); }
  const Pixel& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }

  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

} // namespace candela
