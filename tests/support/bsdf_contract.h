#pragma once
// What every scattering model promises (bsdf/bsdf_sample.h), as tests that a model calls with its cases.

#include "bsdf/bsdf_sample.h"
#include "support/direction_statistics.h"

#include <functional>
#include <string>

namespace candela::test {

/// A closure of any type, for the tests.
struct TestedBsdf {
  std::string name;
  std::function<BsdfEval(vec3 wo, vec3 wi, TransportMode)> eval_pdf;
  std::function<std::optional<BsdfSample>(vec3 wo, BsdfU, TransportMode)> sample;
  std::function<float(vec3 wo)> delta_probability;
  BsdfFlags flags = BsdfFlags::none;
  float ior = 1;    ///< inside over outside, of those that refract
  double width = 2; ///< radians about the mirror and the refracted direction that hold most of the light
};

template <class Closure>
TestedBsdf tested(std::string name, const Closure& closure, double width = 2, float ior = 1) {
  return {std::move(name),
          [closure](vec3 wo, vec3 wi, [[maybe_unused]] TransportMode mode) {
            if constexpr (requires { closure.eval_pdf(wo, wi, mode); })
              return closure.eval_pdf(wo, wi, mode);
            else
              return closure.eval_pdf(wo, wi);
          },
          [closure](vec3 wo, BsdfU u, [[maybe_unused]] TransportMode mode) {
            if constexpr (requires { closure.sample(wo, u, mode); })
              return closure.sample(wo, u, mode);
            else
              return closure.sample(wo, u);
          },
          [closure](vec3 wo) { return closure.delta_probability(wo); },
          closure.flags(),
          ior,
          width};
}

/// The direction at the angle theta from the normal and the azimuth phi, radians.
inline vec3 polar(double theta, double phi) {
  return vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
}

/// From the normal to 89.9 degrees from it, of several azimuths, on both sides.
std::vector<vec3> contract_directions();

/// sample() gives what eval_pdf() says, stays finite at the corners of the random numbers and in grazing
/// directions, takes delta lobes exactly where it should, and flags tell the sides that it uses.
void expect_samples_agree(const TestedBsdf& bsdf);
/// A chi-square test of sampled directions against the density, each side of the surface for itself, at a
/// significance of 0.01 over `cases` in all.
void expect_directions_follow_pdf(const TestedBsdf& bsdf, vec3 wo, int cases, std::size_t draws = 60000);
/// f(wo, wi) = f(wi, wo) over random pairs; of pairs on two sides f(wo, wi) / eta_o^2 in radiance mode, see
/// Veach 1997, eq. 5.14. Error relative to the value, or to 1/sr where it is less, beyond what the
/// directions' last digits explain.
void expect_reciprocal(const TestedBsdf& bsdf, int pairs = 20000, float tolerance = 1e-5f);
/// All that leaves for light from wo, in importance mode: by quadrature, without delta lobes. Each channel.
vec3 albedo_by_quadrature(const TestedBsdf& bsdf, vec3 wo);
/// The same by samples, delta lobes included, and its standard deviation.
struct SampledAlbedo {
  RunningStatistics channel[3];
};
SampledAlbedo albedo_by_samples(const TestedBsdf& bsdf, vec3 wo, int count);
/// Albedo at most 1 + 1e-4 from everywhere, and samples that agree with it.
void expect_conserves_energy(const TestedBsdf& bsdf, int cases);

} // namespace candela::test
