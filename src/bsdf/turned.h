#pragma once
// Closures that tell the directions of their surface apart, such as brushed metal.

#include "bsdf/bsdf_sample.h"

namespace candela {

/// A closure in whose frame +x is a tangent of the surface: whoever makes the frame about the normal chooses
/// its x freely, and says here where the tangent lies in it.
template <class Closure>
struct Turned {
  Closure closure;
  vec2 axis{1, 0}; ///< the tangent's x and y, of unit length

  /// False if all directions of the surface are alike to the closure after all.
  bool is_anisotropic() const {
    if constexpr (requires { closure.is_isotropic(); })
      return !closure.is_isotropic();
    else
      return true;
  }

  template <class... Mode>
  Spectrum eval(vec3 wo, vec3 wi, Mode... mode) const requires requires {
    closure.eval(wo, wi, mode...);
  }
  { return closure.eval(in(wo), in(wi), mode...); }
  float pdf(vec3 wo, vec3 wi) const { return closure.pdf(in(wo), in(wi)); }
  template <class... Mode>
  BsdfEval eval_pdf(vec3 wo, vec3 wi, Mode... mode) const requires requires {
    closure.eval_pdf(wo, wi, mode...);
  }
  { return closure.eval_pdf(in(wo), in(wi), mode...); }
  template <class... Mode>
  std::optional<BsdfSample> sample(vec3 wo, BsdfU u, Mode... mode) const requires requires {
    closure.sample(wo, u, mode...);
  }
  {
    auto s = closure.sample(in(wo), u, mode...);
    if (s) s->wi = out(s->wi);
    return s;
  }
  float delta_probability(vec3 wo) const { return closure.delta_probability(in(wo)); }
  BsdfFlags flags() const { return closure.flags(); }
  LobeProxy lobe_proxy(vec3 wo) const { return closure.lobe_proxy(in(wo)); }
  Spectrum albedo() const { return closure.albedo(); }
  Turned with_outside_ior(float outside) const requires requires { closure.with_outside_ior(outside); }
  { return {closure.with_outside_ior(outside), axis}; }

private:
  vec3 in(vec3 w) const { return {w.x * axis.x + w.y * axis.y, w.y * axis.x - w.x * axis.y, w.z}; }
  vec3 out(vec3 w) const { return {w.x * axis.x - w.y * axis.y, w.y * axis.x + w.x * axis.y, w.z}; }
};

} // namespace candela
