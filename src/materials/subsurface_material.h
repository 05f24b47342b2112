#pragma once

#include "bsdf/subsurface.h"
#include "materials/facet_rows.h"
#include "media/albedo_inversion.h"
#include "media/homogeneous_medium.h"

namespace candela {

namespace detail {
inline constexpr std::array<std::string_view, 3> kSubsurfaceMethodNames{"random_walk", "burley", "dipole"};
} // namespace detail

/// Skin, wax, marble, milk: a body that scatters light inside, of a given colour.
struct SubsurfaceMaterial {
  ColorParameter color = vec3(0.8f, 0.6f, 0.5f);    ///< share that leaves of the light that enters
  ColorParameter radius = vec3(0.1f, 0.05f, 0.03f); ///< mean free path, scene units
  NumberParameter scale = 1.0f;                     ///< multiplies the radius
  NumberParameter ior = 1.4f;                       ///< inside over outside
  NumberParameter roughness = 0.5f;                 ///< alpha = roughness^2; 0: smooth
  int method = static_cast<int>(SubsurfaceMethod::random_walk);
  bool operator==(const SubsurfaceMaterial&) const = default;

  static constexpr std::string_view kName = "subsurface";
  static constexpr auto rows() {
    using Row = ModelRow<SubsurfaceMaterial>;
    return std::array{
        Row{reflectance_row("color",
                            "Share that leaves a flat body of the diffuse light that enters it; where "
                            "values are textured, a random walk takes their factors"),
            &SubsurfaceMaterial::color},
        Row{{"radius",
             FieldType::color,
             0,
             1e6,
             "scene units",
             "Mean free path of each channel inside: how far light goes before it is scattered",
             Invalidates::image,
             {},
             true},
            &SubsurfaceMaterial::radius},
        Row{{"scale", FieldType::real, 0, 1e6, "", "Multiplies the radius", Invalidates::image, {}, true},
            &SubsurfaceMaterial::scale},
        Row{{"ior", FieldType::real, 1, 3, "",
             "Index of refraction, inside over outside; 1: a surface without highlights, at which a random "
             "walk enters and leaves in Lambertian directions"},
            &SubsurfaceMaterial::ior,
            false},
        Row{roughness_row(), &SubsurfaceMaterial::roughness},
        Row{{"method", FieldType::choice, 0, 0, "",
             "How light gets from where it enters to where it leaves: by a random walk through the body "
             "(with a high path.max_depth), or to a point near by, by Christensen and Burley's profile or by "
             "Jensen's dipole",
             Invalidates::image, detail::kSubsurfaceMethodNames},
            &SubsurfaceMaterial::method},
    };
  }

  /// Of the body, scene units, where the surface has these values.
  static Spectrum mean_free_path(Spectrum radius, float scale) {
    constexpr float kShortest = 1e-6f; // the extinction coefficients of other media are no greater
    return glm::max(radius * scale, Spectrum(kShortest));
  }

  Subsurface closure(const auto& at) const {
    constexpr auto kDistribution = MicrofacetDistribution::ggx;
    const float rough = at(roughness), index = std::clamp(float(at(ior)), 1.0f, CoatAlbedo::kMaxEta);
    const bool smooth = rough == 0 || RoughDielectric::is_invisible(index);
    Subsurface out;
    out.plastic = {at(color),
                   Spectrum(1),
                   index,
                   false,
                   Microfacets::of_roughness(rough, 0, kDistribution),
                   smooth ? nullptr : &CoatAlbedo::of(kDistribution)};
    out.mean_free_path = mean_free_path(at(radius), at(scale));
    out.compensation = smooth ? nullptr : &InterfaceAlbedo::of(kDistribution);
    out.method = static_cast<SubsurfaceMethod>(method);
    return out;
  }

  /// The medium of the random walk, whose half space has the colour: exactly if the interface matches, else
  /// as far as the light below it is diffuse.
  std::optional<HomogeneousMedium> matter() const {
    if (method != static_cast<int>(SubsurfaceMethod::random_walk)) return std::nullopt;
    const float index =
        RoughDielectric::is_invisible(ior.value) ? 1 : std::clamp(ior.value, 1.0f, CoatAlbedo::kMaxEta);
    HomogeneousMedium medium;
    const Spectrum sigma_t = Spectrum(1) / mean_free_path(radius.value, scale.value);
    for (int c = 0; c < 3; ++c) {
      const float albedo = single_scattering_albedo(albedo_below_interface(color.value[c], index));
      medium.sigma_s[c] = albedo * sigma_t[c];
      medium.sigma_a[c] = (1 - albedo) * sigma_t[c];
    }
    return medium;
  }
};

} // namespace candela
