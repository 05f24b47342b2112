#pragma once
// Reconstruction filters: the weights of the film around a pixel.

#include "core/math.h"
#include "sampling/filter_type.h"
#include "sampling/warp.h"

#include <array>

namespace candela {

/// Offset from the pixel's centre, in pixels, and the weight of the sample there: f / (p * integral of f), so
/// that the mean of weight * radiance is the filtered image, without bias.
struct FilterSample {
  vec2 offset;
  float weight;
};

/// A filter along one axis, as a function of x in [-1, 1], the offset over the radius; 0 elsewhere. Not
/// normalised: see filter_integral().
///
/// box: 1. tent: 1 - |x|. gaussian: normal with a sigma of 1/3, cut off. blackman_harris: the four-term
/// window (Harris 1978, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform").
/// mitchell: the cubic of Mitchell & Netravali 1988, "Reconstruction Filters in Computer Graphics", eq. 8
/// with B = C = 1/3, of t = 2 x; negative for |x| > 4/7, which keeps edges sharp.
double filter_value(FilterType type, double x);
/// Of filter_value() over [-1, 1].
double filter_integral(FilterType type);

/// A separable filter, sampled by importance. Each sample counts for its own pixel alone: other renderers
/// splat a sample over all pixels that see it, which reuses it but correlates neighbours and makes an image
/// depend on its threads' order (Ernst, Stamminger & Greiner 2006, "Filter Importance Sampling").
///
/// box, tent and gaussian are sampled by inversion: every weight is 1. The density of blackman_harris and
/// mitchell is |f| at the nodes of a table and linear between them; the weight makes up for the difference,
/// so that the filter is exact. Mitchell's weights are +-1.145 but for that (1.18 beside its zeros), as its
/// |f| has 1.07 times f's integral an axis; the second moment of a pixel's samples is up by 1.31.
class PixelFilter {
public:
  /// `radius` > 0 is half the filter's full width, in pixels. A box tiles the film at 0.5; a tent is linear
  /// interpolation at 1; blackman_harris is usual at 1.5 to 2; Mitchell and Netravali's cubic has 2.
  PixelFilter(FilterType type, float radius);

  /// u in [0, 1)^2; the map of each axis is monotonic and keeps strata.
  FilterSample sample(vec2 u) const;

private:
  static constexpr std::size_t kCells = 64;
  struct AxisSample {
    float x, weight; ///< x over the radius
  };
  AxisSample sample_axis(float u) const;

  FilterType type_;
  float radius_;
  TruncatedGaussian gaussian_;
  // Of the tabulated filters, at kCells + 1 nodes from -1 to 1:
  std::array<float, kCells + 1> density_{}; ///< per unit of x
  std::array<float, kCells + 1> cdf_{};
};

} // namespace candela
