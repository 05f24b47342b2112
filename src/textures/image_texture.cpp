#include "textures/image_texture.h"

#include "core/color.h"

#include <array>

namespace candela {

namespace {

/// Values of all integers of the type that an sRGB picture may hold.
template <class Integer>
const std::vector<float>& linear_from_srgb_table() {
  static const std::vector<float> table = [] {
    constexpr std::size_t kMost = std::numeric_limits<Integer>::max();
    std::vector<float> t(kMost + 1);
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = linear_from_srgb(static_cast<float>(i) / static_cast<float>(kMost));
    return t;
  }();
  return table;
}

/// The integers' values without an encoding.
template <class Integer>
float linear_value(Integer i) {
  return static_cast<float>(i) / static_cast<float>(std::numeric_limits<Integer>::max());
}

/// Reads texels as the use asks: `decode` takes what is stored to a linear value.
template <class T, class Decode>
struct TexelReader {
  const std::vector<T>& values;
  std::size_t channels;
  TextureChannel channel;
  Decode decode;

  float alpha(std::size_t at) const {
    if (channels < 4) return 1;
    if constexpr (std::is_integral_v<T>)
      return linear_value(values[at + 3]);
    else
      return values[at + 3];
  }
  vec4 texel(std::size_t at) const {
    const float first = decode(values[at]);
    if (channels == 1) return vec4(first, first, first, 1);
    return vec4(first, decode(values[at + 1]), decode(values[at + 2]), alpha(at));
  }
  /// Of pictures in colour.
  vec3 rgb(std::size_t texel_index) const {
    const std::size_t at = texel_index * channels;
    return {decode(values[at]), decode(values[at + 1]), decode(values[at + 2])};
  }
  vec3 color(std::size_t texel_index) const {
    const std::size_t at = texel_index * channels;
    if (channel != TextureChannel::rgb) return vec3(number(texel_index));
    return channels == 1 ? vec3(decode(values[at])) : rgb(texel_index);
  }
  float number(std::size_t texel_index) const {
    const std::size_t at = texel_index * channels;
    if (channels == 1 && channel != TextureChannel::alpha) return decode(values[at]); // also its luminance
    return texel_number(texel(at), channel);
  }
};

/// Calls look(reader) with the reader of the picture's format.
template <class Look>
auto with_reader(const Texels& texels, const TextureUse& use, Look look) {
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const auto n = static_cast<std::size_t>(texels.channels);
        auto reading = [&](auto decode) {
          return look(TexelReader<T, decltype(decode)>{values, n, use.channel, decode});
        };
        if constexpr (std::is_floating_point_v<T>) {
          return reading([](float value) { return value; });
        } else {
          if (use.color_space == ColorSpace::linear)
            return reading([](T value) { return linear_value(value); });
          const float* table = linear_from_srgb_table<T>().data();
          return reading([table](T value) { return table[value]; });
        }
      },
      texels.data);
}

/// Where in [0, 1] a coordinate lies in the texture itself.
float wrapped(float t, TextureWrap wrap) {
  float p = 0;
  switch (wrap) {
  case TextureWrap::repeat: p = t - std::floor(t); break;
  case TextureWrap::clamp: p = std::clamp(t, 0.0f, 1.0f); break;
  case TextureWrap::mirror:
    p = t - 2 * std::floor(0.5f * t);
    p = p > 1 ? 2 - p : p;
    break;
  }
  return p >= 0 && p <= 1 ? p : 0; // not NaN
}

/// A texel one beyond the border.
int neighbor(int i, int n, TextureWrap wrap) {
  if (wrap == TextureWrap::repeat) return i < 0 ? i + n : (i >= n ? i - n : i);
  return std::clamp(i, 0, n - 1);
}

/// `texel(index)` blended as the use asks.
template <class Texel>
auto filtered(const Texels& texels, const TextureUse& use, vec2 uv, Texel texel) {
  const int w = texels.width, h = texels.height;
  vec2 p{wrapped(uv.x, use.wrap), wrapped(uv.y, use.wrap)};
  auto at = [&](int i, int j) {
    return texel(static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i));
  };
  float x = p.x * static_cast<float>(w), y = (1 - p.y) * static_cast<float>(h);
  if (use.filter == TextureFilter::nearest)
    return at(std::min(static_cast<int>(x), w - 1), std::min(static_cast<int>(y), h - 1));
  x -= 0.5f, y -= 0.5f;
  float fx = std::floor(x), fy = std::floor(y);
  int x0 = neighbor(static_cast<int>(fx), w, use.wrap), y0 = neighbor(static_cast<int>(fy), h, use.wrap);
  int x1 = neighbor(static_cast<int>(fx) + 1, w, use.wrap),
      y1 = neighbor(static_cast<int>(fy) + 1, h, use.wrap);
  return glm::mix(glm::mix(at(x0, y0), at(x1, y0), x - fx), glm::mix(at(x0, y1), at(x1, y1), x - fx), y - fy);
}

} // namespace

vec3 ImageTexture::color(const TextureUse& use, vec2 uv) const {
  return with_reader(*texels, use, [&](const auto& reader) {
    // What most textures are, without a question for each texel.
    if (texels->channels >= 3 && use.channel == TextureChannel::rgb)
      return filtered(*texels, use, uv, [&](std::size_t i) { return reader.rgb(i); });
    return filtered(*texels, use, uv, [&](std::size_t i) { return reader.color(i); });
  });
}

float ImageTexture::number(const TextureUse& use, vec2 uv) const {
  return with_reader(*texels, use, [&](const auto& reader) {
    return filtered(*texels, use, uv, [&](std::size_t i) { return reader.number(i); });
  });
}

} // namespace candela
