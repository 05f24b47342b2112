#include "app/figures/canvas.h"

#include "core/segment.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

Box overlap(const Box& a, const Box& b) {
  const int x0 = std::max(a.x, b.x), y0 = std::max(a.y, b.y);
  return {x0, y0, std::max(0, std::min(a.x + a.width, b.x + b.width) - x0),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y0)};
}

} // namespace

Canvas::Canvas(int width, int height, Rgb8 ground) {
  picture_.width = width;
  picture_.height = height;
  picture_.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  clip_ = {0, 0, width, height};
  fill(clip_, ground);
}

void Canvas::clip(const Box& box) { clip_ = overlap(box, {0, 0, picture_.width, picture_.height}); }

void Canvas::blend(int x, int y, Rgb8 color, float coverage) {
  if (x < clip_.x || y < clip_.y || x >= clip_.x + clip_.width || y >= clip_.y + clip_.height) return;
  std::uint8_t* pixel =
      picture_.rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                 static_cast<std::size_t>(x));
  for (std::size_t c = 0; c < 3; ++c) {
    const auto below = static_cast<float>(pixel[c]), above = static_cast<float>(color[c]);
    pixel[c] = static_cast<std::uint8_t>(below + (above - below) * coverage + 0.5f);
  }
}

void Canvas::fill(const Box& box, Rgb8 color) {
  const Box b = overlap(box, clip_);
  for (int y = b.y; y < b.y + b.height; ++y)
    for (int x = b.x; x < b.x + b.width; ++x) blend(x, y, color, 1);
}

void Canvas::frame(const Box& b, int t, Rgb8 color) {
  fill({b.x, b.y, b.width, t}, color);
  fill({b.x, b.y + b.height - t, b.width, t}, color);
  fill({b.x, b.y + t, t, b.height - 2 * t}, color);
  fill({b.x + b.width - t, b.y + t, t, b.height - 2 * t}, color);
}

void Canvas::draw(const RgbPicture& from, const Box& part, const Box& where) {
  const double step_x = static_cast<double>(part.width) / where.width,
               step_y = static_cast<double>(part.height) / where.height;
  // The texels [first, last) of which a pixel's interval covers most; at least one.
  auto interval = [](int i, double step, int origin, int size) {
    const int first = std::min(static_cast<int>(i * step + 1e-6), size - 1);
    const int last = std::clamp(static_cast<int>(std::lround((i + 1) * step)), first + 1, size);
    return std::pair(origin + first, origin + last);
  };
  for (int y = 0; y < where.height; ++y) {
    const auto [y0, y1] = interval(y, step_y, part.y, part.height);
    for (int x = 0; x < where.width; ++x) {
      const auto [x0, x1] = interval(x, step_x, part.x, part.width);
      unsigned sum[3] = {0, 0, 0};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += from.rgb[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(from.width) +
                                    static_cast<std::size_t>(u)) +
                               c];
      const auto count = static_cast<unsigned>((x1 - x0) * (y1 - y0));
      Rgb8 mean;
      for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
      blend(where.x + x, where.y + y, mean, 1);
    }
  }
}

void Canvas::line(std::span<const vec2> points, float width, Rgb8 color, bool dashed) {
  const auto segments = strokes_of(points, dashed ? 4 * std::max(width, 1.0f) : 0);
  if (segments.empty()) return;
  const float reach = 0.5f * width + 1;
  vec2 lo(1e9f), hi(-1e9f);
  for (auto [a, b] : segments) {
    lo = glm::min(lo, glm::min(a, b) - reach);
    hi = glm::max(hi, glm::max(a, b) + reach);
  }
  lo = glm::clamp(lo, vec2(-1e6f), vec2(1e6f));
  hi = glm::clamp(hi, vec2(-1e6f), vec2(1e6f));
  const Box all = overlap({static_cast<int>(std::floor(lo.x)), static_cast<int>(std::floor(lo.y)),
                           static_cast<int>(hi.x - lo.x) + 2, static_cast<int>(hi.y - lo.y) + 2},
                          clip_);
  if (all.width == 0 || all.height == 0) return;
  // First the union of all strokes, so that overlaps are not blended twice.
  std::vector<float> coverage(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height));
  for (auto [a, b] : segments) {
    const vec2 l = glm::min(a, b) - reach, h = glm::max(a, b) + reach;
    const int x1 = std::min(static_cast<int>(std::min(h.x, 1e6f)), all.x + all.width - 1),
              y1 = std::min(static_cast<int>(std::min(h.y, 1e6f)), all.y + all.height - 1);
    for (int y = std::max(static_cast<int>(std::floor(std::max(l.y, -1e6f))), all.y); y <= y1; ++y)
      for (int x = std::max(static_cast<int>(std::floor(std::max(l.x, -1e6f))), all.x); x <= x1; ++x) {
        const float d = distance_to_segment(vec2(x, y) + 0.5f, a, b);
        float& c = coverage[static_cast<std::size_t>(y - all.y) * static_cast<std::size_t>(all.width) +
                            static_cast<std::size_t>(x - all.x)];
        c = std::max(c, std::clamp(0.5f * width + 0.5f - d, 0.0f, 1.0f));
      }
  }
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x)
      blend(all.x + x, all.y + y, color,
            coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(all.width) +
                     static_cast<std::size_t>(x)]);
}

void Canvas::dot(vec2 center, float radius, Rgb8 color) {
  const vec2 ends[] = {center, center};
  line(ends, 2 * radius, color, false);
}

void Canvas::text(const Typeface& face, std::string_view text, float size, vec2 at, Rgb8 color) {
  for (const Typeface::Glyph& g : face.glyphs(text, size, at.x, at.y))
    for (int y = 0; y < g.height; ++y)
      for (int x = 0; x < g.width; ++x)
        blend(g.x + x, g.y + y, color,
              static_cast<float>(g.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(g.width) +
                                            static_cast<std::size_t>(x)]) /
                  255);
}

} // namespace candela
