#include "render/camera/lens_section.h"

#include <algorithm>

namespace candela {

namespace {

/// z of the interface at the height x.
float height_of(const LensSurface<float>& s, float x) {
  const float k = s.curvature;
  return s.z + k * sqr(x) / (1 + safe_sqrt(1 - sqr(k * x)));
}

/// From -radius to radius.
std::vector<vec2> arc(const LensSurface<float>& s) {
  constexpr int kSteps = 24;
  std::vector<vec2> points;
  for (int i = 0; i <= kSteps; ++i) {
    const float x = s.radius * (2 * static_cast<float>(i) / kSteps - 1);
    points.emplace_back(height_of(s, x), x);
  }
  return points;
}

} // namespace

LensSection lens_section(const LensSystem& lens) {
  LensSection section;
  section.film_z = -lens.film_distance();
  section.film_radius = lens.film_radius();
  const auto surfaces = lens.surfaces();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const LensSurface<float>& s = surfaces[i];
    section.stop_rim = std::max(section.stop_rim, s.radius);
    if (s.stop) section.stop_z = s.z, section.stop_radius = s.radius;
    if (i + 1 == surfaces.size() || s.eta_scene == 1) continue; // air towards the scene
    std::vector<vec2> outline = arc(s), other = arc(surfaces[i + 1]);
    outline.insert(outline.end(), other.rbegin(), other.rend());
    outline.push_back(outline.front());
    section.elements.push_back(std::move(outline));
  }
  return section;
}

std::vector<LensPath> lens_paths(const LensSystem& lens, float x, int count, float beyond) {
  std::vector<LensPath> paths;
  const vec3 from(x, 0, -lens.film_distance());
  const LensSurface<float>& last = lens.surfaces().front();
  for (int i = 0; i < count; ++i) {
    const float to =
        last.radius * (count > 1 ? 2 * static_cast<float>(i) / static_cast<float>(count - 1) - 1 : 0);
    const LensRay ray{from, glm::normalize(vec3(to, 0, height_of(last, to)) - from)};
    LensPath& path = paths.emplace_back();
    path.points.emplace_back(from.z, from.x);
    for (vec3 p : lens.path_from_film(ray)) path.points.emplace_back(p.z, p.x);
    const auto out = lens.trace_from_film(ray);
    path.passes = out.has_value();
    if (!out) continue;
    const vec3 end = out->origin + beyond * out->direction;
    path.points.emplace_back(end.z, end.x);
  }
  return paths;
}

float lens_blur(const LensSystem& lens, float distance) {
  constexpr int kRays = 33;
  const auto pupil_z = static_cast<float>(lens.entrance_pupil().z);
  const auto radius = static_cast<float>(lens.entrance_pupil().radius);
  float low = kInfinity, high = -kInfinity;
  for (int i = 0; i < kRays; ++i) {
    const float to = radius * (2 * static_cast<float>(i) / (kRays - 1) - 1);
    const vec3 from(0, 0, pupil_z + distance), direction = glm::normalize(vec3(to, 0, pupil_z) - from);
    // It begins just before the lens: over a long way floats would lose what the spot is made of.
    const float before = std::max(distance - (lens.front_vertex() - pupil_z) - 2 * radius, 0.0f);
    const vec3 near(before * to / distance, 0, from.z - before);
    const auto out = lens.trace_from_scene({near, direction});
    if (!out) continue;
    const float x =
        out->origin.x + (-lens.film_distance() - out->origin.z) * out->direction.x / out->direction.z;
    low = std::min(low, x), high = std::max(high, x);
  }
  return high >= low ? high - low : 0;
}

float thin_lens_blur(const LensSystem& lens, float distance) {
  const auto f = static_cast<float>(lens.focal_length());
  const float s = lens.focus_distance(), n = lens.f_number();
  if (!std::isfinite(s)) return sqr(f) / (n * distance);
  return sqr(f) * std::abs(distance - s) / (n * distance * (s - f));
}

} // namespace candela
