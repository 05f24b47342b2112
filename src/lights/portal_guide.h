#pragma once
// Where the light of the surroundings comes into a room: sampling an infinite light through rectangles.

#include "core/progress.h"
#include "core/spectrum.h"
#include "lights/light_sample.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace candela {

/// An opening. World space.
struct PortalRectangle {
  vec3 center{0};
  vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0}; ///< unit, along its sides
  vec3 outwards{0, 0, -1};               ///< unit, out of the room; perpendicular to both
  vec2 half_size{1};
  bool operator==(const PortalRectangle&) const = default;
};

/// The luminance of an infinite light by direction, over the hemisphere outside of one portal. In its chart,
/// the angles that a direction makes with the portal's axes, the portal is an upright rectangle from wherever
/// it is seen, so that its part of the light is one of a summed-area table (Bitterli, Novak and Jarosz 2015,
/// "Portal-Masked Environment Map Sampling"; pbrt-v4, sections 12.5.3 and A.5.5).
class PortalChart {
public:
  /// Cells along each side.
  static constexpr int kSide = 512;

  /// `radiance`: what arrives from a unit direction, W/(m^2 sr). Throws Cancelled soon after `progress` is
  /// told to end; it may be null.
  PortalChart(const PortalRectangle& portal, const std::function<Spectrum(vec3)>& radiance,
              const Progress* progress = nullptr);

  /// A rectangle of the chart, in cells, and what it sends.
  struct Window {
    glm::dvec2 lo{0}, hi{0};
    double sum = 0; ///< relative; 0 where the portal is not seen from inside, or nothing shines through it
  };
  /// What a point (world space) sees through the portal.
  Window seen_from(vec3 position) const;
  /// A unit direction in the window, in proportion to the luminance; u in [0, 1)^2. The window has a sum.
  vec3 sample(const Window& window, vec2 u) const;
  /// The sum of the window times the density, 1/sr, with which its sample() gives the unit direction.
  double luminance_at(const Window& window, vec3 direction) const;
  std::size_t memory_bytes() const { return cells_.size() * sizeof(float) + sums_.size() * sizeof(double); }

private:
  double cell(int x, int y) const {
    return static_cast<double>(cells_[static_cast<std::size_t>(y * kSide + x)]);
  }
  double corner_sum(int x, int y) const { return sums_[static_cast<std::size_t>(y * (kSide + 1) + x)]; }
  double sum_to(double x, double y) const;
  double sum_of(glm::dvec2 lo, glm::dvec2 hi) const;

  PortalRectangle portal_;
  std::vector<float> cells_; ///< row by row
  std::vector<double> sums_; ///< of all cells before each corner of the grid
};

/// All portals of a scene, for one infinite light, which is sampled as one sample of a mixture (Veach 1997,
/// section 9.2.4): through the portals, and by the light's own density, which finds what comes in elsewhere
/// and serves points outside of the room. So portals change the noise alone, wherever they are.
class PortalGuide {
public:
  static constexpr std::size_t kMostPortals = 16;
  /// Of the samples, by the light's own density, where a portal is seen.
  static constexpr float kOwnShare = 0.125f;

  /// At most kMostPortals.
  PortalGuide(std::span<const PortalRectangle> portals, const std::function<Spectrum(vec3)>& radiance,
              const Progress* progress = nullptr);

  /// What a point sees through each of them.
  struct View {
    std::array<PortalChart::Window, kMostPortals> windows;
    double sum = 0; ///< of theirs
  };
  View seen_from(vec3 position) const;
  /// A unit direction through one of them; the view has a sum. u in [0, 1)^2.
  vec3 sample(const View& view, vec2 u) const;
  /// Density of sample() in 1/sr; the view has a sum.
  float pdf(const View& view, vec3 direction) const;
  /// Density of the mixture, 1/sr, given the light's own.
  float mixed_pdf(const View& view, vec3 direction, float own) const {
    return view.sum > 0 ? kOwnShare * own + (1 - kOwnShare) * pdf(view, direction) : own;
  }
  /// A sample of the mixture: own_sample(u) is a std::optional<LightSample>, own_pdf(direction) its density,
  /// radiance(direction) what arrives.
  template <class OwnSample, class OwnPdf, class Radiance>
  std::optional<LightSample> mixed_sample(vec3 position, vec2 u, OwnSample own_sample, OwnPdf own_pdf,
                                          Radiance radiance) const {
    const View view = seen_from(position);
    if (!(view.sum > 0)) return own_sample(u);
    if (u.x < kOwnShare) {
      auto own = own_sample(vec2(std::min(u.x / kOwnShare, kOneMinusEpsilon), u.y));
      if (own) own->pdf = mixed_pdf(view, own->direction, own->pdf);
      return own;
    }
    LightSample s;
    s.direction = sample(view, {std::min((u.x - kOwnShare) / (1 - kOwnShare), kOneMinusEpsilon), u.y});
    const float density = pdf(view, s.direction);
    if (!(density > 0)) return std::nullopt; // rounding has led past the portal
    s.radiance = radiance(s.direction);
    s.pdf = kOwnShare * own_pdf(s.direction) + (1 - kOwnShare) * density;
    s.infinite = true;
    return s;
  }
  std::size_t memory_bytes() const;

private:
  std::vector<PortalChart> charts_;
};

} // namespace candela
