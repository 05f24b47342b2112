#pragma once
// What the integers of a picture mean.

#include "core/color.h"
#include "textures/texture_use.h"

#include <limits>
#include <type_traits>
#include <vector>

namespace candela {

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

/// Calls use(decode), where decode(T) is the linear value of what is stored.
template <class T, class Use>
auto with_decoding(ColorSpace space, Use use) {
  if constexpr (std::is_floating_point_v<T>) {
    return use([](float value) { return value; });
  } else {
    if (space == ColorSpace::linear) return use([](T value) { return linear_value(value); });
    const float* table = linear_from_srgb_table<T>().data();
    return use([table](T value) { return table[value]; });
  }
}

} // namespace candela
