#pragma once
// Which pass renderer renders: one that is better where it can, else the CPU.

#include "render/film/pass_renderer.h"

#include <memory>

namespace candela {

/// `threads` of the CPU, 0: every core.
std::unique_ptr<PassRenderer> make_pass_renderer(int threads);

} // namespace candela
