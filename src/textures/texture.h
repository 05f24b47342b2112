#pragma once
// Textures of every kind. A new kind is a file of this folder and an entry of the list below.

#include "textures/checker_texture.h"
#include "textures/gradient_texture.h"
#include "textures/grid_texture.h"
#include "textures/image_texture.h"
#include "textures/noise_texture.h"
#include "textures/worley_texture.h"

#include <optional>
#include <string>
#include <tuple>
#include <variant>

namespace candela {

using TextureModel =
    std::variant<ImageTexture, CheckerTexture, GridTexture, GradientTexture, NoiseTexture, WorleyTexture>;

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

/// Linear Rec. 709 at uv, transformed as the use has it.
inline vec3 texture_color(const Texture& texture, const TextureUse& use, vec2 uv) {
  const vec2 at = use.uv.apply(uv);
  return std::visit([&](const auto& kind) { return kind.color(use, at); }, texture.model);
}
inline float texture_number(const Texture& texture, const TextureUse& use, vec2 uv) {
  const vec2 at = use.uv.apply(uv);
  return std::visit([&](const auto& kind) { return kind.number(use, at); }, texture.model);
}

/// The mean over the footprint, as TextureFilter::trilinear has it: red, green, blue, alpha. Pictures need
/// their pyramid. Nothing of what has none, and of kinds that cannot: look up the point.
inline std::optional<vec4> texture_filtered(const Texture& texture, const TextureUse& use,
                                            const TexturePoint& at, const MipPyramid* pyramid) {
  const TexturePoint moved(use.uv.apply(at.uv), {use.uv.apply_to_step(at.footprint.major),
                                                 use.uv.apply_to_step(at.footprint.minor)});
  return std::visit(
      [&](const auto& kind) -> std::optional<vec4> {
        if constexpr (requires { kind.filtered(use, moved); }) return kind.filtered(use, moved);
        if constexpr (requires { kind.filtered(use, moved, *pyramid); })
          if (pyramid != nullptr) return kind.filtered(use, moved, *pyramid);
        return std::nullopt;
      },
      texture.model);
}

} // namespace candela
