#pragma once
// Pictures as GL textures.

#include "app/platform/gl.h"
#include "core/math.h"

#include <cstdint>

namespace candela {

/// Four bytes a pixel, row after row, into a texture that is clamped at its edges and looked up with these
/// filters; leaves it bound. The pixels are not asked for after the call.
inline void upload_rgba8(const Gl& gl, GLuint texture, ivec2 size, const std::uint8_t* rgba, GLint minified,
                         GLint magnified) {
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minified);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnified);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

} // namespace candela
