#include "render/film/sample_schedule.h"

#include <algorithm>

namespace candela {

namespace {

PixelBox clipped(const CropWindow& window, const PixelBox& film) {
  return {std::max(window.x, film.x0), std::max(window.y, film.y0),
          std::min(window.x + window.width, film.x1), std::min(window.y + window.height, film.y1)};
}

bool is_empty(const PixelBox& r) { return r.x0 >= r.x1 || r.y0 >= r.y1; }

bool contains(const PixelBox& outer, const PixelBox& inner) {
  return inner.x0 >= outer.x0 && inner.x1 <= outer.x1 && inner.y0 >= outer.y0 && inner.y1 <= outer.y1;
}

/// The patches, cut along the edges of `edges`: each is inside or outside of it.
std::vector<SampleSchedule::Patch> cut(std::span<const SampleSchedule::Patch> patches,
                                       const PixelBox& edges) {
  std::vector<SampleSchedule::Patch> out;
  for (const SampleSchedule::Patch& patch : patches) {
    const PixelBox& p = patch.pixels;
    const int x0 = std::clamp(edges.x0, p.x0, p.x1), x1 = std::clamp(edges.x1, p.x0, p.x1);
    const int y0 = std::clamp(edges.y0, p.y0, p.y1), y1 = std::clamp(edges.y1, p.y0, p.y1);
    if (x0 == x1 || y0 == y1) {
      out.push_back(patch); // they do not meet
      continue;
    }
    for (const PixelBox& piece :
         {PixelBox{p.x0, p.y0, p.x1, y0}, PixelBox{p.x0, y1, p.x1, p.y1}, PixelBox{p.x0, y0, x0, y1},
          PixelBox{x1, y0, p.x1, y1}, PixelBox{x0, y0, x1, y1}})
      if (!is_empty(piece)) out.push_back({piece, patch.samples});
  }
  return out;
}

} // namespace

bool SampleSchedule::active(const Patch& p) const { return contains(region_, p.pixels); }

void SampleSchedule::reset(const CropWindow& film, std::uint32_t samples) {
  film_ = {film.x, film.y, film.x + film.width, film.y + film.height};
  patches_.assign(1, {film_, samples});
  set_region(wanted_);
}

void SampleSchedule::set_region(const CropWindow& region) {
  wanted_ = region;
  region_ = clipped(region, film_);
  if (region.empty() || is_empty(region_)) region_ = film_;
  patches_ = cut(patches_, region_);
  merge();
}

/// The patches of the region become one where they are equal.
void SampleSchedule::merge() {
  const std::uint32_t least = samples();
  auto is_active = [&](const Patch& p) { return active(p); };
  if (std::ranges::any_of(patches_, [&](const Patch& p) { return active(p) && p.samples != least; })) return;
  std::erase_if(patches_, is_active);
  patches_.push_back({region_, least});
}

std::uint32_t SampleSchedule::samples() const {
  std::uint32_t least = 0xffffffffu;
  for (const Patch& p : patches_)
    if (active(p)) least = std::min(least, p.samples);
  return least;
}

SampleSchedule::Job SampleSchedule::next(std::uint32_t portion) const {
  const std::uint32_t least = samples();
  std::uint32_t end = least + portion;
  const Patch* chosen = nullptr;
  for (const Patch& p : patches_) {
    if (!active(p)) continue;
    if (p.samples > least)
      end = std::min(end, p.samples);
    else if (chosen == nullptr)
      chosen = &p;
  }
  const PixelBox& r = chosen->pixels;
  return {{r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0}, least, end};
}

void SampleSchedule::done(const Job& job) {
  for (Patch& p : patches_)
    if (p.pixels.x0 == job.window.x && p.pixels.y0 == job.window.y && active(p)) p.samples = job.end;
  merge();
}

bool SampleSchedule::add(const CropWindow& window, std::uint32_t begin, std::uint32_t end) {
  const PixelBox rect{window.x, window.y, window.x + window.width, window.y + window.height};
  if (is_empty(rect) || !contains(film_, rect) || begin > end) return false;
  std::vector<Patch> patches = cut(patches_, rect);
  for (Patch& p : patches) {
    if (!contains(rect, p.pixels)) continue;
    if (p.samples != begin) return false;
    p.samples = end;
  }
  patches_ = std::move(patches);
  merge();
  return true;
}

} // namespace candela
