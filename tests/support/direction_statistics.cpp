#include "support/direction_statistics.h"

#include <array>
#include <numeric>

namespace candela::test {

namespace {
constexpr double kHalfPi = 0.5 * std::numbers::pi;
}

SphereBins::Spacing::Spacing(double lo, double hi, double m, double width)
    : lo_(lo), hi_(hi), m_(m), width_(width), angle_lo_(std::atan((lo - m) / width)),
      angle_range_(std::atan((hi - m) / width) - angle_lo_) {}

double SphereBins::Spacing::quantile(double s) const {
  return std::clamp(m_ + width_ * std::tan(angle_lo_ + s * angle_range_), lo_, hi_);
}

double SphereBins::Spacing::density(double x) const {
  double r = (x - m_) / width_;
  return 1 / (angle_range_ * width_ * (1 + r * r));
}

double SphereBins::Spacing::cdf(double x) const {
  return (std::atan((x - m_) / width_) - angle_lo_) / angle_range_;
}

namespace {

double sin_theta(vec3 w) { return std::hypot(double(w.x), double(w.y)); }

/// A lobe about the pole covers all azimuths.
double azimuth_width(vec3 peak, double width) {
  return sin_theta(peak) > 1e-6 ? std::min(width / sin_theta(peak), 10.0) : 10.0;
}

} // namespace

SphereBins::SphereBins(vec3 peak, double width, int rings, int sectors)
    : side_(peak.z < 0 ? -1 : 1), peak_theta_(std::atan2(sin_theta(peak), std::abs(double(peak.z)))),
      peak_azimuth_(std::atan2(double(peak.y), double(peak.x))), rings_(rings), sectors_(sectors),
      rings_on_side_(rings * 3 / 4), theta_on_side_(0, kHalfPi, peak_theta_, width),
      theta_beyond_(kHalfPi, std::numbers::pi, kHalfPi, std::max(width, 0.5)),
      phi_(-std::numbers::pi, std::numbers::pi, 0, azimuth_width(peak, width)) {}

std::size_t SphereBins::index(vec3 w) const {
  glm::dvec3 d(w);
  double theta = std::atan2(sin_theta(w), side_ * d.z);
  bool beyond = side_ * d.z < 0;
  double s = (beyond ? theta_beyond_ : theta_on_side_).cdf(theta);
  int count = beyond ? rings_ - rings_on_side_ : rings_on_side_;
  int ring = std::clamp(static_cast<int>(s * count), 0, count - 1) + (beyond ? rings_on_side_ : 0);
  double phi = std::remainder(std::atan2(d.y, d.x) - peak_azimuth_, 2 * std::numbers::pi);
  int sector = std::clamp(static_cast<int>(phi_.cdf(phi) * sectors_), 0, sectors_ - 1);
  return static_cast<std::size_t>(ring * sectors_ + sector);
}

double SphereBins::gauss(const std::function<double(vec3)>& f, const Cell& cell) const {
  static constexpr std::array<double, 5> kNodes = {-0.9061798459386640, -0.5384693101056831, 0,
                                                   0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 5> kWeights = {
      0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  std::array<double, 5> cos_phi, sin_phi, phi_weight;
  for (std::size_t j = 0; j < 5; ++j) {
    double phi = phi_.quantile(0.5 * (cell.t0 + cell.t1) + 0.5 * (cell.t1 - cell.t0) * kNodes[j]);
    cos_phi[j] = std::cos(phi + peak_azimuth_);
    sin_phi[j] = std::sin(phi + peak_azimuth_);
    phi_weight[j] = kWeights[j] / phi_.density(phi);
  }
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    double theta = cell.theta->quantile(0.5 * (cell.s0 + cell.s1) + 0.5 * (cell.s1 - cell.s0) * kNodes[i]);
    double sine = std::sin(theta), z = side_ * std::cos(theta);
    double weight = kWeights[i] * sine / cell.theta->density(theta);
    for (std::size_t j = 0; j < 5; ++j)
      sum += weight * phi_weight[j] * f(vec3(glm::dvec3(sine * cos_phi[j], sine * sin_phi[j], z)));
  }
  return sum * 0.25 * (cell.s1 - cell.s0) * (cell.t1 - cell.t0);
}

double SphereBins::integrate_cell(const std::function<double(vec3)>& f, const Cell& cell, double tolerance,
                                  int depth) const {
  double s = 0.5 * (cell.s0 + cell.s1), t = 0.5 * (cell.t0 + cell.t1);
  const Cell parts[] = {{cell.theta, cell.s0, s, cell.t0, t},
                        {cell.theta, s, cell.s1, cell.t0, t},
                        {cell.theta, cell.s0, s, t, cell.t1},
                        {cell.theta, s, cell.s1, t, cell.t1}};
  double sum = 0;
  for (const Cell& part : parts) sum += gauss(f, part);
  if (std::abs(gauss(f, cell) - sum) <= tolerance || depth == 0) return sum;
  sum = 0;
  // Errors of the four parts partly cancel.
  for (const Cell& part : parts) sum += integrate_cell(f, part, 0.5 * tolerance, depth - 1);
  return sum;
}

std::vector<double> SphereBins::integrate(const std::function<double(vec3)>& f, double tolerance) const {
  constexpr int kMaxDepth = 7;
  std::vector<double> result;
  result.reserve(size());
  for (int ring = 0; ring < rings_; ++ring) {
    bool beyond = ring >= rings_on_side_;
    int i = beyond ? ring - rings_on_side_ : ring, count = beyond ? rings_ - rings_on_side_ : rings_on_side_;
    for (int sector = 0; sector < sectors_; ++sector) {
      Cell cell{beyond ? &theta_beyond_ : &theta_on_side_, double(i) / count, double(i + 1) / count,
                double(sector) / sectors_, double(sector + 1) / sectors_};
      result.push_back(integrate_cell(f, cell, tolerance, kMaxDepth));
    }
  }
  return result;
}

double integrate_sphere(const std::function<double(vec3)>& f, vec3 peak, double width) {
  std::vector<double> bins = SphereBins(peak, width).integrate(f);
  return std::accumulate(bins.begin(), bins.end(), 0.0);
}

DirectionTest test_directions(const SphereBins& bins, std::size_t count,
                              const std::function<std::optional<vec3>(std::size_t)>& draw,
                              const std::function<double(vec3)>& pdf) {
  std::vector<double> observed(bins.size() + 1, 0.0);
  std::size_t impossible = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::optional<vec3> w = draw(i);
    if (w && !(pdf(*w) > 0)) ++impossible;
    observed[w ? bins.index(*w) : bins.size()] += 1;
  }
  DirectionTest result;
  std::vector<double> expected = bins.integrate(pdf);
  result.pdf_integral = std::accumulate(expected.begin(), expected.end(), 0.0);
  expected.push_back(1 - result.pdf_integral);
  for (double& e : expected) e *= static_cast<double>(count);
  // Quadrature may miss a sliver of a bin above the horizon, and gives a small residue if every draw
  // succeeds: such bins are pooled.
  for (double& e : expected) e = std::max(e, 1e-6);
  result.chi_square = chi_square_test(observed, expected);
  if (impossible > 0) result.chi_square.p_value = 0;
  return result;
}

} // namespace candela::test
