#include "textures/texture_grid.h"

#include "imaging/tone_map.h"
#include "textures/texel_decoding.h"

namespace candela {

namespace {

template <class T>
float decoded(T stored, ColorSpace space) {
  if constexpr (std::is_floating_point_v<T>)
    return stored;
  else
    return space == ColorSpace::linear ? linear_value(stored) : linear_from_srgb_table<T>()[stored];
}

vec4 texel_of(const Texels& texels, ivec2 at, ColorSpace space) {
  const auto channels = static_cast<std::size_t>(texels.channels);
  const std::size_t first =
      channels * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(texels.width) +
                  static_cast<std::size_t>(at.x));
  return std::visit(
      [&](const auto& values) {
        const float x = decoded(values[first], space);
        if (channels == 1) return vec4(x, x, x, 1);
        const float alpha = channels < 4 ? 1.0f : decoded(values[first + 3], ColorSpace::linear);
        return vec4(x, decoded(values[first + 1], space), decoded(values[first + 2], space), alpha);
      },
      texels.data);
}

vec4 texel_of(const MipPyramid::Level& level, std::size_t channels, ivec2 at) {
  const float* v =
      &level.values[channels * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(level.width) +
                                static_cast<std::size_t>(at.x))];
  return channels == 1 ? vec4(v[0], v[0], v[0], 1) : vec4(v[0], v[1], v[2], channels == 4 ? v[3] : 1);
}

/// Where an index of the copies from 0 on lies in the first of them.
int wrapped_index(int i, int n, TextureWrap wrap) {
  switch (wrap) {
  case TextureWrap::repeat: return i % n;
  case TextureWrap::clamp: return std::min(i, n - 1);
  case TextureWrap::mirror: return i / n % 2 == 0 ? i % n : n - 1 - i % n;
  }
  return 0;
}

} // namespace

TextureGrid::TextureGrid(std::shared_ptr<const Texture> texture, const TextureGridOptions& options,
                         std::shared_ptr<const MipPyramid> pyramid)
    : texture_(std::move(texture)), options_(options), pyramid_(std::move(pyramid)) {
  const ImageTexture* image = texture_->image();
  const std::size_t levels = pyramid_ ? pyramid_->levels().size() : 0;
  if (image == nullptr || options_.look)
    options_.level = 0;
  else
    options_.level = std::clamp(options_.level, 0, static_cast<int>(levels));
  if (image == nullptr)
    unit_ = ivec2(options_.resolution);
  else if (options_.level > 0) {
    const MipPyramid::Level& level = pyramid_->levels()[static_cast<std::size_t>(options_.level) - 1];
    unit_ = {level.width, level.height};
  } else
    unit_ = {image->texels->width, image->texels->height};
}

vec2 TextureGrid::uv(ivec2 at) const {
  const vec2 from_top = (vec2(at) + 0.5f) / vec2(unit_);
  return {from_top.x, static_cast<float>(options_.copies) - from_top.y};
}

ivec2 TextureGrid::wrapped(ivec2 at) const {
  const int from_bottom = options_.copies * unit_.y - 1 - at.y; // the first copy is the lowest one
  return {wrapped_index(at.x, unit_.x, options_.wrap),
          unit_.y - 1 - wrapped_index(from_bottom, unit_.y, options_.wrap)};
}

vec4 TextureGrid::value(ivec2 at) const {
  if (options_.look) {
    const ParameterLook& look = *options_.look;
    const vec3 texel = look.is_number ? vec3(texture_number(*texture_, look.use, uv(at)))
                                      : texture_color(*texture_, look.use, uv(at));
    const vec3 factor = look.is_number ? vec3(look.factor.x) : look.factor;
    const vec3 offset = look.is_number ? vec3(look.offset.x) : look.offset;
    return vec4(glm::clamp(factor * texel + offset, look.lowest, look.highest), 1);
  }
  const ImageTexture* image = texture_->image();
  if (image == nullptr) return vec4(texture_color(*texture_, TextureUse(), uv(at)), 1);
  const ivec2 texel = wrapped(at);
  if (options_.level == 0) return texel_of(*image->texels, texel, options_.color_space);
  return texel_of(pyramid_->levels()[static_cast<std::size_t>(options_.level) - 1],
                  static_cast<std::size_t>(image->texels->channels), texel);
}

std::optional<StoredTexel> TextureGrid::stored(ivec2 at) const {
  const ImageTexture* image = texture_->image();
  if (image == nullptr || options_.look || options_.level > 0) return std::nullopt;
  const Texels& texels = *image->texels;
  const ivec2 texel = wrapped(at);
  const std::size_t first = static_cast<std::size_t>(texels.channels) *
                            (static_cast<std::size_t>(texel.y) * static_cast<std::size_t>(texels.width) +
                             static_cast<std::size_t>(texel.x));
  StoredTexel out;
  out.channels = texels.channels;
  std::visit(
      [&](const auto& values) {
        out.integer = std::is_integral_v<typename std::decay_t<decltype(values)>::value_type>;
        for (std::size_t c = 0; c < static_cast<std::size_t>(texels.channels); ++c)
          out.values[c] = static_cast<float>(values[first + c]);
      },
      texels.data);
  return out;
}

bool TextureGrid::holds_codes() const {
  const ImageTexture* image = texture_->image();
  return image != nullptr && !options_.look && options_.color_space == ColorSpace::linear &&
         !std::holds_alternative<std::vector<float>>(image->texels->data);
}

ivec2 reduced_size(ivec2 size, int reduction) {
  const int block = 1 << reduction;
  return (size + (block - 1)) / block;
}

std::vector<std::uint8_t> grid_pixels(const TextureGrid& grid, const TextureDisplay& display, int reduction,
                                      ivec2 origin, ivec2 size, const Progress* progress) {
  const int block = 1 << reduction, taps = std::min(block, 4);
  const ivec2 last = grid.size() - 1;
  const bool codes = grid.holds_codes();
  const float exposure = std::exp2(display.exposure);
  auto byte = [&](float x) { return srgb8_from_linear(exposure * (codes ? linear_from_srgb(x) : x)); };
  auto mean = [&](ivec2 pixel) {
    if (block == 1) return grid.value(glm::min(pixel, last));
    vec4 sum(0);
    for (int j = 0; j < taps; ++j)
      for (int i = 0; i < taps; ++i)
        sum += grid.value(glm::min(block * pixel + (2 * ivec2(i, j) + 1) * block / (2 * taps), last));
    return sum / static_cast<float>(taps * taps);
  };
  std::vector<std::uint8_t> out;
  out.reserve(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (int y = 0; y < size.y; ++y) {
    if (progress != nullptr) progress->check();
    for (int x = 0; x < size.x; ++x) {
      const vec4 v = mean(origin + ivec2(x, y));
      if (display.channel == ShownChannel::rgb) {
        out.insert(out.end(), {byte(v.x), byte(v.y), byte(v.z), 255});
        continue;
      }
      const auto alpha = static_cast<std::uint8_t>(255 * std::clamp(v.w, 0.0f, 1.0f) + 0.5f);
      const std::uint8_t grey =
          display.channel == ShownChannel::alpha ? alpha : byte(v[static_cast<int>(display.channel) - 1]);
      out.insert(out.end(), {grey, grey, grey, 255});
    }
  }
  return out;
}

} // namespace candela
