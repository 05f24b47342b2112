#pragma once

#include "lights/area_light.h"
#include "sampling/spherical_rectangle.h"
#include "sampling/warp.h"

namespace candela {

/// Curves that shine, as pieces.
class CurvePieces {
public:
  /// Where a ray first meets a piece.
  struct Meeting {
    vec3 point, point_error, normal; ///< as LightSample has them
  };
  /// From a point in a unit direction; nothing if it misses the piece, or meets it where both the piece and a
  /// neighbour lie and the place counts as the neighbour's.
  virtual std::optional<Meeting> meet(std::uint32_t piece, vec3 from, vec3 direction) const = 0;

protected:
  ~CurvePieces() = default;
};

/// A piece of a curve. There is no closed form for directions to one. Those to a rectangle that hides it are
/// sampled in solid angle, or where the point looks along the curve those to a ball; rays that miss the curve
/// carry nothing. So the density is that of the proxy, wherever the curve is met, and samples are exact.
struct CurveLight {
  vec3 start{0}, axis{0, 0, 1}; ///< the piece lies within a cylinder from there; axis: unit
  float length = 0, radius = 0; ///< of the cylinder
  float area = 0;               ///< of the piece's surface
  Spectrum emission{0};
  const CurvePieces* curves = nullptr; ///< somebody else's
  std::uint32_t piece = 0;

  static constexpr std::string_view kName = "curve";
  static constexpr LightKind kind = LightKind::area;

  std::optional<LightSample> sample(const LightSamplingContext& ctx, vec2 u) const {
    const Proxy proxy(*this, ctx.position);
    const vec3 direction = proxy.sample(u);
    const auto met = curves->meet(piece, ctx.position, direction);
    std::optional<LightSample> s;
    if (met)
      set_towards(s.emplace(), ctx, met->point, met->point_error, met->normal, emission,
                  proxy.pdf(direction));
    return s;
  }
  float pdf(const LightSamplingContext& ctx, vec3, vec3 direction) const {
    return Proxy(*this, ctx.position).pdf(direction);
  }
  float power(float) const { return area_light_power(emission, area, false); }
  std::optional<LightBounds> bounds() const {
    return omnidirectional_bounds(start + 0.5f * length * axis, ball_radius(),
                                  static_cast<double>(luminance(emission)) *
                                      static_cast<double>(area * kInvPi)); // as seen from the side
  }

private:
  float ball_radius() const { return std::sqrt(sqr(0.5f * length) + sqr(radius)); }

  /// What hides the piece from a point. All directions in which it is met are among those sampled.
  class Proxy {
  public:
    Proxy(const CurveLight& light, vec3 from) {
      const vec3 d = light.start - from;
      const float along = glm::dot(d, light.axis), r = light.radius;
      const vec3 to_center = d + 0.5f * light.length * light.axis;
      const float distance2 = length_squared(to_center), ball2 = sqr(light.ball_radius());
      const bool inside = !(distance2 > 1.0001f * ball2);
      x_ = light.axis;
      one_minus_cos_ = inside ? 2 : one_minus_cos_from_sin2(ball2 / distance2); // all around, or a cone
      const vec3 off = d - along * light.axis;
      const float h = glm::length(off);
      if (h > kNear * r) {
        // In the plane of the axis that faces the point, whose distance is h. The cylinder lies between the
        // distances h - r and h + r, and is seen as wide as its circle.
        auto end = [&](float at, bool last) { return at * h / ((at > 0) == last ? h - r : h + r); };
        const float lo = end(along, false), hi = end(along + light.length, true),
                    half = h * r / std::sqrt(h * h - r * r);
        auto wide = [](float value) { return static_cast<double>(value); };
        const ProjectedRectangle seen(wide(lo), wide(-half), wide(h), wide(hi - lo), wide(2 * half));
        if (seen.solid_angle < wide(2 * kPi * one_minus_cos_)) {
          z_ = off / h, y_ = glm::cross(z_, x_);
          lo_ = lo, half_ = half, h_ = h, length_ = hi - lo;
          seen_ = seen;
          return;
        }
      }
      to_center_ = inside ? vec3(0, 0, 1) : to_center / std::sqrt(distance2);
    }

    vec3 sample(vec2 u) const {
      if (!seen_) return Basis::from_normal(to_center_).to_world(sample_uniform_cone(u, one_minus_cos_));
      vec2 place = u * vec2(length_, 2 * half_);
      if (by_solid_angle()) {
        const auto p = seen_->sample(static_cast<double>(u.x), static_cast<double>(u.y));
        place = {static_cast<float>(p.x), static_cast<float>(p.y)};
      }
      return glm::normalize((lo_ + place.x) * x_ + (place.y - half_) * y_ + h_ * z_);
    }
    /// Of a direction that sample() may give, 1/sr.
    float pdf(vec3 direction) const {
      if (!seen_) return uniform_cone_pdf(one_minus_cos_);
      if (by_solid_angle()) return static_cast<float>(1 / seen_->solid_angle);
      const float cosine = glm::dot(direction, z_);
      return cosine > 0 ? sqr(h_) / (cosine * sqr(cosine) * length_ * 2 * half_) : 0;
    }

  private:
    /// In radii, the least distance from the axis for a rectangle, which grows without bounds at the
    /// cylinder.
    static constexpr float kNear = 1.1f;

    bool by_solid_angle() const {
      return seen_->solid_angle >= static_cast<double>(SphericalRectangle::kMinSolidAngle);
    }

    vec3 x_{0}, y_{0}, z_{0};                ///< along the axis, across, and from the point to the axis
    float lo_ = 0, half_ = 0, length_ = 0;   ///< the rectangle along x, from lo, and along y
    float h_ = 0;                            ///< its distance
    std::optional<ProjectedRectangle> seen_; ///< in these axes; nothing: a ball instead
    vec3 to_center_{0};
    float one_minus_cos_ = 2;
  };
};

} // namespace candela
