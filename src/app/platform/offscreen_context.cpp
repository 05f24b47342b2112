#include "app/platform/offscreen_context.h"

#include "core/error.h"

#include <fmt/format.h>

#include <dlfcn.h>

namespace candela {

namespace {

Error no_context(std::string_view cause) {
  return Error(ExitCode::display,
               fmt::format("display: nothing can be drawn without one: {}: install libosmesa6", cause));
}

template <class Function>
void find(void* library, Function& function, const char* name) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw no_context(fmt::format("libOSMesa has no {}", name));
}

} // namespace

OffscreenContext::OffscreenContext() {
  library_ = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw no_context("libOSMesa.so.8 is missing");
  void* (*create)(const int*, void*) = nullptr;
  static void* (*get_proc)(const char*) = nullptr; // load_gl() takes a plain function pointer
  find(library_, create, "OSMesaCreateContextAttribs");
  find(library_, make_current_, "OSMesaMakeCurrent");
  find(library_, destroy_, "OSMesaDestroyContext");
  find(library_, get_proc, "OSMesaGetProcAddress");
  // From GL/osmesa.h: format RGBA, profile core, version 3.3.
  const int attributes[] = {0x22, GL_RGBA, 0x33, 0x34, 0x36, 3, 0x37, 3, 0};
  context_ = create(attributes, nullptr);
  if (context_ == nullptr) throw no_context("OSMesa made no OpenGL 3.3 core context");
  resize({1, 1});
  gl_ = load_gl([](const char* name) { return get_proc(name); });
}

OffscreenContext::~OffscreenContext() {
  destroy_(context_);
} // the library stays loaded: its threads outlive the context

void OffscreenContext::resize(ivec2 size) {
  size_ = size;
  memory_.assign(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0);
  if (make_current_(context_, memory_.data(), GL_UNSIGNED_BYTE, size.x, size.y) == 0)
    throw no_context(fmt::format("OSMesa draws no {} x {} pixels", size.x, size.y));
}

std::vector<std::uint8_t> OffscreenContext::pixels() const {
  std::vector<std::uint8_t> bottom_up(memory_.size()), out;
  gl_.Finish();
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, size_.x, size_.y, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
  const auto row = static_cast<std::ptrdiff_t>(4 * size_.x);
  for (int y = size_.y - 1; y >= 0; --y)
    out.insert(out.end(), bottom_up.begin() + y * row, bottom_up.begin() + (y + 1) * row);
  return out;
}

} // namespace candela
