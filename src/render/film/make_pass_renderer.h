#pragma once
// Selection of the pass renderer: a better one if available, else the CPU.

#include "render/film/pass_renderer.h"

#include <memory>

namespace candela {

/// `threads` of the CPU, 0: every core.
std::unique_ptr<PassRenderer> make_pass_renderer(int threads);

} // namespace candela
