#pragma once

#include "bsdf/conductor.h"
#include "bsdf/turned.h"
#include "materials/facet_rows.h"
#include "materials/metals.h"

namespace candela {

namespace detail {

/// What stands for the values eta and k, then the metals.
constexpr auto metal_names() {
  std::array<std::string_view, kMetals.size() + 1> names{"custom"};
  for (std::size_t i = 0; i < kMetals.size(); ++i) names[i + 1] = kMetals[i].name;
  return names;
}
inline constexpr auto kMetalNames = metal_names();
constexpr int metal_index(std::string_view name) {
  return static_cast<int>(std::ranges::find(kMetalNames, name) - kMetalNames.begin());
}

} // namespace detail

/// Metal by its complex index of refraction, smooth or rough.
struct ConductorMaterial {
  int metal = detail::metal_index("Cu");
  ColorParameter eta = kMetals[4].eta, k = kMetals[4].k;
  ColorParameter specular = vec3(1);
  NumberParameter roughness = 0.3f, anisotropy = 0.0f;
  int distribution = static_cast<int>(MicrofacetDistribution::ggx);
  bool energy_compensation = true;
  bool operator==(const ConductorMaterial&) const = default;

  static constexpr std::string_view kName = "conductor";
  static constexpr auto rows() {
    using Row = ModelRow<ConductorMaterial>;
    constexpr auto index_row = [](std::string_view key, std::string_view help) {
      return FieldInfo{key, FieldType::color, 0, 50, "", help, Invalidates::image, {}, true};
    };
    return std::array{
        Row{{"metal", FieldType::choice, 0, 0, "", "Measured metal, by its symbol; custom: eta and k",
             Invalidates::image, detail::kMetalNames},
            &ConductorMaterial::metal},
        Row{index_row("eta", "Index of refraction, real part, of a custom metal"), &ConductorMaterial::eta},
        Row{index_row("k", "Index of refraction, imaginary part (absorption), of a custom metal"),
            &ConductorMaterial::k},
        Row{reflectance_row("specular", "Factor of the reflectance; 1 for a real metal"),
            &ConductorMaterial::specular, false},
        Row{roughness_row(), &ConductorMaterial::roughness},
        Row{anisotropy_row(), &ConductorMaterial::anisotropy},
        Row{distribution_row(), &ConductorMaterial::distribution},
        Row{compensation_row(), &ConductorMaterial::energy_compensation},
    };
  }
  Turned<Conductor> closure(const auto& at) const {
    const bool custom = metal == 0;
    const auto& measured = kMetals[custom ? 0 : static_cast<std::size_t>(metal) - 1];
    const auto type = static_cast<MicrofacetDistribution>(distribution);
    const float rough = at(roughness);
    const Microfacets facets = Microfacets::of_roughness(rough, at(anisotropy), type);
    return {{custom ? Spectrum(at(eta)) : measured.eta, custom ? Spectrum(at(k)) : measured.k, at(specular),
             facets, rough == 0,
             energy_compensation ? &FacetAlbedo::of(type, facets.alpha_x != facets.alpha_y) : nullptr},
            {1, 0}};
  }
};

} // namespace candela
