#include "lab/histogram.h"

#include <numeric>

namespace candela {

double Histogram::integral() const { return std::accumulate(expected.begin(), expected.end(), 0.0); }

ChiSquareResult Histogram::chi_square() const {
  std::vector<double> observed = counts, expectation;
  expectation.reserve(expected.size() + 1);
  for (double share : expected) expectation.push_back(share * total);
  observed.push_back(outside);
  expectation.push_back(outside_expected * total);
  return chi_square_test(observed, expectation);
}

} // namespace candela
