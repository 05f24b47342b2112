#pragma once
// `candela bench scale`: the cost of large scenes.

#include <optional>
#include <string>
#include <vector>

namespace candela {

struct ScaleBenchOptions {
  std::vector<std::string> scenes;   ///< files to measure; none: the generated and the bundled ones
  std::vector<std::string> only;     ///< parts, of scale_parts(); none: all
  std::optional<std::string> folder; ///< keeps the generated files; without it they are removed at the end
  std::optional<std::string> size;   ///< WxH of the measured pictures
  std::optional<int> rounds;
  std::optional<std::string> plot;    ///< PNG to write
  std::optional<std::string> picture; ///< render the landscape to this file
  std::optional<std::string> picture_size;
  std::optional<int> picture_spp;
  std::optional<std::string> json;
  int threads = 0;
  bool markdown = false;
  bool short_run = false;
  bool quiet = false;
};

/// The values of `--only`: "landscape", "stones", …
std::vector<std::string> scale_parts();

/// Writes the scenes, measures each in a process of its own, prints the tables. Returns 0.
int run_scale_bench(const ScaleBenchOptions& options);

} // namespace candela
