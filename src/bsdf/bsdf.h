#pragma once
// The scattering model at a hit, textures already evaluated, as one value.

#include "bsdf/dielectric.h"
#include "bsdf/diffuse.h"
#include "bsdf/ggx.h"
#include "bsdf/mirror.h"
#include "bsdf/phong.h"

#include <variant>

namespace candela {

static_assert(BsdfModel<Diffuse> && BsdfModel<Phong> && BsdfModel<Ggx> && BsdfModel<Mirror> &&
              BsdfModel<Dielectric>);

/// libstdc++ visits up to eleven alternatives by a switch, which the compiler inlines.
using Bsdf = std::variant<Diffuse, Phong, Ggx, Mirror, Dielectric>;

// As BsdfModel's members of the same names.

inline vec3 bsdf_eval(const Bsdf& bsdf, vec3 wo, vec3 wi) {
  return std::visit([&](const auto& model) { return model.eval(wo, wi); }, bsdf);
}
inline float bsdf_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi) {
  return std::visit([&](const auto& model) { return model.pdf(wo, wi); }, bsdf);
}
inline BsdfEval bsdf_eval_pdf(const Bsdf& bsdf, vec3 wo, vec3 wi) {
  return std::visit([&](const auto& model) { return model.eval_pdf(wo, wi); }, bsdf);
}
inline std::optional<BsdfSample> bsdf_sample(const Bsdf& bsdf, vec3 wo, BsdfU u) {
  return std::visit([&](const auto& model) { return model.sample(wo, u); }, bsdf);
}
inline float bsdf_delta_probability(const Bsdf& bsdf, vec3 wo) {
  return std::visit([&](const auto& model) { return model.delta_probability(wo); }, bsdf);
}
inline vec3 bsdf_albedo(const Bsdf& bsdf) {
  return std::visit([](const auto& model) { return model.albedo(); }, bsdf);
}

} // namespace candela
