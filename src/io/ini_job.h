#pragma once
// The CSCI 2240 path tracing assignment's jobs: a scene, an output file and a few settings.
//
//   [IO]
//   scene = example-scenes/CornellBox.xml
//   output = student_outputs/final/cornell_box.png
//   [Settings]
//   imageWidth = 512
//   imageHeight = 512
//   samplesPerPixel = 50
//   pathContinuationProb = 0.9
//   directLightingOnly = false
//   numDirectLightingSamples = 1

#include "io/files/path_policy.h"
#include "scene/document.h"

#include <string>

namespace candela {

struct IniJob {
  FoundFile scene;
  std::string output; ///< as the job says it: relative to the current folder, "" if it names none
  RenderSettings settings;
};

/// Reads a job. Its settings, in the terms of the settings table:
///
/// - imageWidth, imageHeight, samplesPerPixel: film.width, film.height, stop.spp.
/// - pathContinuationProb: path.rr = fixed with path.rr_probability, and path.rr_depth = 1, as in the
///   assignment: Russian roulette at every bounce, but not for the camera's segment and direct light.
/// - directLightingOnly: path.max_depth = 2.
/// - numDirectLightingSamples: path.light_samples.
/// - As the assignment's reference pictures are shown: display.tone_map = reinhard, display.exposure = -0.65.
///
/// As in Qt's QSettings, with which the assignment reads them, a ';' outside of quotes begins a comment.
///
/// The job's scene is named relative to a folder that need not be the job's. It is looked for there and in up
/// to four folders above, and, as the assignment's students keep the scenes in example-scenes/, with that
/// folder's name left out too. Unless allow_outside, the name may not be absolute or go upwards.
///
/// Throws input_error with line and column for everything else.
IniJob read_ini_job(const std::string& path, bool allow_outside, WarningList& warnings);

} // namespace candela
