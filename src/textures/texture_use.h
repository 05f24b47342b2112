#pragma once
// How a parameter of a material looks at a texture.

#include "core/color.h"
#include "core/fields.h"

#include <span>

namespace candela {

/// What a parameter takes of a texel. A number takes the luminance of `rgb`, a colour a grey of one channel.
enum class TextureChannel : int { rgb, red, green, blue, alpha };
/// `trilinear`: over the footprint of the ray that asks, where it has one, else as bilinear.
enum class TextureFilter : int { nearest, bilinear, trilinear };
/// What lies outside of [0, 1]^2: the texture again, its border, or its mirror images.
enum class TextureWrap : int { repeat, clamp, mirror };
/// What coordinates a texture is looked up by: those of the surface, or the position in the object's space,
/// projected along its three axes (textures/triplanar.h).
enum class TextureMapping : int { uv, triplanar };
/// What the integers of a picture mean; floats, alpha and procedural textures are linear in any case.
enum class ColorSpace : int { srgb, linear };

/// Where a texture is looked up: at scale * uv, turned about (0, 0) by `rotation`, + offset.
struct UvTransform {
  vec2 scale{1}, offset{0};
  float rotation = 0; ///< radians, counter-clockwise
  bool operator==(const UvTransform&) const = default;

  vec2 apply(vec2 uv) const { return apply_to_step(uv) + offset; }
  /// Of a difference of two places.
  vec2 apply_to_step(vec2 step) const {
    vec2 p = scale * step;
    if (rotation != 0) {
      const float c = std::cos(rotation), s = std::sin(rotation);
      p = {c * p.x - s * p.y, s * p.x + c * p.y};
    }
    return p;
  }
};

struct TextureUse {
  int texture = -1; ///< index into SceneDesc::textures; -1: none
  TextureChannel channel = TextureChannel::rgb;
  TextureFilter filter = TextureFilter::bilinear;
  TextureWrap wrap = TextureWrap::repeat;
  ColorSpace color_space = ColorSpace::srgb;
  TextureMapping mapping = TextureMapping::uv;
  float blend = 0.3f; ///< of the three projections, in [0, 1]
  UvTransform uv;
  bool operator==(const TextureUse&) const = default;
};

/// Rows of the choices and the rotation; the texture, scale and offset are not in them.
std::span<const Field<TextureUse>> texture_use_fields();

/// The channel of a texel that is known as red, green, blue, alpha.
inline float texel_number(vec4 texel, TextureChannel channel) {
  switch (channel) {
  case TextureChannel::rgb: break;
  case TextureChannel::red: return texel.x;
  case TextureChannel::green: return texel.y;
  case TextureChannel::blue: return texel.z;
  case TextureChannel::alpha: return texel.w;
  }
  return luminance(vec3(texel));
}
inline vec3 texel_color(vec4 texel, TextureChannel channel) {
  return channel == TextureChannel::rgb ? vec3(texel) : vec3(texel_number(texel, channel));
}

} // namespace candela
