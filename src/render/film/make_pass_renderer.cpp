#include "render/film/make_pass_renderer.h"

#include "render/film/cpu_pass_renderer.h"

namespace candela {

std::unique_ptr<PassRenderer> make_pass_renderer(int threads) {
  return std::make_unique<CpuPassRenderer>(threads);
}

} // namespace candela
