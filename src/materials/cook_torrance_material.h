#pragma once

#include "bsdf/cook_torrance.h"
#include "materials/material_model.h"

namespace candela {

namespace detail {
inline constexpr std::array<std::string_view, 3> kFacetNormalsNames{"ggx", "beckmann", "blinn"};
inline constexpr std::array<std::string_view, 3> kFacetMaskingNames{"smith", "schlick", "v_cavity"};
inline constexpr std::array<std::string_view, 2> kFacetFresnelNames{"exact", "schlick"};
} // namespace detail

/// Metalness and roughness over the model of Cook and Torrance, whose three terms are chosen one by one.
struct CookTorranceMaterial {
  ColorParameter base_color = vec3(0.5f);
  NumberParameter metallic = 0.0f;
  NumberParameter roughness = 0.5f;
  NumberParameter f0 = 0.04f; ///< of the part that is no metal
  int distribution = static_cast<int>(FacetNormals::ggx);
  int masking = static_cast<int>(FacetMasking::smith);
  int fresnel = static_cast<int>(FacetFresnel::exact);
  bool operator==(const CookTorranceMaterial&) const = default;

  static constexpr std::string_view kName = "cook_torrance";
  static constexpr auto rows() {
    using Row = ModelRow<CookTorranceMaterial>;
    constexpr auto choice = [](std::string_view key, std::string_view help,
                               std::span<const std::string_view> names) {
      return FieldInfo{key, FieldType::choice, 0, 0, "", help, Invalidates::image, names};
    };
    return std::array{
        Row{reflectance_row("base_color", "Colour of the matte base, and of the metal's reflection"),
            &CookTorranceMaterial::base_color},
        Row{{"metallic", FieldType::real, 0, 1, "", "Metalness: 0 is a matte base under gloss, 1 is metal"},
            &CookTorranceMaterial::metallic},
        Row{{"roughness", FieldType::real, 0, 1, "",
             "Roughness; the microfacet alpha is its square, 0 is almost a mirror"},
            &CookTorranceMaterial::roughness},
        Row{{"f0", FieldType::real, 0, 1, "",
             "Reflectance at normal incidence of what is no metal; 0.04 is glass or plastic"},
            &CookTorranceMaterial::f0},
        // Others have fewer choices of this name.
        Row{choice("distribution", "D: distribution of the microfacets' normals", detail::kFacetNormalsNames),
            &CookTorranceMaterial::distribution, false},
        Row{choice("masking",
                   "G: masking and shadowing; Smith's, Schlick's approximation of it, or Torrance and "
                   "Sparrow's V-cavities",
                   detail::kFacetMaskingNames),
            &CookTorranceMaterial::masking},
        Row{choice("fresnel", "F: the Fresnel equations, or Schlick's approximation of them",
                   detail::kFacetFresnelNames),
            &CookTorranceMaterial::fresnel},
    };
  }
  CookTorrance closure(const auto& at) const {
    const Spectrum base = at(base_color);
    const float metal = at(metallic);
    return {base * (1 - metal),
            glm::mix(Spectrum(at(f0)), base, metal),
            std::max(sqr(at(roughness)), Microfacets::kMinAlpha),
            static_cast<FacetNormals>(distribution),
            static_cast<FacetMasking>(masking),
            static_cast<FacetFresnel>(fresnel)};
  }
};

} // namespace candela
