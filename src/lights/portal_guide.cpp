#include "lights/portal_guide.h"

#include <algorithm>

namespace candela {

namespace {

/// An estimate of the mean cosine at the point over what it sees of the portal, by its corners and its
/// middle; 0 only where no direction through it has one.
float mean_cosine(const PortalRectangle& portal, const LightSamplingContext& ctx) {
  if (ctx.domain == ScatteringDomain::volume) return 1;
  const bool both = ctx.domain == ScatteringDomain::sphere;
  const vec3 middle = portal.center - ctx.position, x = portal.half_size.x * portal.axes.x,
             y = portal.half_size.y * portal.axes.y;
  auto cosine = [&](vec3 d) {
    const float c = glm::dot(d, ctx.normal) / std::max(glm::length(d), 1e-18f);
    return both ? std::abs(c) : std::max(c, 0.0f);
  };
  return (cosine(middle - x - y) + cosine(middle + x - y) + cosine(middle - x + y) + cosine(middle + x + y) +
          3 * cosine(middle)) /
         7;
}

PortalChart::Window window_of(const PortalRectangle& portal, const PortalChart& chart, vec3 position) {
  const glm::dvec3 d = glm::dvec3(portal.center) - glm::dvec3(position);
  const double distance = glm::dot(d, glm::dvec3(portal.axes.outwards));
  if (!(distance > 0)) return {};
  const glm::dvec2 middle(glm::dot(d, glm::dvec3(portal.axes.x)), glm::dot(d, glm::dvec3(portal.axes.y)));
  const glm::dvec2 half(portal.half_size);
  return chart.window((middle - half) / distance, (middle + half) / distance);
}

} // namespace

PortalGuide::PortalGuide(std::span<const PortalRectangle> portals,
                         std::span<const std::shared_ptr<const PortalChart>> charts) {
  // In an order that does not depend on addresses, nor does then the picture.
  for (std::size_t first = 0; first < portals.size(); ++first) {
    if (std::ranges::count(charts.first(first), charts[first]) > 0) continue;
    for (std::size_t i = first; i < portals.size(); ++i)
      if (charts[i] == charts[first]) portals_.push_back(portals[i]), charts_.push_back(charts[i]);
  }
}

PortalGuide::View PortalGuide::seen_from(const LightSamplingContext& ctx) const {
  View view;
  for (std::size_t i = 0; i < portals_.size(); ++i) {
    const float cosine = mean_cosine(portals_[i], ctx);
    if (!(cosine > 0)) continue;
    PortalChart::Window& w = view.windows[i];
    w = window_of(portals_[i], *charts_[i], ctx.position);
    view.facing[i] = cosine;
    w.sum *= static_cast<double>(cosine);
    view.sum += w.sum;
  }
  return view;
}

/// place(chart) is that of the direction in question.
template <class Place>
float PortalGuide::pdf_by(const View& view, Place place) const {
  double sum = 0;
  const PortalChart* chart = nullptr;
  std::optional<PortalChart::Place> at;
  for (std::size_t i = 0; i < portals_.size(); ++i) {
    if (!(view.windows[i].sum > 0)) continue;
    if (charts_[i].get() != chart) {
      chart = charts_[i].get();
      at = place(*chart);
    }
    if (at && PortalChart::contains(view.windows[i], *at))
      sum += static_cast<double>(view.facing[i]) * at->luminance;
  }
  return static_cast<float>(sum / view.sum);
}

PortalGuide::Sample PortalGuide::sample(const View& view, vec2 u) const {
  double left = static_cast<double>(u.x) * view.sum;
  std::size_t chosen = 0;
  while (chosen + 1 < portals_.size() && !(left < view.windows[chosen].sum))
    left -= view.windows[chosen++].sum;
  while (!(view.windows[chosen].sum > 0)) --chosen; // rounding led behind the last one
  const double share = std::min(left / view.windows[chosen].sum, static_cast<double>(kOneMinusEpsilon));
  const auto s = charts_[chosen]->sample(view.windows[chosen], {static_cast<float>(share), u.y});
  auto place = [&](const PortalChart& chart) {
    return &chart == charts_[chosen].get() ? std::optional(s.place) : chart.place(s.direction);
  };
  return {s.direction, pdf_by(view, place)};
}

float PortalGuide::pdf(const View& view, vec3 direction) const {
  return pdf_by(view, [&](const PortalChart& chart) { return chart.place(direction); });
}

} // namespace candela
