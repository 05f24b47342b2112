#include "textures/texture_use.h"

namespace candela {

namespace {

constexpr std::string_view kChannels[] = {"rgb", "red", "green", "blue", "alpha"};
constexpr std::string_view kFilters[] = {"nearest", "bilinear", "trilinear"};
constexpr std::string_view kWraps[] = {"repeat", "clamp", "mirror"};
constexpr std::string_view kSpaces[] = {"srgb", "linear"};
constexpr std::string_view kMappings[] = {"uv", "triplanar"};
constexpr auto kImage = Invalidates::image;

const Field<TextureUse> kFields[] = {
    {{"channel", FieldType::choice, 0, 0, "", "What is taken of a texel: a number takes the luminance of rgb",
      kImage, kChannels},
     [](TextureUse& u) -> void* { return &u.channel; }},
    {{"filter", FieldType::choice, 0, 0, "",
      "Between texels: the nearest one, or all four blended, which converges to the exact picture; trilinear "
      "is the "
      "mean over what a pixel covers: smoother with few samples, slightly blurred with many",
      kImage, kFilters},
     [](TextureUse& u) -> void* { return &u.filter; }},
    {{"wrap", FieldType::choice, 0, 0, "",
      "Outside of the texture: itself again, its border, its mirror image", kImage, kWraps},
     [](TextureUse& u) -> void* { return &u.wrap; }},
    {{"color_space", FieldType::choice, 0, 0, "",
      "What the picture's integers mean: colours as on a screen, or the values themselves", kImage, kSpaces},
     [](TextureUse& u) -> void* { return &u.color_space; }},
    {{"mapping", FieldType::choice, 0, 0, "",
      "The coordinates: the surface's own, or its position projected along the three axes of the object, "
      "which "
      "needs none; scale is in copies per unit of length then",
      kImage, kMappings},
     [](TextureUse& u) -> void* { return &u.mapping; }},
    {{"blend", FieldType::real, 0, 1, "",
      "Of triplanar mapping: how wide the projections pass into each other; 0 is a seam"},
     [](TextureUse& u) -> void* { return &u.blend; }},
    {{"uv_rotation", FieldType::angle, -360, 360, "degrees",
      "Turns the texture coordinates counter-clockwise, once they are scaled"},
     [](TextureUse& u) -> void* { return &u.uv.rotation; }},
};

} // namespace

std::span<const Field<TextureUse>> texture_use_fields() { return kFields; }

} // namespace candela
