#pragma once
// One pass on this machine's CPU.

#include "render/film/cpu_pass_renderer.h"
#include "render/film/replay.h"
#include "render/world/render_scene.h"

namespace candela {

struct PassOptions {
  int threads = 0; ///< 0: every core
  CropWindow crop;
  std::array<Film*, 3> components{};                   ///< as PassFilms::components
  LayerFilm* layers = nullptr;                         ///< likewise
  std::shared_ptr<const CameraModel> camera = nullptr; ///< as PassJob::camera
};

/// CpuPassRenderer::render().
PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const StopCondition& stop, const PassOptions& options = {});

} // namespace candela
