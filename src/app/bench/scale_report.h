#pragma once
// What `candela bench scale` says of its measurements.

#include "app/bench/scale_bench.h"
#include "app/figures/plot.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace candela {

/// Everything of one run.
struct ScaleReport {
  std::vector<ScaleResult> scenes;
  std::vector<ScaleResult> landscapes; ///< the same picture from ever more distinct triangles
  std::vector<ScaleResult> stones;     ///< the same picture from instances of ever finer meshes
  std::optional<ScalePicture> picture;
  std::array<double, 2> load{}; ///< average number of running threads of the minute before, and of the last
};

enum class TableFormat { text, markdown };

/// A row a scene: triangles, seconds to read, to build, to the first image; bytes; samples a second by one
/// thread and by all, and their ratio. Below it what was said of the picture, if there is one.
std::string scale_tables(const ScaleReport& report, TableFormat format);

/// Samples a second over the logarithm of the number of placed triangles.
Plot scale_plot(const ScaleReport& report);

std::string scale_json(const ScaleReport& report);

/// "1,002,528".
std::string grouped_digits(std::uint64_t number);

} // namespace candela
