#include "render/film/layer_film.h"

#include <algorithm>
#include <cassert>

namespace candela {

void LayerFilm::resize(std::size_t layers, int width, int height) {
  layers_ = layers;
  width_ = width;
  height_ = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  sums_.resize(pixels * layers);
  odd_.resize(pixels * layers);
  products_.resize(pixels * pairs());
}

void LayerFilm::clear(int lattice, int skip_lattice) {
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height_; y += lattice)
    for (int x = 0; x < width_; x += lattice) {
      if (skip_lattice != 0 && x % skip_lattice == 0 && y % skip_lattice == 0) continue;
      std::fill_n(&sums_[index(x, y) * layers_], layers_, glm::dvec3(0));
      std::fill_n(&odd_[index(x, y) * layers_], layers_, vec3(0));
      std::fill_n(&products_[index(x, y) * pairs()], pairs(), vec3(0));
    }
}

void LayerFilm::add(int x, int y, int index_of_sample, std::span<const vec3> sample) {
  assert(sample.size() == layers_);
  glm::dvec3* sums = &sums_[index(x, y) * layers_];
  vec3* odd = &odd_[index(x, y) * layers_];
  vec3* products = &products_[index(x, y) * pairs()];
  for (std::size_t j = 0; j < layers_; ++j, products += j) {
    const vec3 value = sample[j];
    if (value == vec3(0)) continue; // as most are
    sums[j] += glm::dvec3(value);
    if (index_of_sample % 2 == 1) odd[j] += value;
    for (std::size_t i = 0; i <= j; ++i) products[i] += sample[i] * value;
  }
}

void LayerFilm::append(const LayerFilm& later, const Film& film, const Film& later_film) {
  if (layers_ == 0) return;
  const ivec2 shift = later_film.origin() - film.origin();
  for (int y = 0; y < later.height_; ++y)
    for (int x = 0; x < later.width_; ++x) {
      const std::size_t from = later.index(x, y), to = index(x + shift.x, y + shift.y);
      const bool swaps = film.count(x + shift.x, y + shift.y) % 2 == 1; // what was first is second
      for (std::size_t i = 0; i < layers_; ++i) {
        const glm::dvec3 sum = later.sums_[from * layers_ + i];
        const vec3 odd = later.odd_[from * layers_ + i];
        sums_[to * layers_ + i] += sum;
        odd_[to * layers_ + i] += swaps ? vec3(sum - glm::dvec3(odd)) : odd;
      }
      for (std::size_t i = 0; i < pairs(); ++i)
        products_[to * pairs() + i] += later.products_[from * pairs() + i];
    }
}

vec3 LayerFilm::mean(const Film& film, int x, int y, std::size_t layer) const {
  const int count = film.count(x, y);
  return count > 0 ? vec3(sums_[index(x, y) * layers_ + layer] / static_cast<double>(count)) : vec3(0);
}

Image LayerFilm::image(const Film& film, std::size_t layer) const {
  Image out{width_, height_, {}};
  out.pixels.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) out.pixels.push_back(mean(film, x, y, layer));
  return out;
}

void LayerFilm::mix(const Film& film, std::span<const vec3> factors, Film& out, int lattice) const {
  assert(factors.size() == layers_ && film.width() == width_ && film.height() == height_);
  out.resize(width_, height_, film.origin(), film.first_sample());
#pragma omp parallel for schedule(static)
  for (int y = 0; y < height_; y += lattice)
    for (int x = 0; x < width_; x += lattice) {
      const glm::dvec3* sums = &sums_[index(x, y) * layers_];
      const vec3* odd = &odd_[index(x, y) * layers_];
      const vec3* products = &products_[index(x, y) * pairs()];
      Film::Sums mixed;
      for (std::size_t j = 0; j < layers_; ++j, products += j) {
        const glm::dvec3 factor(factors[j]);
        mixed.sum += factor * sums[j];
        mixed.odd += factors[j] * odd[j];
        for (std::size_t i = 0; i <= j; ++i)
          mixed.sum_of_squares +=
              (i < j ? 2.0 : 1.0) * factor * glm::dvec3(factors[i]) * glm::dvec3(products[i]);
      }
      out.set(x, y, mixed, film);
    }
}

} // namespace candela
