#pragma once
// The report of `candela bench scale`.

#include "app/bench/scale_bench.h"
#include "app/figures/plot.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace candela {

/// The results of one run.
struct ScaleReport {
  std::vector<ScaleResult> scenes;
  std::vector<ScaleResult> landscapes; ///< the same picture with increasing numbers of distinct triangles
  std::vector<ScaleResult> stones;     ///< the same picture with instances of increasingly fine meshes
  std::optional<ScalePicture> picture;
  std::array<double, 2> load{}; ///< load average before and after the run
};

enum class TableFormat { text, markdown };

/// A row per scene: triangles, seconds to read, to build, to the first image; bytes; samples a second by one
/// thread and by all, and their ratio. The text about the picture follows, if there is one.
std::string scale_tables(const ScaleReport& report, TableFormat format);

/// Samples a second over the number of placed triangles, on a logarithmic axis.
Plot scale_plot(const ScaleReport& report);

std::string scale_json(const ScaleReport& report);

/// "1,002,528".
std::string grouped_digits(std::uint64_t number);

} // namespace candela
