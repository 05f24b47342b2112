#pragma once
// The scattering model at a hit, textures already evaluated, as one value.

#include "core/variant.h"
#include "materials/material_list.h"
#include "media/volume_scattering.h"

namespace candela {

namespace detail {

/// Any parameter's value, for types alone.
struct AnyValue {
  float operator()(const NumberParameter&) const;
  Spectrum operator()(const ColorParameter&) const;
};
template <class Model>
using ClosureOf = decltype(std::declval<const Model&>().closure(AnyValue()));

/// The variant of the closures, each once, in the order of the models.
template <class Closures, class... Models>
struct ClosuresOf {
  using Type = Closures;
};
template <class... Closures, class Model, class... Rest>
struct ClosuresOf<std::variant<Closures...>, Model, Rest...> {
  static constexpr bool kKnown = (std::is_same_v<ClosureOf<Model>, Closures> || ...);
  using Extended =
      std::conditional_t<kKnown, std::variant<Closures...>, std::variant<Closures..., ClosureOf<Model>>>;
  using Type = typename ClosuresOf<Extended, Rest...>::Type;
};
template <class First, class... Rest>
typename ClosuresOf<std::variant<ClosureOf<First>>, Rest...>::Type
closures_of(const std::variant<First, Rest...>&);

template <class... Closures, class More>
std::variant<Closures..., More> with_closure_type(const std::variant<Closures...>&, const More&);

} // namespace detail

/// The closures of all materials, and that of points in media.
using Bsdf = decltype(detail::with_closure_type(detail::closures_of(std::declval<const MaterialModel&>()),
                                                std::declval<const VolumeScattering&>()));

namespace detail {

template <class... Models>
constexpr bool are_bsdf_models(const std::variant<Models...>*) {
  return (BsdfModel<Models> && ...);
}
static_assert(are_bsdf_models(static_cast<const Bsdf*>(nullptr)));

template <class Closure>
[[gnu::always_inline]] inline std::optional<BsdfSample> closure_sample(const Closure& closure, vec3 wo,
                                                                       BsdfU u, TransportMode mode) {
  if constexpr (requires { closure.sample(wo, u, mode); })
    return closure.sample(wo, u, mode);
  else
    return closure.sample(wo, u);
}

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
  return visit_variant([&](const auto& model) { return detail::closure_sample(model, wo, u, mode); }, bsdf);
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

/// Makes a closure whose inside has an index of refraction over vacuum that of its surface where this one is
/// outside: by its member with_outside_ior, where it has that.
inline void set_outside_ior(Bsdf& bsdf, float outside) {
  visit_variant(
      [&](auto& model) {
        if constexpr (requires { model.with_outside_ior(outside); })
          model = model.with_outside_ior(outside);
        else if constexpr (requires { model.set_outside_ior(outside); })
          model.set_outside_ior(outside);
      },
      bsdf);
}

/// Whether the closure tells directions in the surface apart: set_tangent() does something then.
inline bool is_anisotropic(const Bsdf& bsdf) {
  return visit_variant(
      [](const auto& model) {
        if constexpr (requires { model.is_anisotropic(); })
          return model.is_anisotropic();
        else
          return false;
      },
      bsdf);
}
/// Whether closures of the type may be anisotropic.
inline bool has_tangent(const Bsdf& bsdf) {
  return visit_variant(
      []<class Closure>(const Closure&) {
        return requires(Closure & c) { c.axis; }
        || requires(Closure & c) { c.set_tangent(vec2(1, 0)); };
      },
      bsdf);
}
/// By its member `axis`, where it has that: the direction of the surface's tangent, local, of any length.
inline void set_tangent(Bsdf& bsdf, vec2 tangent) {
  const float length = glm::length(tangent);
  if (!(length > 0)) return;
  visit_variant(
      [&](auto& model) {
        if constexpr (requires { model.axis; })
          model.axis = tangent / length;
        else if constexpr (requires { model.set_tangent(tangent); })
          model.set_tangent(tangent);
      },
      bsdf);
}
/// Where on a fibre the surface was met (Hair::h): by the member `closure.h`, or that of its parts.
inline void set_fibre_offset(Bsdf& bsdf, float h) {
  visit_variant(
      [&](auto& model) {
        if constexpr (requires { model.closure.h; })
          model.closure.h = h;
        else if constexpr (requires { model.set_fibre_offset(h); })
          model.set_fibre_offset(h);
      },
      bsdf);
}

} // namespace candela
