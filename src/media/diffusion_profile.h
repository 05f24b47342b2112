#pragma once
// How light that enters a flat body at one point leaves it around that point: BSSRDF of distance alone.
//
// A profile is the density R(r), 1/(scene unit)^2, of what leaves at the distance r. All are the product of
// the share A that leaves at all and of a density over the plane that can be sampled exactly. They end where
// all but kProfileTail of the light has left, and what is beyond is divided among the rest.

#include "bsdf/coat_albedo.h"
#include "core/spectrum.h"

#include <array>

namespace candela {

inline constexpr float kProfileTail = 1e-4f;

/// Christensen & Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering":
///     R(r) = A s / (8 pi l r) (exp(-s r / l) + exp(-s r / (3 l)))
/// with the mean free path l and s = 1.9 - A + 3.5 (A - 0.8)^2, that of light that enters in all directions
/// (eq. 6). Fitted to Monte Carlo simulations of a half space.
class BurleyProfile {
public:
  /// The share 0 <= albedo <= 1 and the mean free path > 0, scene units.
  BurleyProfile(float albedo, float mean_free_path)
      : length_(mean_free_path / (1.9f - albedo + 3.5f * sqr(albedo - 0.8f))),
        first_(0.25f * -std::expm1(-kEnd)), all_(first_ + 0.75f * -std::expm1(-kEnd / 3)) {}

  float end() const { return kEnd * length_; }
  /// Density over the plane, 1/(scene unit)^2, of a distance up to end(); it is infinite at r = 0.
  float pdf(float r) const {
    const float x = std::max(r / length_, 1e-12f);
    return (std::exp(-x) + std::exp(-x / 3)) / (8 * kPi * x * sqr(length_) * all_);
  }
  /// r of that density, for u in [0, 1). Times 2 pi r it is a mixture of two exponentials.
  float sample(float u) const {
    const float split = first_ / all_;
    if (u < split) return -std::log1p(u / split * std::expm1(-kEnd)) * length_;
    return -3 * std::log1p((u - split) / (1 - split) * std::expm1(-kEnd / 3)) * length_;
  }
  /// The share within the distance r.
  float cdf(float r) const {
    const float x = std::min(r / length_, kEnd);
    return (0.25f * -std::expm1(-x) + 0.75f * -std::expm1(-x / 3)) / all_;
  }

private:
  static constexpr float kEnd = 26.768f; ///< exp(-x) / 4 + 3 exp(-x / 3) / 4 = kProfileTail

  float length_;      ///< l / s
  float first_, all_; ///< weight of the steeper exponential, and of both, up to end()
};

/// The dipole of Jensen, Marschner, Levoy & Hanrahan 2001, "A Practical Model for Subsurface Light Transport"
/// (eq. 4), for isotropic scattering:
///     R(r) = alpha' / (4 pi) sum over both poles of z (1 + sigma_tr d) exp(-sigma_tr d) / d^3,
/// with d^2 = r^2 + z^2. The real pole lies at the depth z_r = 1 / sigma_t', the virtual one as far above as
/// z_v = z_r (1 + 4 A / 3); A = (1 + F) / (1 - F) of the diffuse reflectance F of the surface from inside,
/// here the exact one and not the paper's fit (-1.440 / eta^2 + 0.710 / eta + 0.668 + 0.0636 eta).
class DipoleProfile {
public:
  /// Whose total reflectance is the albedo in [0, 1]; of more than kMostAlbedo it has the form of that.
  /// ior >= 1 is inside over outside; the mean free path 1 / sigma_t' > 0, scene units.
  DipoleProfile(float albedo, float mean_free_path, float ior) : DipoleProfile(mean_free_path, ior) {
    const float alpha = reduced_albedo(std::min(albedo, kMostAlbedo), ior);
    set(alpha, mean_free_path);
  }
  /// That of a medium, whatever its reflectance.
  static DipoleProfile of_reduced_albedo(float alpha, float mean_free_path, float ior) {
    DipoleProfile profile(mean_free_path, ior);
    profile.set(alpha, mean_free_path);
    return profile;
  }

  static constexpr float kMostAlbedo = 0.98f;

  /// A of the boundary condition.
  static float boundary_term(float ior) {
    const float inside = internal_diffuse_reflectance(diffuse_fresnel_reflectance(ior), ior);
    return (1 + inside) / (1 - inside);
  }
  /// The integral of R over the plane: alpha' / 2 (1 + exp(-4 / 3 A b)) exp(-b) with b = sqrt(3 (1 - alpha'))
  /// (section 2.4, eq. 15 of Jensen & Buhler 2002, "A Rapid Hierarchical Rendering Technique").
  static float total_reflectance(float alpha, float ior) { return total(alpha, boundary_term(ior)); }
  /// The inverse, by bisection, for it grows with alpha'.
  static float reduced_albedo(float reflectance, float ior) {
    const float a = boundary_term(ior);
    // Of b, for near alpha' = 1 floats are too coarse.
    float low = 0, high = std::sqrt(3.0f);
    for (int i = 0; i < 26; ++i) {
      const float middle = 0.5f * (low + high);
      (total(1 - sqr(middle) / 3, a) > reflectance ? low : high) = middle;
    }
    return 1 - sqr(0.5f * (low + high)) / 3;
  }

  float end() const { return end_; }
  float pdf(float r) const {
    float sum = 0;
    for (const Pole& pole : poles_) {
      const float d2 = sqr(r) + sqr(pole.z), d = std::sqrt(d2);
      sum += pole.weight * pole.z * (1 + sigma_ * d) * std::exp(-sigma_ * (d - pole.z)) / (d * d2);
    }
    return sum / (2 * kPi * all_);
  }
  /// Chooses a pole; its distribution of d is inverted by Newton's method.
  float sample(float u) const {
    float share = u * all_;
    const Pole& pole = share < poles_[0].weight * poles_[0].within ? poles_[0] : poles_[1];
    if (&pole != &poles_[0]) share -= poles_[0].weight * poles_[0].within;
    const float within = std::clamp(share / pole.weight, 0.0f, pole.within);
    const float d = distance(pole, within);
    return std::min(std::sqrt(std::max(sqr(d) - sqr(pole.z), 0.0f)), end_);
  }
  float cdf(float r) const {
    float sum = 0;
    for (const Pole& pole : poles_) sum += pole.weight * share_within(pole, std::min(r, end_));
    return sum / all_;
  }

private:
  struct Pole {
    float z;      ///< distance from the surface, scene units
    float weight; ///< share of what leaves
    float within; ///< of that, what does so up to end_
  };

  DipoleProfile(float mean_free_path, float ior)
      : poles_{Pole{mean_free_path, 1, 1}, Pole{mean_free_path * (1 + 4.0f / 3 * boundary_term(ior)), 1, 1}} {
  }

  static float total(float alpha, float a) {
    const float b = std::sqrt(3 * (1 - alpha));
    return 0.5f * alpha * (1 + std::exp(-4.0f / 3 * a * b)) * std::exp(-b);
  }

  void set(float alpha, float mean_free_path) {
    sigma_ = std::sqrt(3 * (1 - alpha)) / mean_free_path;
    const float far = std::exp(-sigma_ * (poles_[1].z - poles_[0].z)); // over the near one's
    poles_[0].weight = 1 / (1 + far), poles_[1].weight = far / (1 + far);
    // As far as the share of the farther pole, which all is nearer than.
    end_ = distance({poles_[1].z, 1, 1}, 1 - kProfileTail);
    all_ = 0;
    for (Pole& pole : poles_) {
      pole.within = share_within(pole, end_);
      all_ += pole.weight * pole.within;
    }
  }

  /// Of one pole: the integral up to r of 2 pi r R, over all of it: 1 - z / d exp(-sigma_tr (d - z)).
  float share_within(const Pole& pole, float r) const {
    const float d = std::sqrt(sqr(r) + sqr(pole.z));
    return 1 - pole.z / d * std::exp(-sigma_ * (d - pole.z));
  }
  /// d at which that is the share, less than 1: with y = log(d / z), y + sigma z (exp(y) - 1) = -log(1 -
  /// share) is convex and grows, so that Newton's method comes down to the solution from above.
  float distance(const Pole& pole, float share) const {
    const float target = -std::log1p(-std::min(share, 1 - 0x1p-24f)), k = sigma_ * pole.z;
    float y = k > 0 ? std::min(target, std::log1p(target / k)) : target;
    for (int i = 0; i < 12; ++i) {
      const float e = std::exp(y), step = (y + k * (e - 1) - target) / (1 + k * e);
      y -= step;
      if (std::abs(step) <= 1e-6f * y) break;
    }
    return pole.z * std::exp(std::max(y, 0.0f));
  }

  std::array<Pole, 2> poles_;
  float sigma_ = 0; ///< sigma_tr, 1/scene unit
  float end_ = 0, all_ = 1;
};

/// One profile for each channel: how the light that enters is to be given to exit points.
template <class Profile>
struct ProfileChannels {
  std::array<Profile, 3> channel;
  Spectrum albedo; ///< A

  /// R at the distance r.
  Spectrum value(float r) const {
    Spectrum out(0);
    for (int c = 0; c < 3; ++c)
      if (const Profile& p = channel[static_cast<std::size_t>(c)]; r < p.end()) out[c] = albedo[c] * p.pdf(r);
    return out;
  }
};

} // namespace candela
