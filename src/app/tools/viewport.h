#pragma once
// The picture: one texture, one quad. Where it lies in the framebuffer is decided here too, so that a mouse
// position can be turned into a film position by the same numbers that drew it.

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

/// The film at one screen pixel a film pixel, centred on the middle of `region`.
PixelRect centered(const PixelRect& region, ivec2 film);

/// The film as it is to look on the screen: `aspect` times as wide as high, or with square pixels if it is 0.
ivec2 view_shape(ivec2 film, float aspect);

/// The film that fills the window with square pixels: of its size or, with an aspect above 0, as much of it
/// as that leaves.
ivec2 fitted_film(ivec2 window, float aspect);

class Viewport {
public:
  explicit Viewport(const Gl& gl);
  ~Viewport();
  Viewport(const Viewport&) = delete;
  Viewport& operator=(const Viewport&) = delete;

  /// Uploads the picture unless it is the one that is there already; keeps it alive.
  void show(std::shared_ptr<const DisplayImage> image);
  const std::shared_ptr<const DisplayImage>& shown() const { return image_; }

  /// Draws the picture at `where`: nearest where it is magnified, filtered where it shrinks.
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
