#pragma once
// Blender's Cycles as a renderer that keeps a scene loaded: cycles_render.py, driven through pipes.

#include "scene/document.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace candela::versus {

/// The path of `blender` in $PATH, if there is one.
std::optional<std::string> find_blender();

/// Writes the input of cycles_render.py: scene.json, vertices and triangles as raw float32 and uint32, the
/// panorama as EXR. Everything is in world space. Throws a usage error for anything that the script does not
/// support: it knows diffuse and ggx materials without textures, one panorama, meshes, rectangles and
/// emissive spheres.
void write_cycles_scene(const Document& document, const std::string& folder);

class Cycles {
public:
  /// Starts blender on the folder's scene; its output goes to <folder>/blender.log. `settings` are
  /// "NAME=VALUE" of Blender's scene.cycles.
  Cycles(const std::string& blender, const std::string& folder, int threads,
         const std::vector<std::string>& settings);
  Cycles(const Cycles&) = delete;
  Cycles& operator=(const Cycles&) = delete;
  ~Cycles();

  /// Blender's version, "3.4.1".
  const std::string& version() const { return version_; }
  /// Renders to an EXR; returns the seconds that Cycles reports for rendering, without scene synchronisation
  /// and BVH building, with a resolution of 0.01.
  double render(int seed, int spp, const std::string& exr);

private:
  /// The rest of the next line that begins with `word`.
  std::string answer(std::string_view word);

  std::string log_;
  int process_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
  std::string version_;
};

} // namespace candela::versus
