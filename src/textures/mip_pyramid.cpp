#include "textures/mip_pyramid.h"

#include "textures/texel_decoding.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Calls add(i, weight) for the cells of `from` that cell `index` of `to` covers, when both divide the same
/// length evenly. The weights sum to 1.
template <class Add>
void each_covered(int index, int to, int from, Add add) {
  const double ratio = static_cast<double>(from) / static_cast<double>(to), begin = index * ratio,
               end = (index + 1) * ratio;
  for (int i = static_cast<int>(begin); i < from && i < end; ++i)
    add(i, static_cast<float>((std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i))) / ratio));
}

/// Of an image whose rows row(y) gives, which are interleaved channels.
template <class Row>
MipPyramid::Level halved(int width, int height, std::size_t channels, Row row, const Progress* progress) {
  MipPyramid::Level out{std::max(width / 2, 1), std::max(height / 2, 1), {}};
  const std::size_t length = static_cast<std::size_t>(out.width) * channels;
  out.values.assign(length * static_cast<std::size_t>(out.height), 0.0f);
  for (int y = 0; y < out.height; ++y) {
    if (progress != nullptr) progress->check();
    float* to = &out.values[static_cast<std::size_t>(y) * length];
    each_covered(y, out.height, height, [&](int from_y, float weight_y) {
      const float* from = row(from_y);
      for (int x = 0; x < out.width; ++x)
        each_covered(x, out.width, width, [&](int from_x, float weight_x) {
          for (std::size_t c = 0; c < channels; ++c)
            to[static_cast<std::size_t>(x) * channels + c] +=
                weight_y * weight_x * from[static_cast<std::size_t>(from_x) * channels + c];
        });
    });
  }
  return out;
}

} // namespace

MipPyramid::MipPyramid(std::shared_ptr<const Texels> texels, ColorSpace space, const Progress* progress)
    : texels_(std::move(texels)), space_(space) {
  const auto channels = static_cast<std::size_t>(texels_->channels);
  const std::size_t length = static_cast<std::size_t>(texels_->width) * channels;
  std::vector<float> decoded(length);
  auto picture_row = [&](int y) {
    std::visit(
        [&](const auto& values) {
          using T = typename std::decay_t<decltype(values)>::value_type;
          with_decoding<T>(space_, [&](auto decode) {
            const T* from = &values[static_cast<std::size_t>(y) * length];
            for (std::size_t i = 0; i < length; ++i) {
              const bool is_alpha = channels == 4 && i % 4 == 3;
              if constexpr (std::is_integral_v<T>)
                decoded[i] = is_alpha ? linear_value(from[i]) : decode(from[i]);
              else
                decoded[i] = decode(from[i]);
            }
          });
        },
        texels_->data);
    return decoded.data();
  };
  if (texels_->width <= 1 && texels_->height <= 1) return;
  levels_.push_back(halved(texels_->width, texels_->height, channels, picture_row, progress));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& last = levels_.back();
    const std::size_t row_length = static_cast<std::size_t>(last.width) * channels;
    auto row = [&](int y) { return &last.values[static_cast<std::size_t>(y) * row_length]; };
    Level next = halved(last.width, last.height, channels, row, progress);
    levels_.push_back(std::move(next));
  }
}

std::size_t MipPyramid::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels_) bytes += level.values.size() * sizeof(float);
  return bytes;
}

} // namespace candela
