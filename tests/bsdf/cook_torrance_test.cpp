#include "bsdf/cook_torrance.h"
#include "support/bsdf_contract.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace candela::test {
namespace {

constexpr FacetNormals kNormals[] = {FacetNormals::ggx, FacetNormals::beckmann, FacetNormals::blinn};
constexpr FacetMasking kMaskings[] = {FacetMasking::smith, FacetMasking::schlick, FacetMasking::v_cavity};
constexpr FacetFresnel kFresnels[] = {FacetFresnel::exact, FacetFresnel::schlick};
constexpr const char* kNormalsNames[] = {"ggx", "beckmann", "blinn"};
constexpr const char* kMaskingNames[] = {"smith", "schlick", "v-cavity"};

TestedBsdf named(const CookTorrance& model) {
  return tested(fmt::format("{} {} {} alpha {} f0 {} diffuse {}", kNormalsNames[int(model.normals)],
                            kMaskingNames[int(model.masking)],
                            model.fresnel == FacetFresnel::exact ? "exact" : "schlick", model.alpha,
                            model.f0.x, model.diffuse.x),
                model, std::clamp(2 * double(model.alpha), 2e-3, 2.0));
}

/// All D, G and F over metal, plastic and between; few alphas, for there are many.
std::vector<CookTorrance> models(std::initializer_list<float> alphas) {
  std::vector<CookTorrance> all;
  for (const FacetNormals d : kNormals)
    for (const FacetMasking g : kMaskings)
      for (const float alpha : alphas) {
        const FacetFresnel f = kFresnels[all.size() % 2];
        all.push_back({Spectrum(0), {1, 0.7f, 0.3f}, alpha, d, g, f});
        all.push_back({{1, 0.5f, 0}, Spectrum(0.04f), alpha, d, g, f});
      }
  return all;
}

// The textbook, in double and in angles.

double textbook_d(FacetNormals kind, double alpha, double theta) {
  const double pi = std::numbers::pi, c = std::cos(theta), t = std::tan(theta), a2 = alpha * alpha;
  if (kind == FacetNormals::ggx) return a2 / (pi * std::pow(c * c * (a2 - 1) + 1, 2));
  if (kind == FacetNormals::beckmann) return std::exp(-t * t / a2) / (pi * a2 * std::pow(c, 4));
  const double n = 2 / a2 - 2;
  return (n + 2) / (2 * pi) * std::pow(c, n);
}
/// Lambda of any D by its definition: what facets show to w, less what they turn away (Heitz 2014, eq. 31).
double numeric_g1(FacetNormals kind, double alpha, double theta_w) {
  double sum = 0;
  constexpr int kSteps = 2000;
  // h = (theta, phi); theta by a variable that is dense where D is.
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps, t = alpha * u / (1 - u), theta = std::atan(t);
    const double dtheta = alpha / ((1 - u) * (1 - u) * (1 + t * t)) / kSteps;
    // Integral over phi of max(0, a + b cos phi).
    const double a = std::cos(theta) * std::cos(theta_w), b = std::sin(theta) * std::sin(theta_w);
    const double edge = a >= b ? std::numbers::pi : std::acos(-a / b);
    sum += textbook_d(kind, alpha, theta) * std::sin(theta) * dtheta * 2 * (a * edge + b * std::sin(edge));
  }
  return std::cos(theta_w) / sum;
}
double textbook_fresnel(FacetFresnel kind, double f0, double cosine) {
  if (kind == FacetFresnel::schlick) return f0 + (1 - f0) * std::pow(1 - cosine, 5);
  const double eta = (1 + std::sqrt(f0)) / (1 - std::sqrt(f0));
  const double g = std::sqrt(eta * eta + cosine * cosine - 1), c = cosine; // Cook & Torrance's form
  return 0.5 * std::pow((g - c) / (g + c), 2) * (1 + std::pow((c * (g + c) - 1) / (c * (g - c) + 1), 2));
}

TEST(CookTorrance, AgainstTheTextbook) {
  const glm::dvec3 diffuse(0.7, 0.2, 0), f0(0.04, 0.3, 0.8);
  for (const FacetNormals d : kNormals)
    for (const FacetMasking g : kMaskings)
      for (const FacetFresnel f : kFresnels)
        for (const double alpha : {0.08, 0.35, 1.0}) {
          const CookTorrance model{Spectrum(diffuse), Spectrum(f0), float(alpha), d, g, f};
          for (const auto& [o, i, phi] : {std::tuple(0.3, 0.35, 3.1), std::tuple(1.2, 0.7, 2.0),
                                          std::tuple(1.45, 1.4, 3.3), std::tuple(0.6, 0.1, 0.5)}) {
            const vec3 wo = polar(o, 0), wi = polar(i, phi);
            const glm::dvec3 sum = glm::dvec3(wo) + glm::dvec3(wi), h = glm::normalize(sum);
            const double oh = glm::dot(glm::dvec3(wo), h), theta_h = std::acos(h.z);
            const double co = std::cos(o), ci = std::cos(i), k = alpha / 2;
            double masking = std::min({1.0, 2 * h.z * co / oh, 2 * h.z * ci / oh});
            if (g == FacetMasking::schlick) masking = co / (co * (1 - k) + k) * ci / (ci * (1 - k) + k);
            if (g == FacetMasking::smith)
              masking = 1 / (1 / numeric_g1(d, alpha, o) + 1 / numeric_g1(d, alpha, i) - 1);
            for (int c = 0; c < 3; ++c) {
              const double expected =
                  textbook_d(d, alpha, theta_h) * masking * textbook_fresnel(f, f0[c], oh) / (4 * co) +
                  (1 - textbook_fresnel(f, f0[c], co)) * (1 - textbook_fresnel(f, f0[c], ci)) * diffuse[c] *
                      ci / std::numbers::pi;
              EXPECT_NEAR(double(model.eval(wo, wi)[c]), expected, 1e-4 * expected + 1e-6)
                  << kNormalsNames[int(d)] << ' ' << kMaskingNames[int(g)] << ' ' << alpha << ' ' << o;
            }
          }
        }
}

TEST(CookTorrance, AgainstMitsuba) {
  // Mitsuba 3.9.1, roughconductor, eta = (1 + sqrt .3) / (1 - sqrt .3), k = 0: bsdf.eval(ctx, si, wo) with
  // si.wi = polar(.5, .2), wo = polar(.9, 2.8) and polar(1.3, 3.6). It multiplies Smith's G1 of both sides;
  // Beckmann's are those of Walter et al. 2007, section 5.2.
  auto g1_of = [](FacetNormals normals, double alpha, double theta, bool walter) {
    const double a = 1 / (alpha * std::tan(theta));
    if (!walter || normals == FacetNormals::ggx) return numeric_g1(normals, alpha, theta);
    return a < 1.6 ? (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a) : 1;
  };
  struct Known {
    FacetNormals normals;
    float alpha, value[2];
  };
  for (const auto& [normals, alpha, value] :
       {Known{FacetNormals::ggx, 0.25f, {0.0857296f, 0.0301674f}},
        Known{FacetNormals::ggx, 0.8f, {0.0308073f, 0.0169750f}},
        Known{FacetNormals::beckmann, 0.25f, {0.1248157f, 0.0247637f}},
        Known{FacetNormals::beckmann, 0.8f, {0.0429339f, 0.0321846f}}}) {
    const CookTorrance model{Spectrum(0), Spectrum(0.3f), alpha, normals};
    const vec3 wo = polar(0.5, 0.2);
    int n = 0;
    for (const vec3 wi : {polar(0.9, 2.8), polar(1.3, 3.6)}) {
      const double theta = std::acos(double(wi.z)), a = double(alpha);
      const double o = g1_of(normals, a, 0.5, false), i = g1_of(normals, a, theta, false);
      const double others = g1_of(normals, a, 0.5, true) * g1_of(normals, a, theta, true);
      EXPECT_NEAR(double(model.eval(wo, wi).x) * others * (1 / o + 1 / i - 1), double(value[n]),
                  1e-4 * double(value[n]))
          << alpha << ' ' << n;
      ++n;
    }
  }
}

TEST(BlinnFacets, LambdaIsExact) {
  for (const float alpha : {1e-3f, 0.03f, 0.2f, 0.25f, 0.26f, 0.5f, 0.9f, 1.0f})
    for (const double relative : {0.01, 0.1, 0.3, 0.5, 1.0, 2.0, 5.0, 30.0, 1000.0}) {
      const double theta = std::atan(relative / double(alpha));
      const float g1 = 1 / (1 + BlinnFacets{alpha}.lambda(polar(theta, 1)));
      EXPECT_NEAR(double(g1), numeric_g1(FacetNormals::blinn, double(alpha), theta), 2e-5)
          << alpha << ' ' << relative;
    }
}

TEST(CookTorrance, SamplesAgree) {
  for (const CookTorrance& model : models({1e-3f, 0.3f, 1})) expect_samples_agree(named(model));
}

TEST(CookTorrance, Reciprocity) {
  for (const CookTorrance& model : models({0.02f, 0.3f, 1})) expect_reciprocal(named(model), 5000, 1e-5f);
}

TEST(CookTorrance, WeakFurnaceOfTheGrooves) {
  // Grooves that absorb nothing, nearly flat, lose nothing; with the paper's 1 / pi they would give 4 / pi.
  for (const FacetNormals normals : kNormals) {
    const CookTorrance model{Spectrum(0),          Spectrum(1), 0.02f, normals, FacetMasking::v_cavity,
                             FacetFresnel::schlick};
    EXPECT_NEAR(albedo_by_quadrature(named(model), polar(0.4, 0.3)).x, 1, 1e-3);
  }
}

TEST(CookTorrance, KnownAlbedoOfGgx) {
  for (const auto& [cosine, albedo] : {std::pair(1.0f, 0.6879f), {0.5f, 0.6983f}, {0.1f, 0.8601f}}) {
    const CookTorrance model{Spectrum(0),       Spectrum(1),         0.5f,
                             FacetNormals::ggx, FacetMasking::smith, FacetFresnel::schlick};
    EXPECT_NEAR(albedo_by_quadrature(named(model), {std::sqrt(1 - sqr(cosine)), 0, cosine}).x, albedo, 2e-4);
  }
}

TEST(CookTorranceStatistical, DirectionsFollowThePdf) {
  const auto all = models({0.05f, 0.6f});
  // G and F do not enter into the density.
  std::vector<CookTorrance> few;
  for (const CookTorrance& model : all)
    if (model.masking == FacetMasking::smith) few.push_back(model);
  const auto directions = contract_directions();
  for (const CookTorrance& model : few)
    for (const vec3 wo : directions)
      expect_directions_follow_pdf(named(model), wo, static_cast<int>(few.size() * directions.size()), 20000);
}

TEST(CookTorranceStatistical, EnergyIsConserved) {
  std::vector<CookTorrance> all;
  for (const FacetFresnel f : kFresnels)
    for (const FacetNormals d : kNormals)
      for (const FacetMasking g : kMaskings)
        for (const float alpha : {0.05f, 0.3f, 1.0f}) {
          // White base; facets of glass, of half a metal and of metal, one a channel.
          all.push_back({{1, 0.5f, 0}, {0.04f, 0.5f, 1}, alpha, d, g, f});
        }
  all.push_back({Spectrum(1), Spectrum(0), 0.3f});
  for (const CookTorrance& model : all) expect_conserves_energy(named(model), static_cast<int>(all.size()));
}

} // namespace
} // namespace candela::test
