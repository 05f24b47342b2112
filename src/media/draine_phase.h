#pragma once
// Draine 2003, "Scattering by Interstellar Dust Grains. II", equation 4; and what is made of it.

#include "media/henyey_greenstein_phase.h"

namespace candela {

/// Henyey and Greenstein's times 1 + alpha cos^2(theta):
///     p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)) x (1 + alpha cos^2) / (1 + alpha (1 + 2 g^2) / 3).
/// Rayleigh's with g = 0 and alpha = 1.
class Draine {
public:
  /// g in [-HenyeyGreenstein::kMost, HenyeyGreenstein::kMost], alpha >= 0. A g that is almost 0 is 0.
  Draine(float g, float alpha)
      : lobe_{std::abs(g) < kLeast ? 0 : g}, alpha_(alpha),
        scale_(1 / (1 + alpha * (1 + 2 * sqr(lobe_.g)) / 3)) {}

  float eval(Turn turn) const { return lobe_.eval(turn) * (1 + alpha_ * sqr(turn.cosine())) * scale_; }
  /// By inversion: Newton's method between bounds, from Henyey and Greenstein's turn.
  Turn sample(float u, float choice) const;
  float mean_cosine() const {
    const float g = lobe_.g;
    return g * (1 + alpha_ * (3 + 2 * g * g) / 5) * scale_;
  }

private:
  static constexpr float kLeast = 1e-3f;

  HenyeyGreenstein lobe_;
  float alpha_, scale_;
};

/// Rayleigh 1871: particles much smaller than the wavelength, p = 3 / (16 pi) (1 + cos^2).
struct Rayleigh {
  float eval(Turn turn) const { return 3 * kInvPi / 16 * (1 + sqr(turn.cosine())); }
  /// The cosine c solves c^3 + 3 c = 4 - 8 u (Cardano).
  Turn sample(float u, float) const {
    const float q = 2 - 4 * u, root = std::sqrt(q * q + 1);
    // The greater of the two terms first: the other is its negative inverse.
    const float a = std::copysign(std::cbrt(std::abs(q) + root), q);
    return Turn::from_forward(std::clamp(1 - (a - 1 / a), 0.0f, 2.0f));
  }
  float mean_cosine() const { return 0; }
};

struct RayleighPhase {
  bool operator==(const RayleighPhase&) const = default;

  static constexpr std::string_view kName = "rayleigh";
  static constexpr std::string_view kHelp = "by particles much smaller than the wavelength, as of clear air";
  static constexpr auto rows() { return std::array<PhaseRow<RayleighPhase>, 0>{}; }
  Rayleigh closure() const { return {}; }
};

/// A share of Draine's function, and the rest of Henyey and Greenstein's.
struct HenyeyGreensteinDraine {
  HenyeyGreenstein lobe;
  Draine draine;
  float draine_share;

  float eval(Turn turn) const {
    return (1 - draine_share) * lobe.eval(turn) + draine_share * draine.eval(turn);
  }
  Turn sample(float u, float choice) const {
    return choice < draine_share ? draine.sample(u, 0) : lobe.sample(u, 0);
  }
  float mean_cosine() const {
    return (1 - draine_share) * lobe.mean_cosine() + draine_share * draine.mean_cosine();
  }
};

/// Drops of water as fog and clouds have them, by the fit of Jendersie & d'Eon 2023, "An Approximate Mie
/// Scattering Function for Fog and Cloud Rendering", to Mie's theory.
struct DropletsPhase {
  float diameter = 15; ///< micrometres
  bool operator==(const DropletsPhase&) const = default;

  static constexpr std::string_view kName = "droplets";
  static constexpr std::string_view kHelp = "by drops of water, as of fog and clouds";
  static constexpr auto rows() {
    return std::array{PhaseRow<DropletsPhase>{
        {"diameter", FieldType::real, 5, 50, "micrometres", "Diameter of the drops; fog about 10, clouds 20"},
        &DropletsPhase::diameter}};
  }
  /// Equations 4 to 7, for diameters from 5 to 50 micrometres.
  HenyeyGreensteinDraine closure() const {
    const float d = diameter;
    const float g_hg = std::exp(-0.0990567f / (d - 1.67154f));
    const float g_draine = std::exp(-2.20679f / (d + 3.91029f) - 0.428934f);
    const float alpha = std::exp(3.62489f - 8.29288f / (d + 5.52825f));
    const float share = std::exp(-0.599085f / (d - 0.641583f) - 0.665888f);
    return {{g_hg}, {g_draine, alpha}, share};
  }
};

} // namespace candela
