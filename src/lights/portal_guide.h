#pragma once
// Where the light of the surroundings comes into a room: sampling an infinite light through rectangles.

#include "lights/light_sample.h"
#include "lights/portal_chart.h"

#include <array>
#include <memory>
#include <optional>
#include <span>

namespace candela {

/// An opening. World space.
struct PortalRectangle {
  vec3 center{0};
  PortalAxes axes;
  vec2 half_size{1}; ///< along the axes
  bool operator==(const PortalRectangle&) const = default;
};

/// All portals of a scene, for one infinite light, which is sampled as one sample of a mixture (Veach 1997,
/// section 9.2.4): through the portals, and by the light's own density, which finds what comes in elsewhere
/// and serves points outside of the room. No direction that the light's own density reaches is left out, so
/// portals change the noise alone, wherever they are.
class PortalGuide {
public:
  static constexpr std::size_t kMostPortals = 16;
  /// Of the samples, by the light's own density, where a portal is seen.
  static constexpr float kOwnShare = 0.125f;

  /// The chart of each portal; those of one orientation may share it. At most kMostPortals.
  PortalGuide(std::span<const PortalRectangle> portals,
              std::span<const std::shared_ptr<const PortalChart>> charts);

  /// What a point sees through each of them.
  struct View {
    std::array<PortalChart::Window, kMostPortals> windows;
    /// Of each: a mean of the cosine over it, which its sum is weighted by.
    std::array<float, kMostPortals> facing;
    double sum = 0; ///< of theirs, weighted
  };
  View seen_from(const LightSamplingContext& ctx) const;
  /// A unit direction through one of them, and its density in 1/sr; the view has a sum. u in [0, 1)^2.
  struct Sample {
    vec3 direction;
    float pdf;
  };
  Sample sample(const View& view, vec2 u) const;
  /// Density of sample(); the view has a sum.
  float pdf(const View& view, vec3 direction) const;
  /// Density of the mixture, 1/sr, given the light's own.
  float mixed_pdf(const View& view, vec3 direction, float own) const {
    return view.sum > 0 ? kOwnShare * own + (1 - kOwnShare) * pdf(view, direction) : own;
  }
  /// A sample of the mixture: own_sample(u) is a std::optional<LightSample>, found(direction) what arrives
  /// from there and the light's own density, a RadiancePdf.
  template <class OwnSample, class Found>
  std::optional<LightSample> mixed_sample(const LightSamplingContext& ctx, vec2 u, OwnSample own_sample,
                                          Found found) const {
    const View view = seen_from(ctx);
    if (!(view.sum > 0)) return own_sample(u);
    if (u.x < kOwnShare) {
      auto own = own_sample(vec2(std::min(u.x / kOwnShare, kOneMinusEpsilon), u.y));
      if (own) own->pdf = mixed_pdf(view, own->direction, own->pdf);
      return own;
    }
    const Sample through =
        sample(view, {std::min((u.x - kOwnShare) / (1 - kOwnShare), kOneMinusEpsilon), u.y});
    const RadiancePdf there = found(through.direction);
    LightSample s;
    s.direction = through.direction;
    s.radiance = there.radiance;
    s.pdf = kOwnShare * there.pdf + (1 - kOwnShare) * through.pdf;
    s.infinite = true;
    return s;
  }

private:
  template <class Place>
  float pdf_by(const View& view, Place place) const;

  /// Those of one chart lie side by side.
  std::vector<PortalRectangle> portals_;
  std::vector<std::shared_ptr<const PortalChart>> charts_; ///< parallel to them
};

} // namespace candela
