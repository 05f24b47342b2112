#pragma once
// The numbers of a comparison, computed on a thread of their own, and the errors over time.

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
  // Input.
  std::array<std::shared_ptr<const Frame>, 2> frames; ///< null: no complete picture yet
  std::shared_ptr<const Image> reference;             ///< null: no reference that fits
  std::optional<std::pair<int, int>> difference;      ///< the two pictures: 0 A, 1 B, 2 the reference
  bool with_sign = false;
  float range = 0.1f;

  // Output.
  std::array<std::optional<double>, 2> rel_mse, noise; ///< as in CompareVariant
  std::shared_ptr<DisplayImage> picture;               ///< the difference
  double seconds = 0;                                  ///< that the analysis took

  void run();

private:
  std::span<const vec3> pixels(int which) const;
};

/// estimated_relmse of a frame that shows radiance; nothing if no pixel has two samples.
std::optional<double> frame_noise(const Frame& frame);

/// The error of one accumulation over time.
struct ErrorTrack {
  struct Point {
    double samples = 0, seconds = 0, error = 0;
  };
  std::uint64_t generation = 0;
  std::vector<Point> points;

  /// Another accumulation starts a new history. Points too close to the last one to be distinguished in a
  /// plot are skipped.
  void add(const Frame& frame, double error);
};

/// Both variants' errors over samples or seconds, and the slope of independent samples.
Plot error_plot(const std::array<ErrorTrack, 2>& tracks, bool over_seconds, std::string_view error_name);

} // namespace candela
