#pragma once

#include "bsdf/open_pbr.h"
#include "bsdf/turned.h"
#include "materials/facet_rows.h"

namespace candela {

/// OpenPBR Surface 1.1, by the specification's names.
struct OpenPbrMaterial {
  NumberParameter base_weight = 1.0f;
  ColorParameter base_color = vec3(0.8f);
  NumberParameter base_diffuse_roughness = 0.0f, base_metalness = 0.0f;
  NumberParameter specular_weight = 1.0f;
  ColorParameter specular_color = vec3(1);
  NumberParameter specular_roughness = 0.3f, specular_roughness_anisotropy = 0.0f, specular_ior = 1.5f;
  NumberParameter transmission_weight = 0.0f;
  ColorParameter transmission_color = vec3(1);
  NumberParameter coat_weight = 0.0f;
  ColorParameter coat_color = vec3(1);
  NumberParameter coat_roughness = 0.0f, coat_roughness_anisotropy = 0.0f, coat_ior = 1.6f,
                  coat_darkening = 1.0f;
  NumberParameter fuzz_weight = 0.0f;
  ColorParameter fuzz_color = vec3(1);
  NumberParameter fuzz_roughness = 0.5f;
  NumberParameter thin_film_weight = 0.0f, thin_film_thickness = 0.5f, thin_film_ior = 1.4f;
  bool operator==(const OpenPbrMaterial&) const = default;

  static constexpr std::string_view kName = "open_pbr";
  static constexpr auto rows() {
    using M = OpenPbrMaterial;
    using Row = ModelRow<M>;
    constexpr auto share = [](std::string_view key, std::string_view help) {
      return FieldInfo{key, FieldType::real, 0, 1, "", help};
    };
    constexpr auto index = [](std::string_view key, std::string_view help) {
      return FieldInfo{key, FieldType::real, 1, 3, "", help};
    };
    return std::array{
        Row{share("base_weight", "Factor of base_color"), &M::base_weight},
        Row{reflectance_row("base_color", "Colour of diffuse reflection and of metal"), &M::base_color},
        Row{share("base_diffuse_roughness", "Roughness of diffuse reflection: flatter, as of clay"),
            &M::base_diffuse_roughness},
        Row{share("base_metalness", "From plastic or glass to metal"), &M::base_metalness},
        Row{{"specular_weight", FieldType::real, 0, 10, "",
             "Factor of the base's specular reflection at normal incidence"},
            &M::specular_weight},
        Row{reflectance_row("specular_color",
                            "Tint of the base's highlights; of metal, that of grazing directions alone"),
            &M::specular_color},
        Row{share("specular_roughness", "Roughness of the base; the microfacet alpha is its square"),
            &M::specular_roughness},
        Row{share("specular_roughness_anisotropy", "Stretches the base's highlights along dp/du"),
            &M::specular_roughness_anisotropy},
        Row{index("specular_ior", "Index of refraction of the base"), &M::specular_ior},
        Row{share("transmission_weight", "From matte to glass"), &M::transmission_weight},
        Row{reflectance_row("transmission_color", "Tint of what passes the surface of glass"),
            &M::transmission_color},
        Row{share("coat_weight", "How much of the base is lacquered"), &M::coat_weight},
        Row{reflectance_row("coat_color", "Tint of the base by the lacquer, seen along the normal"),
            &M::coat_color},
        Row{share("coat_roughness", "Roughness of the lacquer"), &M::coat_roughness},
        Row{share("coat_roughness_anisotropy", "Stretches the lacquer's highlights along dp/du"),
            &M::coat_roughness_anisotropy},
        Row{index("coat_ior", "Index of refraction of the lacquer"), &M::coat_ior},
        Row{share("coat_darkening", "How far lacquer darkens the base, as it does by reflection from within"),
            &M::coat_darkening},
        Row{share("fuzz_weight", "How much of the surface is covered by dust or fibres"), &M::fuzz_weight},
        Row{reflectance_row("fuzz_color", "Colour of dust and fibres"), &M::fuzz_color},
        Row{share("fuzz_roughness", "From fibres that stand upright to dust"), &M::fuzz_roughness},
        Row{share("thin_film_weight", "How much of the base has a film of interference colours"),
            &M::thin_film_weight},
        Row{{"thin_film_thickness", FieldType::real, 0, 10, "micrometres", "Thickness of that film"},
            &M::thin_film_thickness},
        Row{index("thin_film_ior", "Index of refraction of that film"), &M::thin_film_ior},
    };
  }
  Turned<OpenPbr> closure(const auto& at) const {
    return {{{.base_color = at(base_weight) * at(base_color),
              .base_diffuse_roughness = at(base_diffuse_roughness),
              .base_metalness = at(base_metalness),
              .specular_weight = at(specular_weight),
              .specular_color = at(specular_color),
              .specular_roughness = at(specular_roughness),
              .specular_roughness_anisotropy = at(specular_roughness_anisotropy),
              .specular_ior = at(specular_ior),
              .transmission_weight = at(transmission_weight),
              .transmission_color = at(transmission_color),
              .coat_weight = at(coat_weight),
              .coat_color = at(coat_color),
              .coat_roughness = at(coat_roughness),
              .coat_roughness_anisotropy = at(coat_roughness_anisotropy),
              .coat_ior = at(coat_ior),
              .coat_darkening = at(coat_darkening),
              .fuzz_weight = at(fuzz_weight),
              .fuzz_color = at(fuzz_color),
              .fuzz_roughness = at(fuzz_roughness),
              .thin_film_weight = at(thin_film_weight),
              .thin_film_thickness = at(thin_film_thickness),
              .thin_film_ior = at(thin_film_ior)}},
            {1, 0}};
  }
};

} // namespace candela
