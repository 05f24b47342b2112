#pragma once
// A texture over the picture, as in an image editor: pan, zoom, channels, exposure, levels, values under the
// mouse. It is an overlay: the panels beside it stay in use, and edits are seen at once.

#include "app/panels/viewer_state.h"
#include "app/tools/texture_users.h"
#include "app/ui/widgets.h"
#include "app/viewer/texture_tiles.h"

namespace candela {

class TextureViewer {
public:
  /// As of Inspector.
  TextureViewer(const Gl& gl, std::function<void()> wake);
  ~TextureViewer();

  /// Draws into the free part of the window if state.texture_view is visible; hides it if its texture is
  /// gone.
  void draw(Ui& ui, ViewerState& state, vec2 position, vec2 room);
  /// Whether draw() would show something new.
  bool has_news() const { return worker_.has_completions(); }
  /// All that is visible has been drawn.
  bool complete() const { return shown_ && tiles_.complete() && !building_; }

  // For tests.
  const TextureTiles& tiles() const { return tiles_; }
  /// The unit square on the screen.
  GridRect unit_square() const { return unit_; }
  bool running() const { return worker_.pending() > 0; }
  /// The line about the value under the mouse; empty: there is none.
  const std::string& told() const { return told_; }

private:
  void close();
  void update_grid(const ViewerState& state, const TextureUser* user);
  void build_pyramid(const ImageTexture& image, ColorSpace space);
  void controls(Ui& ui, ViewerState& state, const std::vector<TextureUser>& users);
  void facts(Ui& ui, const ViewerState& state, const std::vector<TextureUser>& users);
  void canvas(Ui& ui, ViewerState& state, const TextureUser* user);
  void use_mouse(TextureViewState& view, vec2 lo, vec2 hi);
  void place(vec2 lo, vec2 hi);
  void fit(vec2 size, int copies);
  void draw_uv_layout(const ViewerState& state, const TextureUser* user, vec2 lo, vec2 hi);
  std::string value_text(const TextureUser* user, vec2 mouse) const;

  std::shared_ptr<const Texture> texture_; ///< of the last frame
  ColorSpace color_space_ = ColorSpace::srgb;
  std::shared_ptr<const MipPyramid> pyramid_;
  std::shared_ptr<const Texels> too_large_; ///< for a pyramid in this memory
  std::shared_ptr<Progress> building_;      ///< of the pyramid; null: none is built
  vec2 center_{0.5f};                       ///< coordinates in the middle of the canvas
  float zoom_ = 1;                          ///< framebuffer pixels along one unit of u
  float aspect_ = 1;                        ///< height over width of the unit square
  bool fits_ = true;                        ///< follows the size of the canvas
  bool shown_ = false;
  GridRect unit_;
  std::string told_;
  std::shared_ptr<const Mesh> layout_of_;
  std::vector<UvEdge> layout_;
  TextureTiles tiles_;
  TaskThread worker_; ///< last, so that it is destroyed first
};

} // namespace candela
