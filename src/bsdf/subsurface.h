#pragma once

#include "bsdf/plastic.h"
#include "bsdf/rough_dielectric.h"

namespace candela {

/// How light gets from where it enters a body to where it leaves it.
enum class SubsurfaceMethod : int {
  random_walk, ///< through the medium that fills the body
  burley,      ///< by the profile of media/diffusion_profile.h of that name
  dipole,      ///< likewise
};

/// The surface of a body that scatters light inside. Of a random walk it is the interface alone: a rough
/// dielectric; where the indices of refraction match, one that lets all light pass in Lambertian directions,
/// so that light samples meet it, and that the body has its colour whatever it is lit by (as Chiang, Kutz &
/// Burley 2016 have it).
///
/// Else light leaves the body elsewhere than where it enters: of what transport knows of that there are the
/// parts `entry` and `exit`. Everybody else is given the whole, which is the limit of a mean free path of 0:
/// Plastic.
struct Subsurface {
  enum class Part : std::uint8_t {
    whole,
    entry, ///< the interface's reflection; what enters is a delta lobe straight on
    exit,  ///< T(wi) |cos| / pi over its integral, with T = 1 - the interface's reflectance
  };

  /// Its colour is the share that leaves of the light that enters; round facets. Its `rough` is null only
  /// where it is smooth, even of a random walk.
  Plastic plastic;
  Spectrum mean_free_path{1}; ///< scene units, > 0
  const InterfaceAlbedo* compensation = nullptr;
  SubsurfaceMethod method = SubsurfaceMethod::random_walk;
  Part part = Part::whole;

  Spectrum eval(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    return eval_pdf(wo, wi, mode).f_cos;
  }
  float pdf(vec3 wo, vec3 wi) const { return eval_pdf(wo, wi).pdf; }

  BsdfEval eval_pdf(vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) const {
    if (part == Part::entry) return entry_eval_pdf(wo, wi);
    if (part == Part::exit) return exit_eval_pdf(wo, wi);
    if (method != SubsurfaceMethod::random_walk) return plastic.eval_pdf(wo, wi);
    if (!matches()) return interface().eval_pdf(wo, wi, mode);
    const float cosine_pdf = wo.z * wi.z < 0 ? std::abs(wi.z) * kInvPi : 0;
    return {Spectrum(cosine_pdf), cosine_pdf};
  }

  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) const {
    if (part == Part::entry) return entry_sample(wo, u);
    if (part == Part::exit) return exit_sample(wo, u);
    if (method != SubsurfaceMethod::random_walk) return plastic.sample(wo, u);
    if (!matches()) return interface().sample(wo, u, mode);
    const vec3 wi = to_side_of(-wo, cosine_hemisphere_from_disc(u.disc));
    const float cosine_pdf = wo.z * wi.z < 0 ? std::abs(wi.z) * kInvPi : 0;
    if (!(cosine_pdf > 0)) return std::nullopt;
    return BsdfSample{wi, Spectrum(1), cosine_pdf, false};
  }

  float delta_probability(vec3 wo) const {
    if (part == Part::entry)
      return is_smooth() ? 1 : 1 - plastic.specular_probability(plastic.reflectance(std::abs(wo.z)));
    if (part == Part::exit) return 0;
    if (method != SubsurfaceMethod::random_walk) return plastic.delta_probability(wo);
    return is_smooth() && !matches() ? 1 : 0;
  }
  BsdfFlags flags() const {
    // No light sample finds what enters.
    if (part == Part::entry)
      return BsdfFlags::reflection | BsdfFlags::delta | (is_smooth() ? BsdfFlags::none : BsdfFlags::glossy);
    if (part == Part::exit) return BsdfFlags::reflection | BsdfFlags::diffuse;
    if (method != SubsurfaceMethod::random_walk) return plastic.flags();
    return matches() ? BsdfFlags::transmission | BsdfFlags::diffuse : interface().flags();
  }
  LobeProxy lobe_proxy(vec3 wo) const {
    if (part == Part::exit) return {};
    if (part == Part::entry)
      return is_smooth() ? LobeProxy()
                         : facet_lobe_proxy(plastic.facets, wo, plastic.reflectance(std::abs(wo.z)));
    if (method != SubsurfaceMethod::random_walk) return plastic.lobe_proxy(wo);
    return matches() ? LobeProxy() : interface().lobe_proxy(wo);
  }
  Spectrum albedo() const { return plastic.albedo(); }

  /// Of the light that falls on it, what enters.
  float transmittance(float cosine) const { return 1 - plastic.reflectance(cosine); }

private:
  bool is_smooth() const { return plastic.rough == nullptr; }
  /// Whether the inside refracts as the outside does.
  bool matches() const { return RoughDielectric::is_invisible(plastic.ior); }
  RoughDielectric interface() const {
    return {plastic.ior, Spectrum(1), plastic.facets, is_smooth(), compensation};
  }

  BsdfEval entry_eval_pdf(vec3 wo, vec3 wi) const {
    if (is_smooth() || !same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const float cosine = std::min(0.5f * glm::length(wo + wi), 1.0f);
    const vec3 h = glm::normalize(wo + wi);
    const float f = fresnel_dielectric(cosine, plastic.ior) * plastic.facets.d(h) *
                    plastic.facets.g2_reflection(wo, wi) / (4 * wo.z);
    return {Spectrum(f),
            plastic.specular_probability(plastic.reflectance(wo.z)) * plastic.facets.reflection_pdf(wo, h)};
  }
  std::optional<BsdfSample> entry_sample(vec3 wo, BsdfU u) const {
    if (wo.z == 0) return std::nullopt;
    const float reflected = plastic.reflectance(std::abs(wo.z)), p = plastic.specular_probability(reflected);
    if (u.lobe < 1 - p) return BsdfSample{-wo, Spectrum((1 - reflected) / (1 - p)), 1 - p, true};
    if (is_smooth()) return BsdfSample{reflect_about_normal(wo), Spectrum(reflected / p), p, true};
    const vec3 w = to_side_of({0, 0, 1}, wo), h = plastic.facets.sample_reflecting_normal(w, u.disc);
    const vec3 wi = 2 * glm::dot(w, h) * h - w;
    if (!(wi.z > 0)) return std::nullopt;
    const BsdfEval e = entry_eval_pdf(w, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{to_side_of(wo, wi), e.f_cos / e.pdf, e.pdf, false};
  }

  BsdfEval exit_eval_pdf(vec3 wo, vec3 wi) const {
    if (!same_hemisphere(wo, wi)) return {Spectrum(0), 0};
    const float cosine = std::abs(wi.z), pdf = cosine * kInvPi;
    return {Spectrum(transmittance(cosine) / plastic.mean_transmittance * pdf), pdf};
  }
  std::optional<BsdfSample> exit_sample(vec3 wo, BsdfU u) const {
    const vec3 wi = to_side_of(wo, cosine_hemisphere_from_disc(u.disc));
    const BsdfEval e = exit_eval_pdf(wo, wi);
    if (!(e.pdf > 0)) return std::nullopt;
    return BsdfSample{wi, e.f_cos / e.pdf, e.pdf, false};
  }
};

static_assert(BsdfModel<Subsurface>);

} // namespace candela
