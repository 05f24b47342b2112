// The surface of a body that scatters light inside.

#include "bsdf/subsurface.h"
#include "support/bsdf_contract.h"
#include "support/seed.h"

#include <gtest/gtest.h>

namespace candela::test {
namespace {

Subsurface surface(SubsurfaceMethod method, Subsurface::Part part, float alpha, float ior,
                   Spectrum color = Spectrum(0.8f, 0.5f, 0.2f)) {
  constexpr auto kGgx = MicrofacetDistribution::ggx;
  Subsurface s;
  s.plastic = {color, Spectrum(1),          ior,
               false, {kGgx, alpha, alpha}, alpha > 0 ? &CoatAlbedo::of(kGgx) : nullptr};
  s.compensation = alpha > 0 ? &InterfaceAlbedo::of(kGgx) : nullptr;
  s.method = method;
  s.part = part;
  return s;
}

std::vector<TestedBsdf> subsurface_models() {
  using enum SubsurfaceMethod;
  using Part = Subsurface::Part;
  std::vector<TestedBsdf> models;
  models.push_back(tested("smooth walk", surface(random_walk, Part::whole, 0, 1.4f), 2, 1.4f));
  models.push_back(tested("rough walk", surface(random_walk, Part::whole, 0.3f, 1.4f), 2, 1.4f));
  models.push_back(tested("matching walk", surface(random_walk, Part::whole, 0, 1)));
  models.push_back(tested("smooth whole", surface(burley, Part::whole, 0, 1.4f)));
  models.push_back(tested("rough whole", surface(dipole, Part::whole, 0.3f, 1.4f)));
  models.push_back(tested("exit", surface(burley, Part::exit, 0.3f, 1.5f)));
  models.push_back(tested("smooth exit", surface(burley, Part::exit, 0, 1.5f)));
  return models;
}

TEST(Subsurface, SamplesAgree) {
  for (const TestedBsdf& model : subsurface_models()) expect_samples_agree(model);
}

TEST(Subsurface, DirectionsFollowThePdf) {
  for (const TestedBsdf& model : subsurface_models()) expect_directions_follow_pdf(model, polar(0.7, 1), 20);
  expect_directions_follow_pdf(
      tested("entry", surface(SubsurfaceMethod::burley, Subsurface::Part::entry, 0.4f, 1.4f)), polar(1, 0.3),
      20);
}

/// What is not mirrored enters, by that share of the samples.
TEST(Subsurface, WhatIsNotReflectedEnters) {
  for (const float alpha : {0.0f, 0.3f})
    for (const double theta : {0.3, 1.2})
      for (const double side : {1.0, -1.0}) {
        const Subsurface entry = surface(SubsurfaceMethod::dipole, Subsurface::Part::entry, alpha, 1.5f);
        vec3 wo = polar(theta, 2);
        const float reflected = entry.plastic.reflectance(wo.z);
        wo.z *= static_cast<float>(side);
        double mirrored = 0, enters = 0;
        const int n = 64;
        for (int i = 0; i < n * n * n; ++i) {
          const vec3 u((i % n + 0.5f) / n, (i / n % n + 0.5f) / n, (i / n / n + 0.5f) / n);
          const auto s = entry.sample(wo, u);
          if (!s) continue;
          const double share = static_cast<double>(s->weight.x) / (n * n * n);
          (same_hemisphere(wo, s->wi) ? mirrored : enters) += share;
          if (!same_hemisphere(wo, s->wi)) {
            EXPECT_TRUE(s->delta);
            EXPECT_LT(u.z, entry.delta_probability(wo));
          }
        }
        EXPECT_NEAR(enters, 1 - static_cast<double>(reflected), 1e-2);
        EXPECT_NEAR(mirrored, static_cast<double>(reflected), 1e-2);
      }
}

/// In the limit of no distance between them, entry and exit are the whole.
TEST(Subsurface, EntryAndExitMakeTheWhole) {
  for (const float alpha : {0.0f, 0.3f}) {
    auto part = [&](Subsurface::Part p) { return surface(SubsurfaceMethod::burley, p, alpha, 1.5f); };
    const vec3 wo = polar(0.9, 0), wi = polar(1.1, 2);
    const Subsurface entry = part(Subsurface::Part::entry), exit = part(Subsurface::Part::exit);
    const Spectrum left = entry.transmittance(wo.z) * entry.plastic.diffuse * exit.eval({0, 0, 1}, wi);
    const Spectrum sum = entry.eval(wo, wi) + left;
    const Spectrum whole = part(Subsurface::Part::whole).eval(wo, wi);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], 1e-6f + 1e-4f * whole[c]);
  }
}

} // namespace
} // namespace candela::test
