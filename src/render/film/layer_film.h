#pragma once
// The radiance of each light layer (scene/light_layers.h), per pixel: a picture that can be mixed anew
// without new samples.

#include "render/film/film.h"

#include <span>

namespace candela {

/// Beside a Film that has the same samples, summed over the layers, and counts them. With the sum S of a
/// pixel's samples x = (x_1, ..., x_L) and the sum P of their products x x^T, a mix w x has the sum w S and
/// the sum of squares w P w^T: mean and variance of every mix are those that its own samples would give, but
/// for the rounding to floats in P.
class LayerFilm {
public:
  /// Of no layers.
  LayerFilm() = default;

  /// Another window, as Film::resize(); what pixels hold afterwards is of no meaning until clear().
  void resize(std::size_t layers, int width, int height);
  void clear(int lattice = 1, int skip_lattice = 0);

  std::size_t layers() const { return layers_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// The layers of a sample; `index`: how many samples the pixel has so far.
  void add(int x, int y, int index, std::span<const vec3> sample);
  /// As Film::append(), of the films that they are beside of, before those are.
  void append(const LayerFilm& later, const Film& film, const Film& later_film);

  /// Mean of a layer, at factor 1; 0 where there is no sample.
  vec3 mean(const Film& film, int x, int y, std::size_t layer) const;
  Image image(const Film& film, std::size_t layer) const;
  /// The film that has the samples of the mix, of layers() factors, in place of `film`'s: of the pixels whose
  /// x and y are multiples of `lattice`; the others mean nothing. `out` is kept memory.
  void mix(const Film& film, std::span<const vec3> factors, Film& out, int lattice = 1) const;

  bool operator==(const LayerFilm&) const = default;

private:
  std::size_t pairs() const { return layers_ * (layers_ + 1) / 2; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  std::size_t layers_ = 0;
  int width_ = 0, height_ = 0;
  // Of the pixels, one after the other:
  std::vector<glm::dvec3> sums_; ///< by layer
  std::vector<vec3> odd_;        ///< by layer, of the second, fourth, ... sample
  std::vector<vec3> products_;   ///< of layers i <= j, by j, then i
};

} // namespace candela
