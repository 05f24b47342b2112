#include "app/platform/imgui_draw.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace candela {

namespace {

const void* offset_pointer(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

ImTextureID texture_id(GLuint texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

} // namespace

ImguiDraw::ImguiDraw(const Gl& gl) : gl_(gl) {
  program_ = build_program(gl_, "ui", "ui");
  framebuffer_size_ = gl_.GetUniformLocation(program_, "framebuffer_size");
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &vertices_);
  gl_.GenBuffers(1, &indices_);
  gl_.GenTextures(1, &atlas_);

  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  constexpr GLsizei stride = sizeof(ImDrawVert);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset_pointer(offsetof(ImDrawVert, pos)));
  gl_.EnableVertexAttribArray(1);
  gl_.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset_pointer(offsetof(ImDrawVert, uv)));
  gl_.EnableVertexAttribArray(2);
  gl_.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset_pointer(offsetof(ImDrawVert, col)));
  gl_.BindVertexArray(0);
}

ImguiDraw::~ImguiDraw() {
  gl_.DeleteTextures(1, &atlas_);
  gl_.DeleteBuffers(1, &indices_);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteProgram(program_);
}

void ImguiDraw::upload_fonts(ImFontAtlas& atlas) {
  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  atlas.GetTexDataAsRGBA32(&texels, &width, &height);
  gl_.BindTexture(GL_TEXTURE_2D, atlas_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  atlas.SetTexID(texture_id(atlas_));
  atlas.ClearTexData(); // the context has the pixels now
}

void ImguiDraw::draw(const ImDrawData& data) const {
  const ImVec2 size = data.DisplaySize;
  if (size.x < 1 || size.y < 1) return; // minimised
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.UseProgram(program_);
  gl_.Uniform2f(framebuffer_size_, size.x, size.y);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);

  constexpr GLenum index_type = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    gl_.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                   GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr) continue; // no panel uses one
      const ImVec4 clip = command.ClipRect;
      const int left = std::max(0, static_cast<int>(clip.x));
      const int right = std::min(static_cast<int>(size.x), static_cast<int>(clip.z));
      const int top = std::max(0, static_cast<int>(clip.y));
      const int bottom = std::min(static_cast<int>(size.y), static_cast<int>(clip.w));
      if (right <= left || bottom <= top) continue;
      gl_.Scissor(left, static_cast<int>(size.y) - bottom, right - left, bottom - top); // y grows upwards
      const auto texture = static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
      gl_.BindTexture(GL_TEXTURE_2D, texture);
      gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), index_type,
                                 offset_pointer(command.IdxOffset * sizeof(ImDrawIdx)),
                                 static_cast<GLint>(command.VtxOffset));
    }
  }
  gl_.BindVertexArray(0);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_BLEND);
}

} // namespace candela
