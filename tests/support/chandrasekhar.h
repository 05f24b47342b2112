#pragma once
// Half spaces of isotropic scattering, without tracing paths.

#include <cmath>
#include <vector>

namespace candela::test {

/// H(mu) of isotropic scattering with the albedo omega, by iterating Chandrasekhar's equation (1960, chapter
/// V, eq. 4): 1 / H(mu) = sqrt(1 - omega) + omega / 2 x integral of x H(x) / (mu + x).
class ChandrasekharH {
public:
  explicit ChandrasekharH(double omega) : omega_(omega), values_(kPoints, 1) {
    for (int round = 0; round < 100; ++round) {
      std::vector<double> next;
      for (int i = 0; i < kPoints; ++i) // the mean with the last, for omega = 1 would go to and fro
        next.push_back(0.5 * ((*this)(at(i)) + values_[static_cast<std::size_t>(i)]));
      values_ = std::move(next);
    }
  }
  double operator()(double mu) const {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) sum += at(i) * values_[static_cast<std::size_t>(i)] / (mu + at(i));
    return 1 / (std::sqrt(1 - omega_) + 0.5 * omega_ * sum / kPoints);
  }
  /// Of a half space: what it reflects of light that falls on it at the cosine mu (chapter V, eq. 45).
  double albedo(double mu) const { return 1 - std::sqrt(1 - omega_) * (*this)(mu); }

  /// The same of diffuse light.
  double mean_albedo() const {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) sum += 2 * at(i) * albedo(at(i)) / kPoints;
    return sum;
  }

private:
  static constexpr int kPoints = 500;
  static double at(int i) { return (i + 0.5) / kPoints; }

  double omega_;
  std::vector<double> values_;
};

} // namespace candela::test
