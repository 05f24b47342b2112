#pragma once

#include "media/phase_model.h"

namespace candela {

/// Henyey & Greenstein 1941, "Diffuse radiation in the galaxy":
///     p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos(theta))^(3/2)).
struct HenyeyGreenstein {
  float g; ///< in [-kMost, kMost]
  static constexpr float kMost = 0.999f;

  // With the distance v = 1 - |cos(theta)| from the peak, 1 + g^2 - 2 g cos(theta) = (1 - |g|)^2 + 2 |g| v.
  float eval(Turn turn) const {
    const float d = sqr(1 - std::abs(g)) + 2 * std::abs(g) * (g < 0 ? turn.backward : turn.forward);
    return 0.25f * kInvPi * (1 - g * g) / (d * std::sqrt(d));
  }
  /// The inverse of the distribution of cosines, written such that nothing cancels near the peak: with s^2 =
  /// 1 + g^2 - 2 g cos(theta) = ((1 - g^2) / (1 + g - 2 g u))^2, v = (s^2 - (1 - g)^2) / (2 g) has the factor
  /// s - (1 - g) = 2 g u (1 - g) / (1 + g - 2 g u), for g > 0.
  Turn sample(float u, float) const {
    const float a = std::abs(g), below = 1 + a - 2 * a * u, s = (1 - a * a) / below;
    const Turn turn = Turn::from_forward(std::min(u * (1 - a) * (s + 1 - a) / below, 2.0f));
    return g < 0 ? turn.reversed() : turn;
  }
  float mean_cosine() const { return g; }
};

/// A narrow lobe around one direction: forward for g > 0, backward for g < 0.
struct HenyeyGreensteinPhase {
  float g = 0;
  bool operator==(const HenyeyGreensteinPhase&) const = default;

  static constexpr std::string_view kName = "henyey_greenstein";
  static constexpr std::string_view kHelp = "mostly forward (g > 0) or backward (g < 0)";
  static constexpr auto rows() {
    return std::array{PhaseRow<HenyeyGreensteinPhase>{
        {"g", FieldType::real, -0.999, 0.999, "",
         "Mean cosine of the angle by which light turns: 0 all directions alike, 1 straight on"},
        &HenyeyGreensteinPhase::g}};
  }
  HenyeyGreenstein closure() const { return {g}; }
};

} // namespace candela
