#pragma once
// The numbers of a comparison: what is worked out beside the UI thread, and how it fell over time.

#include "app/compare/compare_state.h"
#include "render/film/frame.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace candela {

struct CompareAnalysis {
  // What is asked.
  std::array<std::shared_ptr<const Frame>, 2> frames; ///< null: there is no whole picture yet
  std::shared_ptr<const Image> reference;             ///< null: none that fits
  std::optional<std::pair<int, int>> difference;      ///< of which pictures: 0 A, 1 B, 2 the reference
  bool with_sign = false;
  float range = 0.1f;

  // The answer.
  std::array<std::optional<double>, 2> rel_mse, noise; ///< as in CompareVariant
  std::shared_ptr<DisplayImage> picture;               ///< the difference
  double seconds = 0;                                  ///< that it took

  void run();

private:
  std::span<const vec3> pixels(int which) const;
};

/// estimated_relmse of a frame that shows radiance; nothing where no pixel has two samples.
std::optional<double> frame_noise(const Frame& frame);

/// An error over one accumulation.
struct ErrorTrack {
  struct Point {
    double samples = 0, seconds = 0, error = 0;
  };
  std::uint64_t generation = 0;
  std::vector<Point> points;

  /// Begins anew with another accumulation; points closer to the last one than a plot shows are left out.
  void add(const Frame& frame, double error);
};

/// Both variants' errors over their samples or seconds, and how independent samples would fall.
Plot error_plot(const std::array<ErrorTrack, 2>& tracks, bool over_seconds, std::string_view error_name);

} // namespace candela
