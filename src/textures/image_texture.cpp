#include "textures/image_texture.h"

#include "textures/texel_decoding.h"

namespace candela {

namespace {

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
        return with_decoding<T>(use.color_space, [&](auto decode) {
          return look(TexelReader<T, decltype(decode)>{values, n, use.channel, decode});
        });
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

/// at(x, y) of a picture of w x h texels, blended between the four about p in [0, 1]^2.
template <class At>
auto blended(int w, int h, TextureWrap wrap, vec2 p, At at) {
  float x = p.x * static_cast<float>(w) - 0.5f, y = (1 - p.y) * static_cast<float>(h) - 0.5f;
  float fx = std::floor(x), fy = std::floor(y);
  int x0 = neighbor(static_cast<int>(fx), w, wrap), y0 = neighbor(static_cast<int>(fy), h, wrap);
  int x1 = neighbor(static_cast<int>(fx) + 1, w, wrap), y1 = neighbor(static_cast<int>(fy) + 1, h, wrap);
  return glm::mix(glm::mix(at(x0, y0), at(x1, y0), x - fx), glm::mix(at(x0, y1), at(x1, y1), x - fx), y - fy);
}

/// `texel(index)` blended as the use asks.
template <class Texel>
auto filtered_at(const Texels& texels, const TextureUse& use, vec2 uv, Texel texel) {
  const int w = texels.width, h = texels.height;
  vec2 p{wrapped(uv.x, use.wrap), wrapped(uv.y, use.wrap)};
  auto at = [&](int i, int j) {
    return texel(static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i));
  };
  if (use.filter == TextureFilter::nearest)
    return at(std::min(static_cast<int>(p.x * static_cast<float>(w)), w - 1),
              std::min(static_cast<int>((1 - p.y) * static_cast<float>(h)), h - 1));
  return blended(w, h, use.wrap, p, at);
}

/// The same of a level of a pyramid: red, green, blue, alpha.
vec4 level_at(const MipPyramid::Level& level, int channels, TextureWrap wrap, vec2 uv) {
  return blended(
      level.width, level.height, wrap, {wrapped(uv.x, wrap), wrapped(uv.y, wrap)}, [&](int x, int y) {
        const auto texel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x);
        const float* v = &level.values[texel * static_cast<std::size_t>(channels)];
        return channels == 1 ? vec4(v[0], v[0], v[0], 1) : vec4(v[0], v[1], v[2], channels == 4 ? v[3] : 1);
      });
}

} // namespace

vec3 ImageTexture::color(const TextureUse& use, vec2 uv) const {
  return with_reader(*texels, use, [&](const auto& reader) {
    // What most textures are, without a question for each texel.
    if (texels->channels >= 3 && use.channel == TextureChannel::rgb)
      return filtered_at(*texels, use, uv, [&](std::size_t i) { return reader.rgb(i); });
    return filtered_at(*texels, use, uv, [&](std::size_t i) { return reader.color(i); });
  });
}

float ImageTexture::number(const TextureUse& use, vec2 uv) const {
  return with_reader(*texels, use, [&](const auto& reader) {
    return filtered_at(*texels, use, uv, [&](std::size_t i) { return reader.number(i); });
  });
}

vec4 ImageTexture::filtered(const TextureUse& use, const TexturePoint& at, const MipPyramid& pyramid) const {
  // The footprint in texels: how long it is, and how wide at right angles to that.
  vec2 along = at.footprint.major;
  const vec2 size = cells();
  vec2 a = along * size, b = at.footprint.minor * size;
  if (glm::dot(a, a) < glm::dot(b, b)) std::swap(a, b), along = at.footprint.minor;
  const float length = glm::length(a);
  const std::span<const MipPyramid::Level> levels = pyramid.levels();
  auto picture = [&](vec2 uv) {
    return with_reader(*texels, use, [&](const auto& reader) {
      return filtered_at(*texels, use, uv, [&](std::size_t i) { return reader.texel(i * reader.channels); });
    });
  };
  auto level_of = [&](std::size_t i, vec2 uv) {
    return i == 0 ? picture(uv) : level_at(levels[i - 1], texels->channels, use.wrap, uv);
  };
  constexpr float kEndless = 1e9f;
  if (!(length > 1) || levels.empty()) return picture(at.uv);
  if (!(length < kEndless)) return level_of(levels.size(), at.uv);
  // Several lookups along it, each over a square (as in graphics hardware, see McCormack et al. 1999,
  // "Feline"): of a plane seen at a flat angle one square would blur across, or alias along.
  constexpr int kMostTaps = 8;
  const float across = std::abs(a.x * b.y - a.y * b.x) / length;
  const float width = std::max({across, length / kMostTaps, 1.0f});
  const int taps = std::clamp(static_cast<int>(std::ceil(length / width)), 1, kMostTaps);
  const float level = std::min(std::log2(width), static_cast<float>(levels.size()));
  const auto fine = static_cast<std::size_t>(level);
  const float rest = level - static_cast<float>(fine);
  vec4 sum(0);
  for (int i = 0; i < taps; ++i) {
    const vec2 uv = at.uv + ((static_cast<float>(i) + 0.5f) / static_cast<float>(taps) - 0.5f) * along;
    const vec4 value = level_of(fine, uv);
    sum += rest > 0 ? glm::mix(value, level_of(fine + 1, uv), rest) : value;
  }
  return sum / static_cast<float>(taps);
}

} // namespace candela
