#include "scene/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace candela {

namespace {

constexpr double kPiDouble = std::numbers::pi;
/// The sun's illuminance on a surface that faces it, over the zenith's luminance, sr: 90 klx over 4.3
/// kcd/m^2.
constexpr double kSunToZenith = 21;
const glm::dvec3 kSunColor{1.12, 0.99, 0.76};

/// Directions are those of the latlong mapping.
glm::dvec3 direction(double u, double v) {
  const double phi = 2 * kPiDouble * u, theta = kPiDouble * v;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

/// Perez's five parameters of a quantity, linear in the turbidity (Preetham et al., A.2).
struct Perez {
  double a, b, c, d, e;
  double operator()(double cos_theta, double gamma) const {
    return (1 + a * std::exp(b / cos_theta)) *
           (1 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma));
  }
};

/// Linear Rec. 709 of luminance 1 at the zenith.
class Distribution {
public:
  Distribution(double t, glm::dvec3 sun) : sun_(sun) {
    const double s = std::acos(sun.y), s2 = s * s, s3 = s2 * s;
    luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                  -0.0670 * t + 0.3703};
    x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
          -0.0033 * t + 0.0452};
    y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
          -0.0109 * t + 0.0529};
    zenith_x_ = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
    zenith_y_ = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
  }

  glm::dvec3 radiance(glm::dvec3 d) const {
    const double cos_theta = std::max(d.y, 0.01); // Perez's formula is valid above the horizon
    const double gamma = std::acos(std::clamp(glm::dot(d, sun_), -1.0, 1.0));
    const double zenith_gamma = std::acos(sun_.y);
    auto relative = [&](const Perez& f) { return f(cos_theta, gamma) / f(1, zenith_gamma); };
    const double luminance = relative(luminance_);
    const double x = zenith_x_ * relative(x_), y = zenith_y_ * relative(y_);
    const glm::dvec3 xyz{x / y * luminance, luminance, (1 - x - y) / y * luminance};
    const glm::dvec3 rgb{3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
                         -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
                         0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z};
    return glm::max(rgb, glm::dvec3(0));
  }

private:
  glm::dvec3 sun_;
  Perez luminance_, x_, y_;
  double zenith_x_, zenith_y_;
};

} // namespace

Image clear_sky_panorama(const ClearSky& clear, int width, int height, int subpixels) {
  const double u_sun = 0.5 + clear.sun_azimuth / (2 * kPiDouble),
               v_sun = 0.5 - clear.sun_elevation / kPiDouble;
  const glm::dvec3 sun = direction(u_sun, v_sun);
  const Distribution sky(clear.turbidity, sun);
  const double sun_solid_angle = 2 * kPiDouble * (1 - std::cos(clear.sun_radius));
  Image image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      glm::dvec3 sum(0);
      for (int i = 0; i < subpixels * subpixels; ++i) {
        const int column = i % subpixels, row = i / subpixels;
        const glm::dvec3 d =
            direction((x + (column + 0.5) / subpixels) / width, (y + (row + 0.5) / subpixels) / height);
        if (d.y < 0)
          sum += clear.ground * (0.6 + 0.4 * std::exp(8 * d.y)); // haze towards the horizon
        else
          sum += sky.radiance(d);
        if (glm::dot(d, sun) > std::cos(clear.sun_radius))
          sum += kSunColor * (kSunToZenith / sun_solid_angle);
      }
      image.pixels.push_back(vec3(sum / static_cast<double>(subpixels * subpixels)));
    }
  return image;
}

} // namespace candela
