#include "session/offline_render.h"

#include "core/error.h"
#include "render/film/accumulation.h"
#include "render/film/film_view.h"
#include "render/film/make_pass_renderer.h"

#include <chrono>

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Side of the coarsest blocks of a first pass that may run out of time; a power of two.
constexpr int kCoarsest = 32;
/// Seconds of one pass: long enough that synchronisation costs little, short enough for progress reports.
constexpr double kOfflinePassSeconds = 0.2;

/// Pixels without samples get the value of the pixel that represents their block, if it has one. Returns
/// their share.
double fill_missing(OfflineResult& result) {
  Film& film = result.film;
  const ivec2 origin = film.origin();
  // Collected first, so that filled pixels are not used to fill others.
  std::vector<std::pair<ivec2, std::optional<ivec2>>> holes;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      if (film.has_samples(x, y)) continue;
      auto& hole = holes.emplace_back(ivec2(x, y), std::nullopt);
      for (int side = 2; side <= kCoarsest && !hole.second; side *= 2) {
        const ivec2 at = origin + ivec2(x, y),
                    other = at - at % side - origin; // blocks are aligned to the frame
        if (other.x >= 0 && other.y >= 0 && film.count(other.x, other.y) > 0) hole.second = other;
      }
    }
  for (const auto& [hole, other] : holes) {
    if (!other) continue;
    std::vector<vec3> layers;
    for (std::size_t i = 0; i < result.layers.layers(); ++i)
      layers.push_back(result.layers.mean(film, other->x, other->y, i));
    if (!layers.empty()) result.layers.add(hole.x, hole.y, 0, layers);
    film.add(hole.x, hole.y, film.mean(other->x, other->y));
    for (Film& part : result.components)
      if (part.width() > 0) part.add(hole.x, hole.y, part.mean(other->x, other->y));
  }
  return static_cast<double>(holes.size()) / (static_cast<double>(film.width()) * film.height());
}

} // namespace

OfflineResult render_document(const Document& document, const OfflineOptions& options) {
  const StopSettings& until = document.settings.stop;
  if (until.spp <= 0 && until.time <= 0 && until.noise <= 0 && document.settings.adaptive.error <= 0)
    throw usage_error("stop", "there is no stopping criterion",
                      "give stop.spp (--spp), stop.time (--time) or stop.noise (--noise)");
  static const std::atomic<bool> kNeverStop{false};
  const std::atomic<bool>& stop = options.stop ? *options.stop : kNeverStop;
  const auto start = Clock::now();
  Progress building(stop);
  OfflineResult result;
  result.scene = RenderScene::build(document, options.previous.get(), &building);
  result.build_seconds = seconds_since(start);
  result.scene_bytes = result.scene->memory_bytes();
  result.display_scale = display_scale(*result.scene, document.settings);

  Accumulation accumulation(document.settings.film,
                            {.window = options.pass.crop,
                             .coarsest = until.time > 0 ? kCoarsest : 1,
                             .components = options.components,
                             .mix = light_mix(document.scene, result.scene->light_layers())});
  Accumulation::Limits limits{stop, {.seconds = kOfflinePassSeconds}, {}};
  if (options.progress)
    limits.on_pass = [&](const Accumulation& a) {
      if (a.spp() > 0) options.progress({a.spp(), a.seconds(), a.fraction(until), a.rays()});
    };
  const auto renderer = make_pass_renderer(options.pass.threads);
  const bool finished = accumulation.advance(*renderer, *result.scene, document, limits);
  result.interrupted = !finished;
  result.spp = accumulation.spp();

  Accumulation::State state = std::move(accumulation).state();
  result.film = std::move(state.film);
  result.layers = std::move(state.layers);
  result.components = std::move(state.components);
  result.rays = state.rays;
  result.nonfinite = std::move(state.nonfinite);
  result.render_seconds = state.seconds;
  result.converged = state.converged;
  if (result.spp == 0) result.missing = fill_missing(result);
  if (const LightMix& mix = state.options.mix; !is_plain(mix)) {
    Film mixed;
    result.layers.mix(result.film, mix, mixed);
    result.film = std::move(mixed);
  }
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
  // The pictures of an interrupted render are whole, too, but of few samples: the user wants it to end.
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
