#include "support/direction_statistics.h"

#include "core/basis.h"

#include <array>
#include <numeric>

namespace candela::test {

SphereBins::SphereBins(vec3 axis, double width, int rings, int sectors)
    : width_(width), rings_(rings), sectors_(sectors) {
  Basis basis = Basis::from_normal(glm::normalize(axis));
  z_ = glm::normalize(glm::dvec3(basis.n));
  x_ = glm::normalize(glm::dvec3(basis.s) - z_ * glm::dot(z_, glm::dvec3(basis.s)));
  y_ = glm::cross(z_, x_);
}

std::size_t SphereBins::index(vec3 w) const {
  glm::dvec3 d = glm::normalize(glm::dvec3(w));
  double x = glm::dot(d, x_), y = glm::dot(d, y_), z = glm::dot(d, z_);
  // tan^2(theta / 2) = sin^2 / (1 + cos)^2, and s = t / (t + width^2).
  double sin2 = x * x + y * y;
  double s = 1;
  if (z > -1 + 1e-12) {
    double t = z > 0 ? sin2 / ((1 + z) * (1 + z)) : (1 - z) / (1 + z);
    s = t / (t + width_ * width_);
  }
  double phi = std::atan2(y, x);
  if (phi < 0) phi += 2 * std::numbers::pi;
  int ring = std::min(static_cast<int>(s * rings_), rings_ - 1);
  int sector = std::min(static_cast<int>(phi / (2 * std::numbers::pi) * sectors_), sectors_ - 1);
  return static_cast<std::size_t>(ring * sectors_ + sector);
}

double SphereBins::gauss(const std::function<double(vec3)>& f, double s0, double s1, double phi0,
                         double phi1) const {
  static constexpr std::array<double, 5> kNodes = {-0.9061798459386640, -0.5384693101056831, 0,
                                                   0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 5> kWeights = {
      0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    double s = 0.5 * (s0 + s1) + 0.5 * (s1 - s0) * kNodes[i];
    double w2 = width_ * width_;
    double t = w2 * s / (1 - s); // tan^2(theta / 2)
    double cos_theta = (1 - t) / (1 + t), sin_theta = 2 * std::sqrt(t) / (1 + t);
    // d(cos theta) = -2 dt / (1 + t)^2, dt = w^2 ds / (1 - s)^2.
    double jacobian = 2 * w2 / ((1 + t) * (1 + t) * (1 - s) * (1 - s));
    for (std::size_t j = 0; j < 5; ++j) {
      double phi = 0.5 * (phi0 + phi1) + 0.5 * (phi1 - phi0) * kNodes[j];
      glm::dvec3 w = sin_theta * (std::cos(phi) * x_ + std::sin(phi) * y_) + cos_theta * z_;
      sum += kWeights[i] * kWeights[j] * jacobian * f(vec3(w));
    }
  }
  return sum * 0.25 * (s1 - s0) * (phi1 - phi0);
}

double SphereBins::integrate_cell(const std::function<double(vec3)>& f, double s0, double s1, double phi0,
                                  double phi1, double tolerance, int depth) const {
  double whole = gauss(f, s0, s1, phi0, phi1);
  double s = 0.5 * (s0 + s1), phi = 0.5 * (phi0 + phi1);
  double parts = gauss(f, s0, s, phi0, phi) + gauss(f, s, s1, phi0, phi) + gauss(f, s0, s, phi, phi1) +
                 gauss(f, s, s1, phi, phi1);
  if (std::abs(whole - parts) <= tolerance || depth == 0) return parts;
  // The errors of the four parts are hardly all of one sign.
  double part_tolerance = 0.5 * tolerance;
  return integrate_cell(f, s0, s, phi0, phi, part_tolerance, depth - 1) +
         integrate_cell(f, s, s1, phi0, phi, part_tolerance, depth - 1) +
         integrate_cell(f, s0, s, phi, phi1, part_tolerance, depth - 1) +
         integrate_cell(f, s, s1, phi, phi1, part_tolerance, depth - 1);
}

std::vector<double> SphereBins::integrate(const std::function<double(vec3)>& f, double tolerance) const {
  std::vector<double> result;
  result.reserve(size());
  constexpr int kMaxDepth = 7;
  for (int ring = 0; ring < rings_; ++ring) {
    for (int sector = 0; sector < sectors_; ++sector) {
      double phi = 2 * std::numbers::pi / sectors_;
      result.push_back(integrate_cell(f, static_cast<double>(ring) / rings_,
                                      static_cast<double>(ring + 1) / rings_, sector * phi,
                                      (sector + 1) * phi, tolerance, kMaxDepth));
    }
  }
  return result;
}

double integrate_sphere(const std::function<double(vec3)>& f, vec3 axis, double width) {
  std::vector<double> bins = SphereBins(axis, width).integrate(f);
  return std::accumulate(bins.begin(), bins.end(), 0.0);
}

DirectionTest test_directions(const SphereBins& bins, std::size_t count,
                              const std::function<std::optional<vec3>(std::size_t)>& draw,
                              const std::function<double(vec3)>& pdf) {
  std::vector<double> observed(bins.size() + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<vec3> w = draw(i);
    observed[w ? bins.index(*w) : bins.size()] += 1;
  }
  DirectionTest result;
  std::vector<double> expected = bins.integrate(pdf);
  result.pdf_integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  expected.push_back(1 - result.pdf_integral);
  for (double& e : expected) e *= static_cast<double>(count);
  // Quadrature leaves a little where every draw succeeds.
  if (std::abs(expected.back()) < 5 && observed.back() < 5) expected.back() = observed.back();
  result.chi_square = chi_square_test(observed, expected);
  return result;
}

} // namespace candela::test
