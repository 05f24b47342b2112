#pragma once
// Draws Dear ImGui's draw lists through the GL table.

#include "app/platform/gl.h"

struct ImDrawData;
struct ImFontAtlas;

namespace candela {

class ImguiDraw {
public:
  explicit ImguiDraw(const Gl& gl);
  ~ImguiDraw();
  ImguiDraw(const ImguiDraw&) = delete;
  ImguiDraw& operator=(const ImguiDraw&) = delete;

  /// (Re)builds the texture of the atlas; to be called before the frame that uses it.
  void upload_fonts(ImFontAtlas& atlas);

  /// Draws into the current framebuffer, whose size is the draw data's display size.
  void draw(const ImDrawData& data) const;

private:
  const Gl& gl_;
  GLuint program_ = 0;
  GLuint vertex_array_ = 0;
  GLuint vertices_ = 0;
  GLuint indices_ = 0;
  GLuint atlas_ = 0;
  GLint framebuffer_size_ = -1;
};

} // namespace candela
