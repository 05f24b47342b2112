#include "session/sample_schedule.h"

#include <algorithm>

namespace candela {

void SampleSchedule::reset(int width, int height, std::uint32_t samples) {
  width_ = width;
  height_ = height;
  patches_.assign(1, {0, 0, width, height, samples});
  set_region(wanted_);
}

void SampleSchedule::set_region(const CropWindow& region) {
  wanted_ = region;
  const Patch clipped{std::max(region.x, 0), std::max(region.y, 0), std::min(region.x + region.width, width_),
                      std::min(region.y + region.height, height_), 0};
  const bool empty =
      region.width <= 0 || region.height <= 0 || clipped.x0 >= clipped.x1 || clipped.y0 >= clipped.y1;
  region_ = empty ? Patch{0, 0, width_, height_, 0} : clipped;
  split();
  merge();
}

/// Cuts the patches along the region's edges.
void SampleSchedule::split() {
  std::vector<Patch> out;
  for (const Patch& p : patches_) {
    const int x0 = std::clamp(region_.x0, p.x0, p.x1), x1 = std::clamp(region_.x1, p.x0, p.x1);
    const int y0 = std::clamp(region_.y0, p.y0, p.y1), y1 = std::clamp(region_.y1, p.y0, p.y1);
    if (x0 == x1 || y0 == y1) {
      out.push_back(p); // they do not meet
      continue;
    }
    for (const Patch& piece : {Patch{p.x0, p.y0, p.x1, y0, p.samples}, Patch{p.x0, y1, p.x1, p.y1, p.samples},
                               Patch{p.x0, y0, x0, y1, p.samples}, Patch{x1, y0, p.x1, y1, p.samples},
                               Patch{x0, y0, x1, y1, p.samples}})
      if (piece.x0 < piece.x1 && piece.y0 < piece.y1) out.push_back(piece);
  }
  patches_ = std::move(out);
}

/// The patches of the region become one where they are equal.
void SampleSchedule::merge() {
  const std::uint32_t least = samples();
  auto is_active = [&](const Patch& p) { return active(p); };
  if (std::ranges::any_of(patches_, [&](const Patch& p) { return active(p) && p.samples != least; })) return;
  std::erase_if(patches_, is_active);
  patches_.push_back({region_.x0, region_.y0, region_.x1, region_.y1, least});
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
  return {{chosen->x0, chosen->y0, chosen->x1 - chosen->x0, chosen->y1 - chosen->y0}, least, end};
}

void SampleSchedule::done(const Job& job) {
  for (Patch& p : patches_)
    if (p.x0 == job.window.x && p.y0 == job.window.y && active(p)) p.samples = job.end;
  merge();
}

} // namespace candela
