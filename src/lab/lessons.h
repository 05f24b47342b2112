#pragma once

#include <span>
#include <string_view>

namespace candela {

struct LessonInfo {
  std::string_view name; ///< on the command line
  std::string_view title;
  std::string_view look_at; ///< one line: what to observe
};

/// Every lesson: pi, solid-angle, integral, points, warps, brdf, medium, lens.
std::span<const LessonInfo> lessons();
/// The lesson of this name, which must exist.
const LessonInfo& lesson(std::string_view name);

} // namespace candela
