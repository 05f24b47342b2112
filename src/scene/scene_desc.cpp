#include "scene/scene_desc.h"

#include <array>

namespace candela {

namespace {

constexpr std::string_view kMaterialTypes[] = {"diffuse", "phong", "ggx", "mirror", "dielectric"};
constexpr std::string_view kLightTypes[] = {"point", "directional", "constant"};
constexpr auto kInf = std::numeric_limits<double>::infinity();

using M = Material;
using L = LightDesc;
template <class T, auto Member>
void* member(T& owner) {
  return &(owner.*Member);
}

const Field<Material> kMaterialFields[] = {
    {{"type", FieldType::choice, 0, 0, "", "How the surface scatters light", Invalidates::scene,
      kMaterialTypes},
     member<M, &M::type>},
    {{"diffuse", FieldType::color, 0, 1, "", "Lambertian reflectance"}, member<M, &M::diffuse>},
    {{"specular", FieldType::color, 0, 1, "", "Specular reflectance; at normal incidence for ggx"},
     member<M, &M::specular>},
    {{"exponent",
      FieldType::real,
      0,
      1e6,
      "",
      "Exponent of the Phong lobe: higher is sharper",
      Invalidates::image,
      {},
      true},
     member<M, &M::exponent>},
    {{"roughness", FieldType::real, 0, 1, "", "Roughness of ggx; the microfacet alpha is its square"},
     member<M, &M::roughness>},
    {{"ior", FieldType::real, 0.1, 10, "", "Index of refraction, inside over outside"}, member<M, &M::ior>},
    {{"transmittance", FieldType::color, 0, 1, "", "Tint of each crossing of the surface"},
     member<M, &M::transmittance>},
    {{"absorption",
      FieldType::color,
      0,
      1e6,
      "1/scene unit",
      "Absorption coefficient inside (Beer-Lambert): transmittance over d is exp(-absorption d)",
      Invalidates::image,
      {},
      true},
     member<M, &M::absorption>},
    {{"opacity", FieldType::real, 0, 1, "",
      "Share of light that meets the surface; the rest passes straight on", Invalidates::scene},
     member<M, &M::opacity>},
    {{"emission",
      FieldType::color,
      0,
      1e9,
      "W/(m^2 sr)",
      "Radiance that the surface sends out",
      Invalidates::scene,
      {},
      true},
     member<M, &M::emission>},
    {{"two_sided_emission", FieldType::boolean, 0, 0, "", "Emit from both sides, not only the normal's",
      Invalidates::scene},
     member<M, &M::two_sided_emission>},
};

const Field<LightDesc> kLightFields[] = {
    {{"type", FieldType::choice, 0, 0, "", "point, directional (a distant one) or constant (all around)",
      Invalidates::scene, kLightTypes},
     member<L, &L::type>},
    {{"position", FieldType::point, -kInf, kInf, "", "Where the point light is", Invalidates::scene},
     member<L, &L::position>},
    {{"direction", FieldType::point, -kInf, kInf, "", "The direction in which the light travels",
      Invalidates::scene},
     member<L, &L::direction>},
    {{"color",
      FieldType::color,
      0,
      1e9,
      "",
      "point: W/sr; directional: W/m^2 on a surface that faces it; constant: W/(m^2 sr)",
      Invalidates::scene,
      {},
      true},
     member<L, &L::color>},
    {{"scale", FieldType::real, 0, 1e9, "", "Multiplies the colour", Invalidates::scene, {}, true},
     member<L, &L::scale>},
};

} // namespace

std::span<const Field<Material>> material_fields() { return kMaterialFields; }
std::span<const Field<LightDesc>> light_fields() { return kLightFields; }

bool material_uses(MaterialType type, std::string_view key) {
  using enum MaterialType;
  if (key == "diffuse") return type == diffuse || type == phong || type == mirror;
  if (key == "specular") return type == phong || type == ggx || type == mirror;
  if (key == "exponent") return type == phong;
  if (key == "roughness") return type == ggx;
  if (key == "ior" || key == "transmittance" || key == "absorption") return type == dielectric;
  return true;
}

bool light_uses(LightType type, std::string_view key) {
  if (key == "position") return type == LightType::point;
  if (key == "direction") return type == LightType::directional;
  return true;
}

} // namespace candela
