#pragma once

#include "bsdf/principled.h"
#include "bsdf/turned.h"
#include "materials/facet_rows.h"

namespace candela {

/// Disney's artists' model, with the values of Mitsuba's "principled" and "principledthin".
struct PrincipledMaterial {
  ColorParameter base_color = vec3(0.5f);
  NumberParameter roughness = 0.5f, anisotropic = 0.0f;
  NumberParameter metallic = 0.0f, spec_trans = 0.0f;
  NumberParameter eta = 0.0f; ///< 0: by `specular`
  NumberParameter specular = 0.5f, spec_tint = 0.0f;
  NumberParameter sheen = 0.0f, sheen_tint = 0.0f;
  NumberParameter flatness = 0.0f;
  NumberParameter clearcoat = 0.0f, clearcoat_gloss = 0.0f;
  bool thin = false;
  NumberParameter diff_trans = 0.0f;
  bool operator==(const PrincipledMaterial&) const = default;

  static constexpr std::string_view kName = "principled";
  static constexpr auto rows() {
    using Row = ModelRow<PrincipledMaterial>;
    constexpr auto share = [](std::string_view key, std::string_view help) {
      return FieldInfo{key, FieldType::real, 0, 1, "", help};
    };
    return std::array{
        Row{reflectance_row("base_color", "Colour of diffuse reflection, of metal and of coloured glass"),
            &PrincipledMaterial::base_color},
        Row{share("roughness", "Roughness; the microfacet alpha is its square"),
            &PrincipledMaterial::roughness},
        Row{{"anisotropic", FieldType::real, -1, 1, "",
             "Stretches highlights along dp/du, as brushing along dp/dv does; negative: the other way round"},
            &PrincipledMaterial::anisotropic},
        Row{share("metallic", "From plastic or glass to metal"), &PrincipledMaterial::metallic},
        Row{share("spec_trans", "From matte to glass"), &PrincipledMaterial::spec_trans},
        Row{{"eta", FieldType::real, 0, 3, "",
             "Index of refraction, inside over outside, from 1 up; 0: by specular"},
            &PrincipledMaterial::eta,
            false},
        Row{share("specular", "Reflection at normal incidence, where eta is 0: 0.5 is an index of 1.5"),
            &PrincipledMaterial::specular, false},
        Row{share("spec_tint", "How far highlights of non-metals take the hue of base_color"),
            &PrincipledMaterial::spec_tint},
        Row{share("sheen", "Light in grazing directions, as cloth has"), &PrincipledMaterial::sheen, false},
        Row{share("sheen_tint", "How far the sheen takes the hue of base_color"),
            &PrincipledMaterial::sheen_tint},
        Row{share("flatness",
                  "From diffuse reflection to that of a body that scatters light; Burley's \"subsurface\""),
            &PrincipledMaterial::flatness},
        Row{share("clearcoat", "A second, colourless highlight"), &PrincipledMaterial::clearcoat},
        Row{share("clearcoat_gloss", "How sharp the clearcoat's highlight is"),
            &PrincipledMaterial::clearcoat_gloss},
        Row{{"thin", FieldType::boolean, 0, 0, "",
             "A sheet without inside: light passes unbent; metallic and clearcoat have no effect"},
            &PrincipledMaterial::thin},
        Row{{"diff_trans", FieldType::real, 0, 2, "",
             "Of a thin sheet: from diffuse reflection, 0, to diffuse transmission, 2"},
            &PrincipledMaterial::diff_trans},
    };
  }
  Turned<Principled> closure(const auto& at) const {
    // What refracts must bend a little, or the half vector is lost.
    constexpr float kMinRefractingIndex = 1.02f;
    const float glass = at(spec_trans), given = at(eta);
    const float index = given > 0 ? std::max(given, 1.0f) : 2 / (1 - std::sqrt(0.08f * at(specular))) - 1;
    return {{{.base_color = at(base_color),
              .roughness = at(roughness),
              .anisotropic = at(anisotropic),
              .metallic = at(metallic),
              .spec_trans = glass,
              .eta = glass > 0 && !thin ? std::max(index, kMinRefractingIndex) : index,
              .spec_tint = at(spec_tint),
              .sheen = at(sheen),
              .sheen_tint = at(sheen_tint),
              .flatness = at(flatness),
              .clearcoat = at(clearcoat),
              .clearcoat_gloss = at(clearcoat_gloss),
              .thin = thin,
              .diff_trans = at(diff_trans)}},
            {1, 0}};
  }
};

} // namespace candela
