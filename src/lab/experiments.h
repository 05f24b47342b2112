#pragma once
// The experiments of the lessons pi, solid-angle and integral. All have closed forms, so that the displayed
// errors are exact.

#include "core/fields.h"
#include "lab/estimation.h"
#include "sampling/distribution.h"
#include "sampling/warp.h"

namespace candela {

/// Points of the square [-1, 1]^2; the value is 4 inside of the unit disc and 0 elsewhere, so its mean is the
/// square's area times the disc's share of it.
struct PiExperiment {
  struct Options { ///< none
    bool operator==(const Options&) const = default;
  };
  static std::span<const Field<Options>> fields() { return {}; }
  PiExperiment() = default;
  explicit PiExperiment(Options) {}

  Draw draw(const Sampler& sampler) const {
    vec2 p = 2.0f * sampler.get_2d(Dimension::film) - 1.0f;
    bool hit = glm::dot(p, p) <= 1;
    return {hit ? 4.0 : 0.0, p, hit};
  }
  double expected() const { return std::numbers::pi; }
  /// 4 sqrt(p (1 - p)) with p = pi / 4.
  double standard_deviation() const { return std::sqrt(std::numbers::pi * (4 - std::numbers::pi)); }
};

/// Sampling strategies of the lesson on the solid angle.
enum class SolidAngleSampling : int {
  sphere,     ///< directions, uniform over the sphere
  hemisphere, ///< directions, uniform over the upper hemisphere
  cosine,     ///< directions, by the cosine over the hemisphere
  disc,       ///< points, uniform over the disc's area
};

struct SolidAngleOptions {
  SolidAngleSampling sampling = SolidAngleSampling::sphere;
  bool operator==(const SolidAngleOptions&) const = default;
};
std::span<const Field<SolidAngleOptions>> solid_angle_fields();

/// The solid angle of the unit disc at z = 1, as the origin sees it: 2 pi (1 - cos 45 degrees). The value is
/// 1 / pdf of a direction that hits the disc and 0 of others; of a point on the disc it is
/// (cos(theta) / distance^2) / pdf_area, the change from area to solid angle.
/// Draw::position is the direction's (x, y); the disc is the circle of radius sin 45 degrees in it.
class SolidAngleExperiment {
public:
  using Options = SolidAngleOptions;
  static std::span<const Field<Options>> fields() { return solid_angle_fields(); }
  explicit SolidAngleExperiment(SolidAngleOptions options) : options_(options) {}
  const SolidAngleOptions& options() const { return options_; }
  Draw draw(const Sampler& sampler) const;
  double expected() const { return 2 * std::numbers::pi * (1 - std::numbers::sqrt2 / 2); }
  double standard_deviation() const;

private:
  SolidAngleOptions options_;
};

/// Integrands of the lesson `integral` over [0, 1]. None is negative.
enum class Integrand : int {
  square, ///< x^2
  root,   ///< sqrt(x), whose slope at 0 is infinite
  kink,   ///< |x - 0.3|
  step,   ///< 1 below 0.3, then 0
  peak,   ///< a Gaussian about 0.6 with sigma 0.03
};

struct IntegralOptions {
  Integrand integrand = Integrand::square;
  int cells = 0; ///< of x's density, the integrand's means over so many cells; 0: uniform
  bool operator==(const IntegralOptions&) const = default;
};
std::span<const Field<IntegralOptions>> integral_fields();

/// The integral of a function over [0, 1] by f(x) / pdf(x), with x uniform or, importance sampling, from a
/// PiecewiseConstant1D of the function. Draw::position is (x, f(x)); every draw is a hit.
class IntegralExperiment {
public:
  using Options = IntegralOptions;
  static std::span<const Field<Options>> fields() { return integral_fields(); }
  explicit IntegralExperiment(IntegralOptions options);
  const IntegralOptions& options() const { return options_; }
  Draw draw(const Sampler& sampler) const;
  double expected() const { return expected_; }
  double standard_deviation() const { return standard_deviation_; }
  /// Of x, per unit length; x in [0, 1).
  double pdf(float x) const { return options_.cells == 0 ? 1.0 : static_cast<double>(density_.pdf(x)); }
  double value(double x) const;

private:
  IntegralOptions options_;
  PiecewiseConstant1D density_; ///< if there are cells
  double expected_, standard_deviation_;
};

static_assert(Experiment<PiExperiment> && Experiment<SolidAngleExperiment> && Experiment<IntegralExperiment>);

} // namespace candela
