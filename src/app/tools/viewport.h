#pragma once
// The picture: one texture on one quad. Its rectangle in the framebuffer is computed here, too, so that mouse
// positions map to film positions exactly as drawn.

#include "app/platform/gl.h"
#include "core/math.h"
#include "session/render_session.h"

#include <optional>

namespace candela {

/// Pixels of the framebuffer, origin at the top left.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const PixelRect&) const = default;
};

/// The largest rectangle of the film's aspect that fits into `region`, centred.
PixelRect letterbox(const PixelRect& region, ivec2 film);

/// The film at one screen pixel per film pixel, centred in `region`.
PixelRect centered(const PixelRect& region, ivec2 film);

/// The displayed proportions of the film: `aspect` is width over height; 0: square pixels.
ivec2 view_shape(ivec2 film, float aspect);

/// The size of a film with square pixels that fills the window, restricted to `aspect` if that is above 0.
ivec2 fitted_film(ivec2 window, float aspect);

class Viewport {
public:
  explicit Viewport(const Gl& gl);
  ~Viewport();
  Viewport(const Viewport&) = delete;
  Viewport& operator=(const Viewport&) = delete;

  /// Uploads the picture unless it already is; keeps it alive.
  void show(std::shared_ptr<const DisplayImage> image);
  const std::shared_ptr<const DisplayImage>& shown() const { return image_; }

  /// Draws the picture at `where`: nearest texel if magnified, filtered if reduced.
  void draw(const PixelRect& where, ivec2 framebuffer_size);

private:
  void upload();

  struct Program {
    GLuint id = 0;
    GLint rectangle = -1;
  };
  Program make_program(const char* fragment_shader) const;

  const Gl& gl_;
  Program filtered_, unfiltered_;
  GLuint vertex_array_ = 0;
  GLuint texture_ = 0;
  GLint max_size_ = 0;
  ivec2 texture_size_{0};
  bool has_mipmaps_ = false;
  std::shared_ptr<const DisplayImage> image_;
};

} // namespace candela
