#pragma once
// The tables of materials, lights, media, shapes and motion in scenes/README.md, with their default values.

#include <string>

namespace candela {

/// Markdown: one row per value, with the types that have it.
std::string materials_markdown();
std::string lights_markdown();
std::string media_markdown();
std::string phases_markdown();
std::string shapes_markdown();
std::string motion_markdown();

} // namespace candela
