#pragma once
// Blender's Cycles as a renderer that keeps a scene loaded: cycles_render.py, driven through pipes.

#include "scene/document.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace candela::versus {

/// The path of `blender` by $PATH; nothing where there is none.
std::optional<std::string> find_blender();

/// Writes what cycles_render.py builds the scene from: scene.json and, beside it, vertices and triangles as
/// raw float32 and uint32, the panorama as EXR. Everything is in world space. Throws a usage error for what
/// the script does not know: materials but diffuse and ggx without textures, lights but one panorama, shapes
/// but meshes, rectangles and shining spheres.
void write_cycles_scene(const Document& document, const std::string& folder);

class Cycles {
public:
  /// Starts blender on the folder's scene; everything it says goes to <folder>/blender.log. `settings` are
  /// "NAME=VALUE" of Blender's scene.cycles.
  Cycles(const std::string& blender, const std::string& folder, int threads,
         const std::vector<std::string>& settings);
  Cycles(const Cycles&) = delete;
  Cycles& operator=(const Cycles&) = delete;
  ~Cycles();

  /// Blender's version, "3.4.1".
  const std::string& version() const { return version_; }
  /// Renders to an EXR; the seconds are those that Cycles states for rendering, without the synchronisation
  /// of the scene and the building of its BVH, exact to 0.01.
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
