#pragma once
// `candela bench scale`: the cost of reading, building and rendering one scene. The functions measure the
// whole process, so each runs in a process of its own (app/platform/separate_process.h).

#include "app/console/scene_options.h"

#include <cstdint>
#include <string>

namespace candela {

struct ScaleResult {
  std::string name;
  std::uint64_t distinct_triangles = 0; ///< shared meshes count once
  std::uint64_t placed_triangles = 0;   ///< shared meshes count in every instance
  std::uint64_t spheres = 0;
  std::uint64_t lights = 0; ///< that are sampled; every emissive triangle is one
  int width = 0, height = 0, threads = 0;
  double load_s = 0;                 ///< from files to the document
  double build_s = 0;                ///< geometry, acceleration structure, lights
  double first_pass_s = 0;           ///< one sample of every pixel
  std::uint64_t accel_bytes = 0;     ///< acceleration structure, shared objects once
  std::uint64_t scene_bytes = 0;     ///< everything that the build made
  std::uint64_t load_peak_bytes = 0; ///< peak memory of the process until the document is read
  std::uint64_t peak_bytes = 0;      ///< until the first image is rendered
  double samples_per_s_one = 0;      ///< by one thread
  double samples_per_s = 0;          ///< by all
  double speedup = 0;                ///< the median of ratios of neighbouring passes

  double to_first_image_s() const { return load_s + build_s + first_pass_s; }
};

/// Reads the scene, builds it and renders one sample a pixel; then alternates passes of one sample a pixel by
/// one thread and by all, `rounds` of each.
ScaleResult measure_scene(const SceneOptions& scene, const std::string& name, ivec2 size, int rounds);

struct ScalePicture {
  int width = 0, height = 0, spp = 0, threads = 0;
  double load_s = 0, build_s = 0, render_s = 0;
  double relmse = 0;          ///< from two seeds at an eighth of the size
  double variance_relmse = 0; ///< from the film's variance, as if samples were independent
  std::uint64_t peak_bytes = 0;
};

/// Renders the scene without a denoiser to `path`, as `candela render` does.
ScalePicture render_scale_picture(const SceneOptions& scene, ivec2 size, int spp, const std::string& path);

/// Conversion to JSON objects and back.
std::string to_json(const ScaleResult& result);
std::string to_json(const ScalePicture& picture);
ScaleResult scale_result(const std::string& json);
ScalePicture scale_picture(const std::string& json);

} // namespace candela
