#pragma once
// The opening of a lens: round, or the polygon that its blades leave.

#include "core/math.h"
#include "sampling/warp.h"

#include <array>

namespace candela {

/// The unit disc, or a regular polygon with its corners on the unit circle. Which one, and how it is turned,
/// is seen in the shape of a small light out of focus.
class Aperture {
public:
  static constexpr int kMaxBlades = 16;

  Aperture() = default;
  /// Below three blades it is round. Without rotation a corner is at +y; it turns counter-clockwise
  /// (radians).
  Aperture(int blades, float rotation) : blades_(blades < 3 ? 0 : std::min(blades, kMaxBlades)) {
    for (int i = 0; i <= blades_ && blades_ > 0; ++i) { // in double, so that the floats are the same anywhere
      const double angle = static_cast<double>(rotation) +
                           2 * std::numbers::pi * ((i % blades_) / static_cast<double>(blades_) + 0.25);
      corners_[static_cast<std::size_t>(i)] = {static_cast<float>(std::cos(angle)),
                                               static_cast<float>(std::sin(angle))};
    }
  }

  int blades() const { return blades_; } ///< 0: round

  float area() const {
    if (blades_ == 0) return kPi;
    const auto n = static_cast<float>(blades_);
    return 0.5f * n * std::sin(2 * kPi / n);
  }

  /// A point of the opening for u in [0, 1)^2, uniform by area: the density is 1 / area(). The polygon is the
  /// disc of the concentric map (sampling/warp.h) with each of its wedges made a triangle: a point at radius
  /// r and the share f of the wedge's angle goes to r ((1 - f) corner_i + f corner_(i+1)). The area element
  /// is r dr df times a constant there and here, so the map keeps areas (up to that factor); it is continuous
  /// too.
  vec2 sample(vec2 u) const {
    if (blades_ == 0) return sample_uniform_disc(u);
    const vec2 p = 2.0f * u - 1.0f;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    if (radius == 0) return vec2(0);
    const float eighth = 0.125f * ((wide ? p.y : p.x) / radius); // of a turn, within +-1/8
    float turn = wide ? eighth : 0.25f - eighth;
    if (radius < 0) turn += 0.5f;
    if (turn < 0) turn += 1;
    const float at = turn * static_cast<float>(blades_);
    const int wedge = std::min(static_cast<int>(at), blades_ - 1);
    const float f = at - static_cast<float>(wedge);
    const auto i = static_cast<std::size_t>(wedge);
    return std::abs(radius) * (corners_[i] + f * (corners_[i + 1] - corners_[i]));
  }

private:
  int blades_ = 0;
  std::array<vec2, kMaxBlades + 1> corners_{}; ///< the first again at the end
};

} // namespace candela
