#pragma once
// The output of `candela lab`, as text and as JSON.

#include "app/lab/lens_lesson.h"
#include "app/lab/medium_lesson.h"
#include "lab/brdf.h"
#include "lab/experiments.h"
#include "lab/points.h"
#include "lab/warps.h"
#include "scene/document.h"

#include <string>

namespace candela {

struct LabReport {
  std::string text, json; ///< both end with a new line
};

LabReport report(const Estimation<PiExperiment>& lesson);
LabReport report(const Estimation<SolidAngleExperiment>& lesson);
LabReport report(const Estimation<IntegralExperiment>& lesson);
LabReport report(const WarpLesson& lesson);
LabReport report(const BrdfLesson& lesson, const MaterialChoice& material);
LabReport report(const MediumLesson& lesson);
LabReport report(const LensLesson& lesson);

/// The points; the text is CSV.
LabReport report_points(const PointsOptions& options, const SampleSource& source, std::uint32_t count);
/// Discrepancy over N of every sampler, in SamplerType's order; the text is CSV.
LabReport report_discrepancies(std::span<const DiscrepancyCurve> curves);

/// A chi-square test's result in words.
std::string verdict(const ChiSquareResult& test);

} // namespace candela
