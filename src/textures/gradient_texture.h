#pragma once

#include "textures/two_colors.h"

namespace candela {

enum class GradientShape : int { linear, radial, angular };

/// From color_a to color_b: with u from 0 to 1, with the distance from (1/2, 1/2) up to 1/2, or with the
/// angle about it, counter-clockwise from the right. It continues as the wrap of its use says.
struct GradientTexture : TwoColors<GradientTexture> {
  static constexpr std::string_view kName = "gradient";
  static constexpr std::string_view kShapes[] = {"linear", "radial", "angular"};
  static std::span<const Field<GradientTexture>> rows() {
    static const Field<GradientTexture> table[] = {
        {{"color_a", FieldType::color, 0, 1e6, "", "Colour where it begins"},
         [](GradientTexture& t) -> void* { return &t.color_a; }},
        {{"color_b", FieldType::color, 0, 1e6, "", "Colour where it ends"},
         [](GradientTexture& t) -> void* { return &t.color_b; }},
        {{"shape", FieldType::choice, 0, 0, "", "Along u, outwards from the middle, or around the middle",
          Invalidates::image, kShapes},
         [](GradientTexture& t) -> void* { return &t.shape; }},
        {{"smooth", FieldType::boolean, 0, 0, "", "Begins and ends gently (smoothstep), not evenly"},
         [](GradientTexture& t) -> void* { return &t.smooth; }},
    };
    return table;
  }

  GradientShape shape = GradientShape::linear;
  bool smooth = false;
  bool operator==(const GradientTexture&) const = default;

  float share(const TextureUse& use, vec2 uv) const {
    const double t = ramp(uv).at;
    return std::isfinite(t) ? static_cast<float>(eased(wrapped(t, use.wrap))) : 0.0f;
  }
  /// The mean over a length of the ramp that has the footprint's second moment along it: exact for `linear`
  /// under an upright box.
  float mean_share(const TextureUse& use, const TexturePoint& at) const {
    const Ramp r = ramp(at.uv);
    const float a = glm::dot(at.footprint.major, r.gradient), b = glm::dot(at.footprint.minor, r.gradient);
    const double length = std::sqrt(static_cast<double>(a * a + b * b));
    constexpr double kPoint = 1e-5, kMany = 1e5; // a point; so many that they even out
    if (!(length > kPoint) || !std::isfinite(r.at)) return share(use, at.uv);
    if (shape == GradientShape::angular && length >= 1) return 0.5f;
    if (!(length < kMany)) return 0.5f;
    // Whole periods are left out: digits would be lost.
    const double t =
        use.wrap == TextureWrap::clamp ? std::clamp(r.at, -kMany, kMany) : r.at - 2 * std::floor(0.5 * r.at);
    const double mean =
        (integral(t + 0.5 * length, use.wrap) - integral(t - 0.5 * length, use.wrap)) / length;
    return static_cast<float>(std::clamp(mean, 0.0, 1.0));
  }
  /// As many as the eight bits of a screen tell apart.
  vec2 cells() const { return shape == GradientShape::linear ? vec2(256, 1) : vec2(256); }

private:
  struct Ramp {
    double at;     ///< 0 where it begins, 1 where it ends
    vec2 gradient; ///< by uv
  };
  Ramp ramp(vec2 uv) const {
    const vec2 d = uv - 0.5f;
    const float r = glm::length(d);
    switch (shape) {
    case GradientShape::linear: break;
    case GradientShape::radial: return {2.0 * static_cast<double>(r), r > 0 ? 2.0f / r * d : vec2(0)};
    case GradientShape::angular: {
      const double turn =
          std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * std::numbers::pi);
      const float per_length = 1 / (2 * kPi * std::max(r * r, 1e-12f));
      return {turn < 0 ? turn + 1 : turn, per_length * vec2(-d.y, d.x)};
    }
    }
    return {static_cast<double>(uv.x), {1, 0}};
  }
  /// Angles close on themselves: nothing is outside of their turn.
  TextureWrap wrap_of(TextureWrap wrap) const {
    return shape == GradientShape::angular ? TextureWrap::repeat : wrap;
  }
  double wrapped(double t, TextureWrap wrap) const {
    switch (wrap_of(wrap)) {
    case TextureWrap::repeat: break;
    case TextureWrap::clamp: return std::clamp(t, 0.0, 1.0);
    case TextureWrap::mirror: return 1 - std::abs(t - 2 * std::floor(0.5 * t) - 1);
    }
    return t - std::floor(t);
  }
  double eased(double t) const { return smooth ? t * t * (3 - 2 * t) : t; }
  /// Of eased() from 0, for t in [0, 1]; 1/2 at 1.
  double eased_integral(double t) const { return smooth ? t * t * t * (1 - 0.5 * t) : 0.5 * t * t; }
  /// Of eased(wrapped()) from 0.
  double integral(double t, TextureWrap wrap) const {
    switch (wrap_of(wrap)) {
    case TextureWrap::repeat: break;
    case TextureWrap::clamp: return eased_integral(std::clamp(t, 0.0, 1.0)) + std::max(t - 1, 0.0);
    case TextureWrap::mirror: {
      const double pairs = std::floor(0.5 * t), rest = t - 2 * pairs;
      return pairs + (rest < 1 ? eased_integral(rest) : 1 - eased_integral(2 - rest));
    }
    }
    return 0.5 * std::floor(t) + eased_integral(t - std::floor(t));
  }
};

} // namespace candela
