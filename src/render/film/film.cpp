#include "render/film/film.h"

#include "imaging/compare.h"

namespace candela {

Film::Film(int width, int height, ivec2 origin, std::uint32_t first_sample) {
  resize(width, height, origin, first_sample);
}

void Film::resize(int width, int height, ivec2 origin, std::uint32_t first_sample) {
  width_ = width;
  height_ = height;
  origin_ = origin;
  first_sample_ = first_sample;
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

void Film::clear(int lattice, int skip_lattice) {
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height_; y += lattice)
    for (int x = 0; x < width_; x += lattice)
      if (skip_lattice == 0 || x % skip_lattice != 0 || y % skip_lattice != 0) pixel(x, y) = Pixel();
}

vec3 Film::mean(int x, int y) const {
  const Pixel& p = pixel(x, y);
  if (p.count == 0) return vec3(0);
  double n = p.count;
  return {static_cast<float>(p.sum[0] / n), static_cast<float>(p.sum[1] / n),
          static_cast<float>(p.sum[2] / n)};
}

vec3 Film::variance_of_mean(int x, int y) const {
  const Pixel& p = pixel(x, y);
  if (p.count < 2) return vec3(0);
  double n = p.count;
  vec3 v;
  for (int c = 0; c < 3; ++c)
    v[c] = static_cast<float>(std::max(p.sum_of_squares[c] - p.sum[c] * p.sum[c] / n, 0.0) / (n * (n - 1)));
  return v;
}

double Film::relative_variance(int x, int y) const {
  return candela::relative_variance(mean(x, y), variance_of_mean(x, y));
}

void Film::set(int x, int y, const Sums& sums, const Film& counted) {
  Pixel& p = pixel(x, y);
  p = counted.pixel(x, y);
  for (int c = 0; c < 3; ++c) {
    p.sum[c] = sums.sum[c];
    p.sum_of_squares[c] = sums.sum_of_squares[c];
  }
  p.odd = sums.odd;
}

void Film::append(const Film& later) {
  const ivec2 shift = later.origin_ - origin_;
  for (int y = 0; y < later.height_; ++y)
    for (int x = 0; x < later.width_; ++x) {
      const Pixel& from = later.pixel(x, y);
      Pixel& to = pixel(x + shift.x, y + shift.y);
      // After an odd number of samples, the later ones that were first, third, ... are second, fourth, ...
      vec3 odd = from.odd;
      if (to.count % 2 == 1)
        for (int c = 0; c < 3; ++c)
          odd[c] = static_cast<float>(from.sum[c] - static_cast<double>(from.odd[c]));
      to.odd += odd;
      for (int c = 0; c < 3; ++c) {
        to.sum[c] += from.sum[c];
        to.sum_of_squares[c] += from.sum_of_squares[c];
      }
      to.count += from.count;
      to.nonfinite += from.nonfinite;
      to.stopped |= from.stopped;
    }
}

Image Film::image() const {
  Image out{width_, height_, {}};
  out.pixels.reserve(pixels_.size());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out.pixels.push_back(mean(x, y));
  return out;
}

Image Film::half_image(int half) const {
  Image out{width_, height_, {}};
  out.pixels.reserve(pixels_.size());
  for (const Pixel& p : pixels_) {
    std::uint32_t odd = p.count / 2, n = half == 0 ? p.count - odd : odd;
    vec3 mean(0);
    for (int c = 0; n > 0 && c < 3; ++c) {
      double sum = static_cast<double>(p.odd[c]);
      mean[c] = static_cast<float>((half == 0 ? p.sum[c] - sum : sum) / n);
    }
    out.pixels.push_back(mean);
  }
  return out;
}

Image Film::variance_image() const {
  Image out{width_, height_, {}};
  out.pixels.reserve(pixels_.size());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out.pixels.push_back(variance_of_mean(x, y));
  return out;
}

} // namespace candela
