#include "imaging/texels.h"

#include "core/color.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace candela {

namespace {

/// The alpha value of opaque texels.
template <class T>
constexpr T opaque() {
  if constexpr (std::is_integral_v<T>)
    return std::numeric_limits<T>::max();
  else
    return T(1);
}

template <class T>
std::vector<T> first_channels(const std::vector<T>& data, std::size_t from, std::size_t to) {
  std::vector<T> out;
  out.reserve(data.size() / from * to);
  for (std::size_t i = 0; i < data.size(); i += from)
    out.insert(out.end(), data.begin() + static_cast<std::ptrdiff_t>(i),
               data.begin() + static_cast<std::ptrdiff_t>(i + to));
  return out;
}

std::uint8_t byte_of(std::uint8_t value) { return value; }
std::uint8_t byte_of(std::uint16_t value) {
  return static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u);
}
std::uint8_t byte_of(float linear) {
  if (!(linear > 0)) return 0; // NaN too
  return static_cast<std::uint8_t>(srgb_from_linear(std::min(linear, 1.0f)) * 255.0f + 0.5f);
}

} // namespace

std::size_t Texels::bytes() const {
  return std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, data);
}

Texels with_fewest_channels(Texels texels) {
  std::visit(
      [&](auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        auto n = static_cast<std::size_t>(texels.channels);
        bool is_opaque = true, is_grey = n > 1;
        for (std::size_t i = 0; n > 1 && i < values.size() && (is_opaque || is_grey); i += n) {
          if (n == 4) is_opaque &= values[i + 3] == opaque<T>();
          is_grey &= values[i] == values[i + 1] && values[i] == values[i + 2];
        }
        if (!is_opaque) return; // there is no format of grey with alpha
        const std::size_t kept = is_grey ? 1 : std::min<std::size_t>(n, 3);
        if (kept == n) return;
        values = first_channels(values, n, kept);
        texels.channels = static_cast<int>(kept);
      },
      texels.data);
  return texels;
}

const char* texels_problem(const Texels& texels) {
  if (texels.width <= 0 || texels.height <= 0) return "it has no pixels";
  if (texels.channels != 1 && texels.channels != 3 && texels.channels != 4)
    return "it has neither 1, 3 nor 4 channels";
  const std::size_t count = std::visit([](const auto& values) { return values.size(); }, texels.data);
  if (count != texels.texel_count() * static_cast<std::size_t>(texels.channels))
    return "its pixels do not fit its size";
  const auto* floats = std::get_if<std::vector<float>>(&texels.data);
  if (floats != nullptr && !std::ranges::all_of(*floats, [](float x) { return std::isfinite(x); }))
    return "a pixel is not finite";
  return "";
}

std::vector<std::uint8_t> srgb8_texels(const Texels& texels) {
  std::vector<std::uint8_t> out;
  out.reserve(3 * texels.texel_count());
  const auto n = static_cast<std::size_t>(texels.channels);
  std::visit(
      [&](const auto& values) {
        for (std::size_t i = 0; i < values.size(); i += n)
          for (std::size_t c = 0; c < 3; ++c) out.push_back(byte_of(values[n == 1 ? i : i + c]));
      },
      texels.data);
  return out;
}

} // namespace candela
