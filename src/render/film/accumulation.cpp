#include "render/film/accumulation.h"

#include "render/film/film_view.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

/// Samples a pixel in one pass: so many that the synchronisation at its end costs nothing.
constexpr int kMostSamples = 64;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, 1e9)));
}

template <class Predicate>
bool all_pixels(const Film& film, Predicate holds) {
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      if (!holds(x, y)) return false;
  return true;
}

bool has_stopped_pixels(const Film& film) {
  return !all_pixels(film, [&](int x, int y) { return !film.stopped(x, y); });
}

} // namespace

CropWindow Accumulation::window() const {
  const Film& f = state_.film;
  return {f.origin().x, f.origin().y, f.width(), f.height()};
}

void Accumulation::restart(const FilmSettings& frame, const AccumulationOptions& options) {
  const CropWindow part = clip_to_frame(options.window, frame.width, frame.height);
  const ivec2 origin(part.x, part.y);
  State fresh;
  fresh.options = options;
  fresh.next_lattice = options.coarsest;
  blank_ = state_.film.width() == 0 || state_.film.height() == 0;
  fresh.film = std::move(state_.film);
  if (!options.mix.empty()) fresh.layers = std::move(state_.layers);
  if (blank_) fresh.film = Film(), fresh.layers = LayerFilm();
  fresh.film.resize(part.width, part.height, origin, options.first_sample);
  fresh.layers.resize(options.mix.size(), part.width, part.height);
  if (options.components)
    for (Film& f : fresh.components) f = Film(part.width, part.height, origin, options.first_sample);
  fresh.schedule = std::move(state_.schedule); // its region stays
  fresh.schedule.reset(part, options.first_sample);
  state_ = std::move(fresh);
  seconds_per_sample_ = 0;
}

int Accumulation::spp() const {
  return state_.next_lattice != 0 ? 0
                                  : static_cast<int>(state_.schedule.samples() - state_.options.first_sample);
}

double Accumulation::samples_per_pixel() const {
  if (state_.next_lattice == 0) return spp();
  const int levels = std::countr_zero(static_cast<unsigned>(state_.options.coarsest)) + 1;
  const int left = std::countr_zero(static_cast<unsigned>(state_.next_lattice)) + 1;
  return static_cast<double>(levels - left) / levels;
}

bool Accumulation::finished(const StopSettings& until) const {
  const bool time_is_over = until.time > 0 && state_.seconds >= static_cast<double>(until.time);
  if (spp() == 0) return time_is_over && !state_.options.whole_first_pass;
  return state_.converged || time_is_over ||
         (until.noise > 0 && state_.noise <= static_cast<double>(until.noise)) ||
         (until.spp > 0 && spp() >= until.spp && !state_.open);
}

double Accumulation::fraction(const StopSettings& until) const {
  const double by_spp = until.spp > 0 ? static_cast<double>(spp()) / until.spp : 0;
  const double by_time = until.time > 0 ? state_.seconds / static_cast<double>(until.time) : 0;
  return std::min(std::max(by_spp, by_time), 1.0);
}

void Accumulation::set_mix(const LightMix& mix, const StopSettings& until) {
  assert(mix.size() == state_.options.mix.size());
  if (mix == state_.options.mix) return;
  state_.options.mix = mix;
  state_.noise = std::numeric_limits<double>::infinity();
  if (until.noise > 0 && is_noise_check(spp())) estimate_noise();
}

const Film& Accumulation::picture(Film& memory) const {
  if (is_plain(state_.options.mix)) return state_.film;
  state_.layers.mix(state_.film, state_.options.mix, memory, std::max(coarseness(), 1));
  return memory;
}

void Accumulation::estimate_noise() {
  Film memory;
  state_.noise = std::sqrt(estimated_relmse(picture(memory)));
}

void Accumulation::set_region(const CropWindow& region) {
  state_.schedule.set_region(region);
  state_.converged = false; // within another region
}

bool Accumulation::advance(PassRenderer& renderer, const RenderScene& scene, const Document& document,
                           const Limits& limits) {
  const StopSettings& until = document.settings.stop;
  while (!finished(until)) {
    const Pass pass = next(until, limits.portion);
    if (step(pass, renderer, scene, document, limits.stop).completed) {
      if (limits.on_pass) limits.on_pass(*this);
    } else if (limits.stop.asked()) {
      return false;
    }
  }
  return true;
}

Accumulation::Pass Accumulation::next(const StopSettings& until, const Portion& portion) const {
  Pass pass;
  const std::uint32_t first = state_.options.first_sample;
  if (state_.next_lattice != 0) {
    pass.first = true;
    pass.range = {first, first + 1, state_.next_lattice, state_.visited_lattice};
    return pass;
  }
  const SampleSchedule::Job one = state_.schedule.next(1);
  const double pixels = static_cast<double>(one.window.width) * one.window.height;
  int samples = 1;
  if (seconds_per_sample_ > 0)
    samples = static_cast<int>(
        std::clamp(portion.seconds / (seconds_per_sample_ * pixels), 1.0, double{kMostSamples}));
  if (portion.most_samples > 0) samples = std::min(samples, portion.most_samples);
  if (until.spp > 0) samples = std::min(samples, until.spp - spp());
  if (until.noise > 0) samples = std::min(samples, next_noise_check(spp()) - spp());
  // An open pass is completed, also beyond a stop.spp that was lowered meanwhile.
  const auto job = state_.schedule.next(static_cast<std::uint32_t>(std::max(samples, 1)));
  pass.range.begin = job.begin;
  pass.range.end = job.end;
  pass.window = job.window;
  return pass;
}

/// Of the samples that the film held before restart(). A level at a time: all at once would delay the first
/// picture.
void Accumulation::clear(const SampleRange& range) {
  state_.film.clear(range.lattice, range.skip_lattice);
  if (state_.layers.layers() > 0) state_.layers.clear(range.lattice, range.skip_lattice);
  for (Film& f : state_.components)
    if (f.width() > 0) f.clear(range.lattice, range.skip_lattice);
}

Accumulation::Step Accumulation::step(const Pass& pass, PassRenderer& renderer, const RenderScene& scene,
                                      const Document& document, StopCondition stop) {
  const auto start = Clock::now();
  const auto limit = static_cast<double>(document.settings.stop.time);
  if (limit > 0 && !(pass.first && state_.options.whole_first_pass))
    stop.at(start + duration_of(limit - state_.seconds));
  const bool continued = std::exchange(state_.open, true);
  if (pass.first && !continued && !blank_) clear(pass.range);
  PassFilms films{state_.film, {}};
  for (std::size_t i = 0; i < films.components.size(); ++i)
    if (state_.options.components) films.components[i] = &state_.components[i];
  if (!state_.options.mix.empty()) films.layers = &state_.layers;
  const auto rendering = Clock::now();
  const PassResult result = renderer.render({scene, document, pass.range, pass.window}, films, stop);
  Step step{result.completed, result.rays, seconds_since(rendering)};
  state_.rays += result.rays;
  state_.nonfinite += result.nonfinite;
  if (result.completed) {
    if (!pass.first && !continued) // or it was a part of a pass
      seconds_per_sample_ = step.seconds / (static_cast<double>(pass.range.end - pass.range.begin) *
                                            pass.window.width * pass.window.height);
    complete(pass, result, document.settings);
  }
  state_.seconds += seconds_since(start);
  if (pass.first && state_.next_lattice == 0) state_.first_pass_seconds = state_.seconds;
  return step;
}

void Accumulation::complete(const Pass& pass, const PassResult& result, const RenderSettings& settings) {
  state_.open = false;
  if (pass.first) {
    state_.visited_lattice = state_.next_lattice;
    state_.next_lattice /= 2;
    if (state_.next_lattice == 0) state_.schedule.reset(window(), pass.range.end);
  } else {
    state_.schedule.done({pass.window, pass.range.begin, pass.range.end});
  }
  if (spp() == 0) return;
  state_.converged = result.converged && settings.adaptive.error > 0;
  if (settings.stop.noise > 0 && is_noise_check(spp())) estimate_noise();
}

bool Accumulation::merge(const Accumulation& later) {
  const State& other = later.state_;
  const std::uint32_t begin = other.options.first_sample;
  const std::span<const SampleSchedule::Patch> patches = other.schedule.patches();
  const bool is_even = std::ranges::all_of(
      patches, [&](const SampleSchedule::Patch& p) { return p.samples == patches[0].samples; });
  const bool continues = begin > state_.options.first_sample;
  const bool may_begin = state_.next_lattice == 0 || at_coarsest();
  if (other.next_lattice != 0 || other.open || !is_even || state_.open || !may_begin ||
      other.options.components != state_.options.components ||
      other.options.mix.size() != state_.options.mix.size() ||
      (continues && (has_stopped_pixels(other.film) || has_stopped_pixels(state_.film))))
    return false;
  SampleSchedule schedule = state_.schedule;
  if (!schedule.add(later.window(), begin, patches[0].samples)) return false;
  if (at_coarsest() && !blank_) clear({});
  const bool was_empty = state_.next_lattice != 0;
  state_.schedule = std::move(schedule);
  state_.next_lattice = 0;
  state_.visited_lattice = 1;
  state_.layers.append(other.layers, state_.film, other.film);
  state_.film.append(other.film);
  for (std::size_t i = 0; i < state_.components.size(); ++i) state_.components[i].append(other.components[i]);
  state_.rays += other.rays;
  state_.nonfinite += other.nonfinite;
  state_.seconds += other.seconds;
  if (was_empty) state_.first_pass_seconds = other.first_pass_seconds;
  state_.converged = has_stopped_pixels(state_.film) &&
                     all_pixels(state_.film, [&](int x, int y) { return state_.film.stopped(x, y); });
  if (is_noise_check(spp())) estimate_noise();
  return true;
}

} // namespace candela
