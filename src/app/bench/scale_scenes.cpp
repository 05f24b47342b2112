#include "app/bench/scale_scenes.h"

#include "app/bench/scale_models.h"
#include "app/bench/scale_noise.h"
#include "io/files/atomic_file.h"
#include "io/images/image_file.h"
#include "io/obj/obj_writer.h"
#include "scene/clear_sky.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace candela {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

constexpr const char* kLandscape = R"({{
  "candela": 1,
  "description": "Mountains of {} distinct triangles in the afternoon, lit by a panorama with a sun; a large texture colours the ground, boulders lie in the valley. Fly through it, or try view = bvh_cost. Written by `candela bench scale`.",

  "camera": {{"position": [{:.4f}, {:.4f}, {:.4f}], "target": [{}, {}, {}], "vertical_fov": 38}},

  "lights": [{{"name": "sky", "type": "environment", "file": "sky.hdr", "scale": 0.35}}],

  "instances": [{{"name": "mountains", "file": "{}"}}],

  "settings": {{"film": {{"width": 960, "height": 540}}, "stop": {{"spp": 64}}, "display": {{"tone_map": "filmic"}}}}
}}
)";

constexpr const char* kLandscapeMtl = R"(newmtl ground
Kd 1 1 1
map_Kd ground.jpg

newmtl boulder
Kd 1 1 1
map_Kd stone.png
)";

constexpr const char* kStonesHead = R"({{
  "candela": 1,
  "description": "{0} stones in a spiral: instances of one mesh, each turned and scaled in its own way. {0} copies would fill the memory of a small machine; the mesh is there once. Written by `candela bench scale`.",

  "camera": {{"position": [0, {1:.3f}, {2:.3f}], "target": [0, -1, {3:.3f}], "vertical_fov": 34}},

  "materials": [
    {{"name": "sand", "diffuse": [0.44, 0.36, 0.26]}},
    {{"name": "granite", "diffuse": [1, 0.98, 0.94], "diffuse_texture": "stone.png"}},
    {{"name": "basalt", "diffuse": [0.42, 0.44, 0.5], "diffuse_texture": "stone.png"}},
    {{"name": "sandstone", "diffuse": [1, 0.74, 0.52], "diffuse_texture": "stone.png"}}
  ],

  "lights": [{{"name": "sky", "type": "environment", "file": "sky.hdr", "scale": 0.35}}],

  "meshes": {{"stone": {{"file": "{4}.obj"}}}},

  "instances": [
    {{"name": "ground", "shape": "plane", "material": "sand", "transform": [{{"rotate": [1, 0, 0, -90]}}]}})";

constexpr const char* kStonesTail = R"(
  ],

  "settings": {"film": {"width": 960, "height": 540}, "stop": {"spp": 64}, "display": {"tone_map": "filmic"}}
}
)";

void write_texture(const Texels& texels, const std::string& path) {
  write_srgb8_image(texels.width, texels.height, srgb8_texels(texels), path);
}

} // namespace

void write_scale_assets(const std::string& folder, const ScaleDetail& detail) {
  ClearSky sky;
  sky.sun_elevation = 24 * kDegree;
  sky.sun_azimuth = -62 * kDegree;
  sky.sun_radius = 1 * kDegree;
  write_linear_image(clear_sky_panorama(sky, detail.sky, detail.sky / 2, 2), folder + "/sky.hdr");
  write_texture(mountain_texture(detail.ground), folder + "/ground.jpg");
  write_texture(stone_texture(detail.stone), folder + "/stone.png");
  write_file_atomically(folder + "/landscape.mtl", std::string_view(kLandscapeMtl));
}

std::string write_landscape(const std::string& folder, const std::string& name, std::size_t triangles) {
  const Mesh mesh = mountain_mesh(triangles);
  write_obj(mesh, "landscape.mtl", fmt::format("{}/{}.obj", folder, name));
  const glm::dvec2 eye(0.3, 2.2), target(-0.6, -8);
  std::string path = fmt::format("{}/{}.json", folder, name);
  write_file_atomically(path,
                        fmt::format(kLandscape, mesh.triangles.size(), eye.x, mountain_height(eye) + 0.45,
                                    eye.y, target.x, 1.2, target.y, name + ".obj"));
  return path;
}

std::string write_stones(const std::string& folder, const std::string& name, int instances,
                         std::size_t triangles) {
  const auto cells = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(triangles) / 12)));
  write_obj(stone_mesh(cells, 7), "", fmt::format("{}/{}.obj", folder, name));
  constexpr const char* kMaterials[] = {"granite", "basalt", "sandstone"};
  // A sunflower's seeds (H. Vogel, "A better way to construct the sunflower head", 1979): turned by the
  // golden angle from one to the next, at equal density.
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0)), spacing = 1.25;
  const double radius = spacing * std::sqrt(instances + 0.5);
  std::string text =
      fmt::format(kStonesHead, instances, 2 + 0.3 * radius, 3 + 1.04 * radius, 0.2 * radius, name);
  for (int i = 0; i < instances; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const double r = spacing * std::sqrt(i + 0.5), phi = golden_angle * i;
    const double size = 0.45 + 0.55 * hashed_unit(index, 11);
    const auto material = static_cast<std::size_t>(3 * hashed_unit(index, 12));
    fmt::format_to(
        std::back_inserter(text),
        ",\n    {{\"name\": \"stone {}\", \"mesh\": \"stone\", \"material\": \"{}\", \"transform\": "
        "[{{\"scale\": [{:.3f}, {:.3f}, {:.3f}]}}, {{\"rotate\": [{:.3f}, {:.3f}, 0.5, {:.1f}]}}, "
        "{{\"translate\": [{:.3f}, {:.3f}, {:.3f}]}}]}}",
        i + 1, kMaterials[material], size, size * (0.6 + 0.4 * hashed_unit(index, 13)), size,
        hashed_unit(index, 14) - 0.5, hashed_unit(index, 15), 360 * hashed_unit(index, 16), r * std::cos(phi),
        0.5 * size, r * std::sin(phi));
  }
  std::string path = fmt::format("{}/{}.json", folder, name);
  write_file_atomically(path, text + kStonesTail);
  return path;
}

} // namespace candela
