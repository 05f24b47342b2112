#pragma once
// The scattering model at a hit, textures already evaluated, as one value.

#include "bsdf/dielectric.h"
#include "bsdf/diffuse.h"
#include "bsdf/ggx.h"
#include "bsdf/mirror.h"
#include "bsdf/phong.h"
#include "core/variant.h"

namespace candela {

/// All models: a new one is a file of its own, and a name here.
using Bsdf = std::variant<Diffuse, Phong, Ggx, Mirror, Dielectric>;

namespace detail {

template <class... Models>
constexpr bool are_bsdf_models(const std::variant<Models...>*) {
  return (BsdfModel<Models> && ...);
}
static_assert(are_bsdf_models(static_cast<const Bsdf*>(nullptr)));

} // namespace detail

// As BsdfModel's members of the same names. Of symmetric models the mode makes no difference.

inline Spectrum bsdf_eval(const Bsdf& bsdf, vec3 wo, vec3 wi, TransportMode mode = TransportMode::radiance) {
  return visit_variant(
      [&](const auto& model) {
        if constexpr (requires { model.eval(wo, wi, mode); })
          return model.eval(wo, wi, mode);
        else
          return model.eval(wo, wi);
      },
      bsdf);
}
inline float bsdf_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi) {
  return visit_variant([&](const auto& model) { return model.pdf(wo, wi); }, bsdf);
}
inline BsdfEval bsdf_eval_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi,
                              TransportMode mode = TransportMode::radiance) {
  return visit_variant(
      [&](const auto& model) {
        if constexpr (requires { model.eval_pdf(wo, wi, mode); })
          return model.eval_pdf(wo, wi, mode);
        else
          return model.eval_pdf(wo, wi);
      },
      bsdf);
}
/// Inlined, for a result that is copied from where a call has just written it stalls the processor.
[[gnu::always_inline]] inline std::optional<BsdfSample>
bsdf_sample(const Bsdf& bsdf, vec3 wo, BsdfU u, TransportMode mode = TransportMode::radiance) {
  return visit_variant(
      [&](const auto& model) {
        if constexpr (requires { model.sample(wo, u, mode); })
          return model.sample(wo, u, mode);
        else
          return model.sample(wo, u);
      },
      bsdf);
}
inline float bsdf_delta_probability(const Bsdf& bsdf, vec3 wo) {
  return visit_variant([&](const auto& model) { return model.delta_probability(wo); }, bsdf);
}
inline BsdfFlags bsdf_flags(const Bsdf& bsdf) {
  return visit_variant([](const auto& model) { return model.flags(); }, bsdf);
}
inline LobeProxy bsdf_lobe_proxy(const Bsdf& bsdf, vec3 wo) {
  return visit_variant([&](const auto& model) { return model.lobe_proxy(wo); }, bsdf);
}
inline Spectrum bsdf_albedo(const Bsdf& bsdf) {
  return visit_variant([](const auto& model) { return model.albedo(); }, bsdf);
}

} // namespace candela
