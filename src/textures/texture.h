#pragma once
// Textures of every kind. A new kind is a file of this folder and an entry of the list below.

#include "textures/checker_texture.h"
#include "textures/gradient_texture.h"
#include "textures/grid_texture.h"
#include "textures/image_texture.h"
#include "textures/mesh_attribute_texture.h"
#include "textures/noise_texture.h"
#include "textures/triplanar.h"
#include "textures/worley_texture.h"

#include <optional>
#include <string>
#include <tuple>
#include <variant>

namespace candela {

using TextureModel = std::variant<ImageTexture, CheckerTexture, GridTexture, GradientTexture, NoiseTexture,
                                  WorleyTexture, MeshAttributeTexture>;

struct Texture {
  std::string name;
  TextureModel model;
  bool operator==(const Texture&) const = default;

  /// The picture, of one that is a picture.
  const ImageTexture* image() const { return std::get_if<ImageTexture>(&model); }
};

/// What files call the kinds, by the index of the variant.
std::span<const std::string_view> texture_kind_names();
/// The default one of a kind; nothing for other names.
std::optional<TextureModel> texture_of_kind(std::string_view name);
/// Calls visit(kind, rows of its values) with what the texture is.
template <class Visit>
void visit_texture(const Texture& texture, Visit visit) {
  std::visit([&](const auto& kind) { visit(kind, std::decay_t<decltype(kind)>::rows()); }, texture.model);
}

/// What is wrong with the values; empty where all is well.
std::string texture_problem(const Texture& texture);

/// Whether the use of the texture needs TexturePoint::place.
inline bool asks_place(const Texture& texture, const TextureUse& use) {
  return use.mapping == TextureMapping::triplanar ||
         std::holds_alternative<MeshAttributeTexture>(texture.model);
}

namespace detail {

/// The sum of look(projection) by the projections' weights.
template <class T, class Look>
T blend_projections(const TexturePoint& at, const TextureUse& use, Look look) {
  T sum(0);
  for (const ProjectedPoint& p : project_triplanar(*at.place, at.footprint, use.blend))
    if (p.weight > 0) sum += p.weight * look(p.at);
  return sum;
}

/// of_place(kind, place) of kinds that look at the surface, else of_uv(kind, transformed uv).
template <class T, class OfPlace, class OfUv>
T look_up(const Texture& texture, const TextureUse& use, const TexturePoint& at, OfPlace of_place,
          OfUv of_uv) {
  return std::visit(
      [&](const auto& kind) -> T {
        if constexpr (requires { kind.texel(*at.place); })
          return of_place(kind.texel(at.place ? *at.place : SurfacePlace()));
        else if (use.mapping == TextureMapping::triplanar && at.place)
          return blend_projections<T>(at, use,
                                      [&](const TexturePoint& p) { return of_uv(kind, use.uv.apply(p.uv)); });
        else
          return of_uv(kind, use.uv.apply(at.uv));
      },
      texture.model);
}

} // namespace detail

/// Linear Rec. 709 at a point, transformed as the use has it.
inline vec3 texture_color(const Texture& texture, const TextureUse& use, const TexturePoint& at) {
  return detail::look_up<vec3>(
      texture, use, at, [&](vec4 texel) { return texel_color(texel, use.channel); },
      [&](const auto& kind, vec2 uv) { return kind.color(use, uv); });
}
inline float texture_number(const Texture& texture, const TextureUse& use, const TexturePoint& at) {
  return detail::look_up<float>(
      texture, use, at, [&](vec4 texel) { return texel_number(texel, use.channel); },
      [&](const auto& kind, vec2 uv) { return kind.number(use, uv); });
}

/// The mean over the footprint, as TextureFilter::trilinear has it: red, green, blue, alpha. Pictures need
/// their pyramid. Nothing of what has none, and of kinds that cannot: look up the point.
inline std::optional<vec4> texture_filtered(const Texture& texture, const TextureUse& use,
                                            const TexturePoint& at, const MipPyramid* pyramid) {
  auto transformed = [&](const TexturePoint& p) {
    return TexturePoint(use.uv.apply(p.uv),
                        {use.uv.apply_to_step(p.footprint.major), use.uv.apply_to_step(p.footprint.minor)});
  };
  return std::visit(
      [&](const auto& kind) -> std::optional<vec4> {
        auto mean = [&](auto look) -> vec4 {
          if (use.mapping != TextureMapping::triplanar || !at.place) return look(transformed(at));
          return detail::blend_projections<vec4>(at, use,
                                                 [&](const TexturePoint& p) { return look(transformed(p)); });
        };
        if constexpr (requires { kind.filtered(use, at); })
          return mean([&](const TexturePoint& p) { return kind.filtered(use, p); });
        if constexpr (requires { kind.filtered(use, at, *pyramid); })
          if (pyramid != nullptr)
            return mean([&](const TexturePoint& p) { return kind.filtered(use, p, *pyramid); });
        return std::nullopt;
      },
      texture.model);
}

} // namespace candela
