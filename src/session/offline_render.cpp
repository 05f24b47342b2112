#include "session/offline_render.h"

#include "core/error.h"
#include "render/film/film_view.h"

#include <chrono>

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Side of the coarsest blocks of a first pass that may run out of time; a power of two.
constexpr int kCoarsest = 32;

/// Pixels without samples get the value of one that stands for a block around them, where there is one.
/// Returns their share.
double fill_missing(OfflineResult& result) {
  Film& film = result.film;
  const ivec2 origin = film.origin();
  // Beforehand, for what is filled in stands for nothing.
  std::vector<std::pair<ivec2, std::optional<ivec2>>> holes;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      if (film.tried(x, y) > 0) continue;
      auto& hole = holes.emplace_back(ivec2(x, y), std::nullopt);
      for (int side = 2; side <= kCoarsest && !hole.second; side *= 2) {
        const ivec2 at = origin + ivec2(x, y), other = at - at % side - origin; // the grid is the frame's
        if (other.x >= 0 && other.y >= 0 && film.count(other.x, other.y) > 0) hole.second = other;
      }
    }
  for (const auto& [hole, other] : holes) {
    if (!other) continue;
    film.add(hole.x, hole.y, film.mean(other->x, other->y));
    for (Film& part : result.components)
      if (part.width() > 0) part.add(hole.x, hole.y, part.mean(other->x, other->y));
  }
  return static_cast<double>(holes.size()) / (static_cast<double>(film.width()) * film.height());
}

/// Of the window alone, so that a part of a huge picture costs no more than the part.
Film film_of(const FilmSettings& frame, const CropWindow& crop) {
  if (crop.width <= 0 || crop.height <= 0) return {frame.width, frame.height};
  const ivec2 lo = glm::max(ivec2(crop.x, crop.y), 0);
  const ivec2 hi =
      glm::min(ivec2(crop.x + crop.width, crop.y + crop.height), ivec2(frame.width, frame.height));
  const ivec2 size = glm::max(hi - lo, 0);
  return {size.x, size.y, lo};
}

} // namespace

OfflineResult render_document(const Document& document, const OfflineOptions& options) {
  const StopSettings& until = document.settings.stop;
  if (until.spp <= 0 && until.time <= 0 && until.noise <= 0 && document.settings.adaptive.error <= 0)
    throw usage_error("stop", "there is nothing to stop at",
                      "give stop.spp (--spp), stop.time (--time) or stop.noise (--noise)");
  static const std::atomic<bool> kNeverStop{false};
  const std::atomic<bool>& stop = options.stop ? *options.stop : kNeverStop;
  auto start = Clock::now();
  Progress building(stop);
  auto scene = RenderScene::build(document, nullptr, &building);
  OfflineResult result;
  result.build_seconds = seconds_since(start);
  result.scene = scene;
  result.scene_bytes = scene->memory_bytes();
  result.display_scale = display_scale(*scene, document.settings);
  result.film = film_of(document.settings.film, options.pass.crop);

  PassOptions pass_options = options.pass;
  if (options.components)
    for (std::size_t i = 0; i < result.components.size(); ++i) {
      result.components[i] = film_of(document.settings.film, options.pass.crop);
      pass_options.components[i] = &result.components[i];
    }

  start = Clock::now();
  StopCondition ends(stop);
  if (until.time > 0)
    ends.at(start + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(std::min(static_cast<double>(until.time), 1e9))));
  auto render = [&](const SampleRange& range) {
    PassResult pass = render_pass(*scene, document, range, result.film, ends, pass_options);
    result.rays += pass.rays;
    result.nonfinite.count += pass.nonfinite.count;
    for (const NonFiniteSample& s : pass.nonfinite.records)
      if (result.nonfinite.records.size() < NonFiniteLog::kMaxRecords) result.nonfinite.records.push_back(s);
    return pass;
  };
  if (until.time > 0)
    for (int lattice = kCoarsest; lattice > 1; lattice /= 2)
      render({0, 1, lattice, lattice == kCoarsest ? 0 : 2 * lattice});
  int target = until.spp > 0 ? until.spp : std::numeric_limits<int>::max();
  int portion = 1; // grows while a portion is too short to be worth its synchronisation
  while (result.spp < target) {
    portion = std::min(portion, target - result.spp);
    if (until.noise > 0) portion = std::min(portion, next_noise_check(result.spp) - result.spp);
    SampleRange range{static_cast<std::uint32_t>(result.spp),
                      static_cast<std::uint32_t>(result.spp + portion)};
    auto portion_start = Clock::now();
    PassResult pass = render(range);
    result.render_seconds = seconds_since(start);
    if (!pass.completed) {
      result.interrupted = stop;
      break;
    }
    result.spp += portion;
    if (options.progress) {
      double by_spp = until.spp > 0 ? static_cast<double>(result.spp) / target : 0;
      double by_time = until.time > 0 ? result.render_seconds / static_cast<double>(until.time) : 0;
      options.progress(
          {result.spp, result.render_seconds, std::min(std::max(by_spp, by_time), 1.0), result.rays});
    }
    result.converged = pass.converged && document.settings.adaptive.error > 0;
    if (result.converged) break;
    if (until.noise > 0 && is_noise_check(result.spp) &&
        estimated_relmse(result.film) <= static_cast<double>(until.noise) * static_cast<double>(until.noise))
      break;
    if (until.time > 0 && result.render_seconds >= static_cast<double>(until.time)) break;
    double taken = seconds_since(portion_start);
    if (taken < 0.1 && portion < 64)
      portion *= 2;
    else if (taken > 0.5 && portion > 1)
      portion /= 2;
  }
  if (result.spp == 0) result.missing = fill_missing(result);
  result.noise = std::sqrt(estimated_relmse(result.film));
  return result;
}

ViewPicture render_view(const Document& document, const OfflineResult& rendered, View view,
                        const OfflineOptions& options) {
  if (accumulated_view(view) == accumulated_view(document.settings.view))
    return {view_image(rendered.film, view), 1};
  Document other = document;
  other.settings.view = view;
  other.settings.stop = {};
  // Of an interrupted render, too, every picture is whole, but whoever interrupted it does not wait long.
  other.settings.stop.spp = rendered.interrupted ? 1 : std::max(rendered.spp, 1);
  other.settings.adaptive = {};
  OfflineOptions quiet = options;
  quiet.components = false;
  quiet.progress = nullptr;
  quiet.stop = nullptr;
  OfflineResult result = render_document(other, quiet);
  return {view_image(result.film, view), result.display_scale};
}

} // namespace candela
