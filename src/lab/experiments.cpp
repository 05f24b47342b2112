#include "lab/experiments.h"

namespace candela {

namespace {

constexpr std::string_view kSolidAngleSampling[] = {"sphere", "hemisphere", "cosine", "disc"};
constexpr std::string_view kIntegrands[] = {"square", "root", "kink", "step", "peak"};

const Field<SolidAngleOptions> kSolidAngleFields[] = {
    {{"sampling", FieldType::choice, 0, 0, "",
      "Samples: directions over the sphere, the hemisphere or by the cosine, or points on the disc",
      Invalidates::image, kSolidAngleSampling},
     [](SolidAngleOptions& o) -> void* { return &o.sampling; }},
};

const Field<IntegralOptions> kIntegralFields[] = {
    {{"integrand", FieldType::choice, 0, 0, "",
      "The integrand over [0, 1]: x^2, sqrt(x), |x - 0.3|, x < 0.3, or a narrow Gaussian", Invalidates::image,
      kIntegrands},
     [](IntegralOptions& o) -> void* { return &o.integrand; }},
    {{"cells", FieldType::integer, 0, 4096, "cells",
      "Importance sampling: x is sampled from the function's means over so many cells; 0: uniform"},
     [](IntegralOptions& o) -> void* { return &o.cells; }},
};

constexpr double kEdge = 0.3;
constexpr double kPeakAt = 0.6, kPeakSigma = 0.03;

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// Integral of exp(-(t - kPeakAt)^2 / (2 sigma^2)) for t below x, but for a constant.
double gaussian_primitive(double x, double sigma) {
  return sigma * std::sqrt(std::numbers::pi / 2) * std::erf((x - kPeakAt) / (sigma * std::numbers::sqrt2));
}

/// A primitive of the integrand.
double primitive(Integrand f, double x) {
  switch (f) {
  case Integrand::square: return cube(x) / 3;
  case Integrand::root: return 2.0 / 3 * x * std::sqrt(x);
  case Integrand::kink: return (x < kEdge ? -0.5 : 0.5) * square(x - kEdge);
  case Integrand::step: return std::min(x, kEdge);
  case Integrand::peak: return gaussian_primitive(x, kPeakSigma);
  }
  return 0;
}

/// A primitive of the integrand's square.
double primitive_of_square(Integrand f, double x) {
  switch (f) {
  case Integrand::square: return cube(x) * square(x) / 5;
  case Integrand::root: return square(x) / 2;
  case Integrand::kink: return cube(x - kEdge) / 3;
  case Integrand::step: return std::min(x, kEdge);
  case Integrand::peak: return gaussian_primitive(x, kPeakSigma / std::numbers::sqrt2);
  }
  return 0;
}

} // namespace

std::span<const Field<SolidAngleOptions>> solid_angle_fields() { return kSolidAngleFields; }
std::span<const Field<IntegralOptions>> integral_fields() { return kIntegralFields; }

Draw SolidAngleExperiment::draw(const Sampler& sampler) const {
  const vec2 u = sampler.get_2d(Dimension::film);
  if (options_.sampling == SolidAngleSampling::disc) {
    vec2 p = sample_uniform_disc(u);
    float inv_distance2 = 1 / (1 + glm::dot(p, p));
    float cos_theta = std::sqrt(inv_distance2);
    return {static_cast<double>(cos_theta * inv_distance2 / kUniformDiscPdf), p * cos_theta, true};
  }
  vec3 w(0);
  float pdf = 0;
  switch (options_.sampling) {
  case SolidAngleSampling::sphere:
    w = sample_uniform_sphere(u);
    pdf = kUniformSpherePdf;
    break;
  case SolidAngleSampling::hemisphere:
    w = sample_uniform_hemisphere(u);
    pdf = kUniformHemispherePdf;
    break;
  default: w = sample_cosine_hemisphere(u); pdf = cosine_hemisphere_pdf(w.z);
  }
  // The ray from the origin along w meets the plane z = 1 at (w.x, w.y) / w.z.
  bool hit = w.z > 0 && sqr(w.x) + sqr(w.y) <= sqr(w.z);
  return {hit ? 1 / static_cast<double>(pdf) : 0.0, vec2(w.x, w.y), hit};
}

double SolidAngleExperiment::standard_deviation() const {
  constexpr double pi = std::numbers::pi;
  const double mean = expected();
  double second_moment = 0; // of the value
  switch (options_.sampling) {
  case SolidAngleSampling::sphere: second_moment = 4 * pi * mean; break;
  case SolidAngleSampling::hemisphere: second_moment = 2 * pi * mean; break;
  // The integral of pi / cos(theta) over the cone.
  case SolidAngleSampling::cosine: second_moment = pi * pi * std::numbers::ln2; break;
  // pi times the integral of (1 + r^2)^-3 over the disc.
  case SolidAngleSampling::disc: second_moment = 3 * pi * pi / 8; break;
  }
  return std::sqrt(second_moment - mean * mean);
}

double IntegralExperiment::value(double x) const {
  switch (options_.integrand) {
  case Integrand::square: return x * x;
  case Integrand::root: return std::sqrt(x);
  case Integrand::kink: return std::abs(x - kEdge);
  case Integrand::step: return x < kEdge ? 1 : 0;
  case Integrand::peak: return std::exp(-0.5 * square((x - kPeakAt) / kPeakSigma));
  }
  return 0;
}

IntegralExperiment::IntegralExperiment(IntegralOptions options) : options_(options) {
  const Integrand f = options.integrand;
  expected_ = primitive(f, 1) - primitive(f, 0);
  double second_moment = primitive_of_square(f, 1) - primitive_of_square(f, 0);
  if (options.cells > 0) {
    const auto cells = static_cast<std::size_t>(options.cells);
    const double width = 1.0 / static_cast<double>(cells);
    std::vector<float> means;
    for (std::size_t i = 0; i < cells; ++i)
      means.push_back(static_cast<float>(
          (primitive(f, static_cast<double>(i + 1) * width) - primitive(f, static_cast<double>(i) * width)) /
          width));
    density_ = PiecewiseConstant1D(means);
    second_moment = 0; // the sum over the cells of the integral of f^2 / pdf
    for (std::size_t i = 0; i < cells; ++i) {
      const double low = static_cast<double>(i) * width, high = static_cast<double>(i + 1) * width;
      const double cell_pdf = pdf(static_cast<float>(0.5 * (low + high)));
      if (cell_pdf > 0)
        second_moment += (primitive_of_square(f, high) - primitive_of_square(f, low)) / cell_pdf;
    }
  }
  standard_deviation_ = std::sqrt(std::max(second_moment - expected_ * expected_, 0.0));
}

Draw IntegralExperiment::draw(const Sampler& sampler) const {
  const float u = sampler.get_1d(Dimension::film);
  if (options_.cells == 0) {
    const double f = value(static_cast<double>(u));
    return {f, vec2(u, static_cast<float>(f)), true};
  }
  const PiecewiseConstant1D::Sample sample = density_.sample(u);
  const double f = value(static_cast<double>(sample.x));
  return {f / static_cast<double>(sample.pdf), vec2(sample.x, static_cast<float>(f)), true};
}

} // namespace candela
