#pragma once
// Hypothesis tests. Each gives a p-value: the chance, if all is right, of data at least as odd as these. A
// test fails where it is below a threshold that leaves kFalseAlarm for the whole TEST(); with some hundred
// statistical TESTs, one run in ten thousand fails without a cause.

#include "core/statistics.h"

namespace candela::test {

/// Chance that one TEST() fails although all is right.
inline constexpr double kFalseAlarm = 1e-6;

/// Threshold for each of `tests` p-values, so that one or more fall below it with probability `family` (Šidák
/// 1967: exact if independent, on the safe side otherwise for the statistics here).
double sidak_threshold(int tests, double family = kFalseAlarm);

/// P(|X| >= |z|) for X of the standard normal distribution.
double normal_p_value(double z);

/// p-value of a sample mean against a known one; many independent values of finite variance are assumed.
/// `rounding` is the error that both may have without being wrong: without any variance the means must agree
/// to within it.
double z_test(const RunningStatistics& sample, double expected, double rounding = 0);
/// Of two sample means being equal.
double z_test(const RunningStatistics& a, const RunningStatistics& b, double rounding = 0);

} // namespace candela::test
