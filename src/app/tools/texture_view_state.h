#pragma once
// What the texture viewer shows; panels and the viewer's own widgets edit it.

#include "textures/texture_grid.h"

#include <optional>
#include <string>

namespace candela {

/// A parameter of a material, by its key.
struct TextureTarget {
  std::size_t material = 0; ///< index into SceneDesc::materials
  std::string key;
  bool operator==(const TextureTarget&) const = default;
};

struct TextureViewState {
  bool visible = false;
  int texture = -1;                   ///< index into SceneDesc::textures
  std::optional<TextureTarget> as_of; ///< shown as this parameter sees it; nothing: the texture itself
  bool fit_wanted = false;            ///< all of it is to be visible
  TextureDisplay display;
  int level = 0;
  int resolution = 1; ///< of patterns: 256 << this along one unit
  bool tiled = false; ///< two copies along u and v
  bool uv_layout = false;

  void show(int index, std::optional<TextureTarget> parameter = {}) {
    visible = fit_wanted = true;
    texture = index;
    as_of = std::move(parameter);
    level = 0;
  }
};

} // namespace candela
