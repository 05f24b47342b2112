#pragma once

#include "app/console/scene_options.h"

#include <optional>

namespace candela {

struct RenderOptions {
  SceneOptions scene;
  std::vector<std::string> outputs; ///< empty: the job's outputs
  std::optional<int> spp;
  std::optional<float> time;       ///< seconds
  std::optional<float> noise;      ///< relative error
  std::vector<std::string> aovs;   ///< names of further pictures to write
  std::optional<std::string> size; ///< "WxH"
  std::optional<int> seed;
  std::optional<std::string> crop; ///< "X,Y,W,H"
  std::optional<std::string> reference;
  std::optional<std::string> stats;
  bool quiet = false;
  bool no_state = false; ///< do not keep the scene in the pictures
};

/// `candela render`. If interrupted (SIGINT, SIGTERM), it writes the samples so far and returns 130 or 143.
int run_render(const RenderOptions& options);

} // namespace candela
