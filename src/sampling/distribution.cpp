#include "sampling/distribution.h"

#include <stdexcept>

namespace candela {

namespace {

double checked_sum(std::span<const float> weights) {
  double sum = 0;
  for (float w : weights) {
    if (!(w >= 0) || std::isinf(w))
      throw std::invalid_argument("a distribution's weights must be finite and not negative");
    sum += w;
  }
  return sum;
}

} // namespace

AliasTable::AliasTable(std::span<const float> weights) {
  double sum = checked_sum(weights);
  if (sum == 0) return;
  std::size_t n = weights.size();
  bins_.resize(n);
  // Scaled so that the mean is 1: a bin below 1 is small and gets the rest from a large one.
  std::vector<double> scaled(n);
  std::vector<std::uint32_t> small, large;
  std::uint32_t heaviest = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    bins_[i].pmf = static_cast<float>(weights[i] / sum);
    scaled[i] = weights[i] / sum * static_cast<double>(n);
    (scaled[i] < 1 ? small : large).push_back(i);
    if (weights[i] > weights[heaviest]) heaviest = i;
  }
  while (!small.empty() && !large.empty()) {
    std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    bins_[s].threshold = static_cast<float>(scaled[s]);
    bins_[s].alias = l;
    scaled[l] -= 1 - scaled[s];
    if (scaled[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // Only rounding leaves bins over, all of them 1 but for that. One of no weight must still never be drawn.
  large.insert(large.end(), small.begin(), small.end());
  for (std::uint32_t i : large) {
    bins_[i].threshold = weights[i] > 0 ? 1.0f : 0.0f;
    bins_[i].alias = weights[i] > 0 ? i : heaviest;
  }
}

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const float> weights) {
  if (weights.empty()) throw std::invalid_argument("a distribution needs a weight");
  std::size_t n = weights.size();
  double sum = checked_sum(weights);
  integral_ = static_cast<float>(sum / static_cast<double>(n));
  cdf_.resize(n + 1);
  pdf_.resize(n);
  double running = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double share = sum > 0 ? weights[i] / sum : 1 / static_cast<double>(n);
    pdf_[i] = static_cast<float>(share * static_cast<double>(n));
    cdf_[i] =
        static_cast<float>(running); // 1 before a tail without weight: a double's rounding does not show
    running += share;
  }
  cdf_[n] = 1;
}

PiecewiseConstant1D::Sample PiecewiseConstant1D::sample(float u) const {
  // The last cell whose distribution function does not exceed u: never one of no weight, whose ends are
  // equal.
  auto above = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  auto cell = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - cdf_.begin() - 1, 0));
  cell = std::min(cell, size() - 1);
  float width = cdf_[cell + 1] - cdf_[cell];
  float offset = width > 0 ? (u - cdf_[cell]) / width : 0;
  float x = (static_cast<float>(cell) + offset) / static_cast<float>(size());
  // Rounding must not carry x into a neighbour, which may have no weight.
  if (cell_of(x) < cell)
    x = std::nextafter(x, 1.0f);
  else if (cell_of(x) > cell)
    x = std::nextafter(x, 0.0f);
  return {x, pdf_[cell], static_cast<std::uint32_t>(cell)};
}

} // namespace candela
