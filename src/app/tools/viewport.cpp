#include "app/tools/viewport.h"

#include <algorithm>

namespace candela {

PixelRect letterbox(const PixelRect& region, ivec2 film) {
  const double zoom = std::min(static_cast<double>(std::max(region.width, 1)) / film.x,
                               static_cast<double>(std::max(region.height, 1)) / film.y);
  PixelRect rect;
  rect.width = std::max(1, static_cast<int>(std::lround(zoom * film.x)));
  rect.height = std::max(1, static_cast<int>(std::lround(zoom * film.y)));
  rect.x = region.x + (region.width - rect.width) / 2;
  rect.y = region.y + (region.height - rect.height) / 2;
  return rect;
}

PixelRect centered(const PixelRect& region, ivec2 film) {
  return {region.x + (region.width - film.x) / 2, region.y + (region.height - film.y) / 2, film.x, film.y};
}

ivec2 view_shape(ivec2 film, float aspect) {
  return aspect > 0
             ? ivec2(std::max(1, static_cast<int>(std::lround(static_cast<float>(film.y) * aspect))), film.y)
             : film;
}

ivec2 fitted_film(ivec2 window, float aspect) {
  const vec2 room(glm::max(window, ivec2(1)));
  if (!(aspect > 0)) return window;
  const vec2 size = room.x > room.y * aspect ? vec2(room.y * aspect, room.y) : vec2(room.x, room.x / aspect);
  return glm::max(ivec2(glm::round(size)), ivec2(1));
}

Viewport::Viewport(const Gl& gl) : gl_(gl) {
  filtered_ = make_program("picture_filtered");
  unfiltered_ = make_program("picture");
  gl_.GenVertexArrays(1, &vertex_array_); // the core profile never draws without one
  gl_.GenTextures(1, &texture_);
  gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &max_size_);
}

Viewport::~Viewport() {
  gl_.DeleteTextures(1, &texture_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  for (const Program& program : {filtered_, unfiltered_}) gl_.DeleteProgram(program.id);
}

Viewport::Program Viewport::make_program(const char* fragment_shader) const {
  Program program;
  program.id = build_program(gl_, "picture", fragment_shader);
  program.rectangle = gl_.GetUniformLocation(program.id, "rectangle");
  return program;
}

void Viewport::show(std::shared_ptr<const DisplayImage> image) {
  if (image == image_ || !image || image->width <= 0 || image->height <= 0) return;
  image_ = std::move(image);
  upload();
}

void Viewport::upload() {
  // A film may exceed the driver's texture size: then only every stride-th pixel is shown.
  const int stride = (std::max(image_->width, image_->height) + max_size_ - 1) / max_size_;
  const std::uint8_t* texels = image_->rgba.data();
  ivec2 size(image_->width, image_->height);
  std::vector<std::uint8_t> thinned;
  if (stride > 1) {
    const ivec2 full = size;
    size = full / stride;
    thinned.reserve(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const auto from = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) *
                                   static_cast<std::size_t>(full.x) +
                               static_cast<std::size_t>(x) * static_cast<std::size_t>(stride));
        thinned.insert(thinned.end(), texels + from, texels + from + 4);
      }
    texels = thinned.data();
  }
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (size == texture_size_)
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  else
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size.x, size.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
  texture_size_ = size;
  has_mipmaps_ = false;
}

void Viewport::draw(const PixelRect& where, ivec2 framebuffer_size) {
  if (!image_) return;
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  const bool shrinks = where.width < texture_size_.x;
  if (shrinks && !has_mipmaps_) gl_.GenerateMipmap(GL_TEXTURE_2D), has_mipmaps_ = true;
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, shrinks ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  const Program& program = shrinks ? filtered_ : unfiltered_;
  gl_.UseProgram(program.id);
  const vec2 pixel = 2.0f / vec2(framebuffer_size);
  gl_.Uniform4f(program.rectangle, static_cast<float>(where.x) * pixel.x - 1,
                1 - static_cast<float>(where.y + where.height) * pixel.y,
                static_cast<float>(where.width) * pixel.x, static_cast<float>(where.height) * pixel.y);
  gl_.BindVertexArray(vertex_array_);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_.BindVertexArray(0);
}

} // namespace candela
