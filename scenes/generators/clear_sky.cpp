// Writes scenes/panoramas/clear_sky.hdr: a clear sky with its sun over a plain (scene/clear_sky.h).
//
//   cmake --build --preset release --target scene_data

#include "scene/clear_sky.h"

#include "core/math.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <cstdio>
#include <numbers>

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: make_clear_sky FILE.hdr\n");
    return 2;
  }
  constexpr double kDegree = std::numbers::pi / 180;
  candela::ClearSky sky;
  sky.sun_elevation = 32 * kDegree;
  sky.sun_azimuth = 60 * kDegree;
  sky.sun_radius = 1.0 * kDegree;
  candela::write_linear_image(candela::clear_sky_panorama(sky, 512, 256, 8), argv[1]);
}
