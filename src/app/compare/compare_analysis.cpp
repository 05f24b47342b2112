#include "app/compare/compare_analysis.h"

#include "imaging/compare.h"
#include "imaging/difference.h"
#include "render/film/film_view.h"

#include <chrono>
#include <cmath>

namespace candela {

namespace {

/// Ratio of the samples of consecutive points of the plot.
constexpr double kPointStep = 1.09;

} // namespace

std::optional<double> frame_noise(const Frame& frame) {
  if (frame.view != View::radiance || frame.variance.empty()) return std::nullopt;
  const double noise = estimated_relmse(frame.linear, frame.variance, frame.samples);
  return std::isfinite(noise) ? std::optional(noise) : std::nullopt;
}

std::span<const vec3> CompareAnalysis::pixels(int which) const {
  return which < 2 ? std::span<const vec3>(frames[static_cast<std::size_t>(which)]->linear)
                   : std::span<const vec3>(reference->pixels);
}

void CompareAnalysis::run() {
  const auto began = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!frames[i]) continue;
    noise[i] = frame_noise(*frames[i]);
    if (reference) rel_mse[i] = relative_mse(frames[i]->linear, reference->pixels);
  }
  if (difference) {
    picture = std::make_shared<DisplayImage>();
    picture->frame = difference->first == 1 ? frames[1] : frames[0];
    picture->width = picture->frame->width;
    picture->height = picture->frame->height;
    picture->rgba = difference_rgba8(pixels(difference->first), pixels(difference->second), with_sign, range);
  }
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

void ErrorTrack::add(const Frame& frame, double error) {
  if (generation != frame.generation) *this = {frame.generation, {}};
  const double samples = frame.spp;
  if (points.empty() || samples >= kPointStep * points.back().samples)
    points.push_back({samples, frame.render_seconds, error});
}

Plot error_plot(const std::array<ErrorTrack, 2>& tracks, bool over_seconds, std::string_view error_name) {
  Plot plot;
  plot.x = {over_seconds ? "seconds" : "samples a pixel", true};
  plot.y = {std::string(error_name), true};
  for (std::size_t i = 0; i < 2; ++i) {
    PlotSeries series{std::string(1, variant_letter(static_cast<int>(i))), {}, false};
    for (const ErrorTrack::Point& p : tracks[i].points)
      series.points.push_back({over_seconds ? p.seconds : p.samples, p.error});
    plot.series.push_back(std::move(series));
  }
  if (PlotSeries guide = inverse_guide(plot, over_seconds ? "1/t" : "1/N"); !guide.points.empty())
    plot.series.push_back(std::move(guide));
  return plot;
}

} // namespace candela
