#pragma once
// The tables in scenes/README.md of what materials, lights and shapes have, with the values of what a scene
// file leaves out.

#include <string>

namespace candela {

/// Markdown: one row a value, with the types that look at it.
std::string materials_markdown();
std::string lights_markdown();
std::string shapes_markdown();

} // namespace candela
