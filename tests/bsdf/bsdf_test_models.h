#pragma once
// Models and directions for several tests.

#include "materials/bsdf.h"
#include "support/seed.h"

#include <random>
#include <string>
#include <vector>

namespace candela::test {

struct NamedBsdf {
  std::string name;
  Bsdf bsdf;
  double width = 2; ///< of the lobe about the mirror direction, radians, for quadrature
};

/// Reflecting models with a part that is not delta.
inline std::vector<NamedBsdf> glossy_models() {
  std::vector<NamedBsdf> models = {
      {"diffuse", Diffuse{vec3(0.8f, 0.5f, 0.2f)}, 2},
      {"mirror and diffuse", Mirror{vec3(0.5f, 0.6f, 0.7f), vec3(0.3f, 0.2f, 0.1f)}, 2},
  };
  for (float exponent : {0.0f, 1.0f, 5.0f, 40.0f, 1000.0f}) {
    double width = 2 / std::sqrt(double(exponent) + 1);
    std::string n = std::to_string(static_cast<int>(exponent));
    models.push_back({"phong " + n, Phong{vec3(0.3f, 0.2f, 0.4f), vec3(0.6f, 0.7f, 0.5f), exponent}, width});
    models.push_back({"phong without diffuse " + n, Phong{vec3(0), vec3(0.9f), exponent}, width});
  }
  for (float roughness : {0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f})
    models.push_back({"ggx " + std::to_string(roughness), Ggx{vec3(0.9f, 0.6f, 0.3f), roughness},
                      2 * double(sqr(roughness))});
  return models;
}

inline vec3 direction(float theta, float phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// From the normal to grazing, and below the surface.
inline std::vector<vec3> outgoing_directions() {
  return {vec3(0, 0, 1),
          direction(radians(20), 0.3f),
          direction(radians(45), 2.0f),
          direction(radians(75), -1.0f),
          direction(radians(88), 4.0f),
          direction(radians(89.9f), 0.5f),
          vec3(0, 0, -1),
          direction(radians(120), 1.0f),
          direction(radians(95), -2.0f)};
}

class RandomNumbers {
public:
  explicit RandomNumbers(std::uint64_t stream) : random_(fresh_seed() * 31 + stream) {}
  float one() { return static_cast<float>(random_() >> 40) * 0x1p-24f; }
  vec3 three() {
    float x = one(), y = one();
    return {x, y, one()};
  }
  vec3 direction() {
    float x = one();
    return sample_uniform_sphere({x, one()});
  }

private:
  std::mt19937_64 random_;
};

} // namespace candela::test
