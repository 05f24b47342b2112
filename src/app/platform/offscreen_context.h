#pragma once
// OpenGL without a display: OSMesa draws into memory. libOSMesa is opened at run time, because linking it
// together with libGL would replace libGL's functions.

#include "app/platform/gl.h"
#include "core/math.h"

#include <cstdint>
#include <vector>

namespace candela {

/// An OpenGL 3.3 core context that draws into memory, current on the thread that made it.
class OffscreenContext {
public:
  /// Creates a framebuffer of one pixel. An Error with ExitCode::display if libOSMesa or such a context is
  /// missing.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  void resize(ivec2 size);

  const Gl& gl() const { return gl_; }
  ivec2 size() const { return size_; }

  /// RGBA of the framebuffer, row 0 at the top.
  std::vector<std::uint8_t> pixels() const;

private:
  void* library_ = nullptr;
  void* context_ = nullptr;
  unsigned char (*make_current_)(void*, void*, unsigned, int, int) = nullptr;
  void (*destroy_)(void*) = nullptr;
  Gl gl_;
  ivec2 size_{0};
  std::vector<std::uint8_t> memory_;
};

} // namespace candela
