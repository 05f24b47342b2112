#include "render/film.h"

namespace candela {

Film::Film(int width, int height)
    : width_(width), height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

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

Image Film::image() const {
  Image out{width_, height_, {}};
  resolve(1, out.pixels);
  return out;
}

Image Film::variance_image() const {
  Image out{width_, height_, {}};
  out.pixels.reserve(pixels_.size());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out.pixels.push_back(variance_of_mean(x, y));
  return out;
}

void Film::resolve(int coarseness, std::vector<vec3>& out) const {
  out.resize(pixels_.size());
  std::size_t i = 0;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, ++i)
      out[i] = coarseness == 1 || count(x, y) > 0 ? mean(x, y) : mean(x - x % coarseness, y - y % coarseness);
}

} // namespace candela
