#pragma once
// What every kind of texture offers.
//
//   kName            what files call it
//   rows()           rows of its values (core/fields.h)
//   color(use, uv)   linear Rec. 709, without the factor and offset of who uses it; uv comes transformed
//   number(use, uv)  the same for a parameter that is one number
//   filtered(use, at), filtered(use, at, pyramid)  the mean over a footprint: red, green, blue, alpha; of a
//                    kind with texels, from its pyramid. Kinds without it are looked up at points.
//   texel(place)     instead of looking at coordinates: red, green, blue, alpha of a surface's own values
//   cells()          how many texels, or the like, lie along one unit of u and of v
//   memory_bytes()   of its data

#include "textures/texture_point.h"
#include "textures/texture_use.h"

#include <concepts>
#include <string_view>

namespace candela {

template <class T>
concept TextureKind = std::equality_comparable<T> && requires(const T& t, const TextureUse& use, vec2 uv) {
  { T::kName } -> std::convertible_to<std::string_view>;
  { T::rows() } -> std::convertible_to<std::span<const Field<T>>>;
  { t.color(use, uv) } -> std::same_as<vec3>;
  { t.number(use, uv) } -> std::same_as<float>;
  { t.cells() } -> std::same_as<vec2>;
  { t.memory_bytes() } -> std::same_as<std::size_t>;
};

} // namespace candela
