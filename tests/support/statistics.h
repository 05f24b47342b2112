#pragma once
// Hypothesis tests. Each gives a p-value: the probability, under the null hypothesis, of data at least as
// extreme. A test fails below a threshold that gives a probability kFalseAlarm of a false alarm for the whole
// TEST(); with about a hundred statistical TESTs, one run in ten thousand fails without a cause.

#include "core/statistics.h"

namespace candela::test {

/// Probability that one TEST() fails although the code is correct.
inline constexpr double kFalseAlarm = 1e-6;

/// Threshold for each of `tests` p-values, so that one or more fall below it with probability `family` (Šidák
/// 1967: exact if independent, on the safe side otherwise for the statistics here).
double sidak_threshold(int tests, double family = kFalseAlarm);

/// P(|X| >= |z|) for X of the standard normal distribution.
double normal_p_value(double z);

/// p-value of a sample mean against a known one; assumes many independent values of finite variance.
/// `rounding` is the allowed numerical error: without variance, the means must agree within it.
double z_test(const RunningStatistics& sample, double expected, double rounding = 0);
/// p-value of two sample means being equal.
double z_test(const RunningStatistics& a, const RunningStatistics& b, double rounding = 0);

} // namespace candela::test
