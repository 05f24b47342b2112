#include "io/volumes/volume_reader.h"

#include "io/files/text_file.h"
#include "io/volumes/volume_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

struct VolumeFormat {
  bool (*is)(ByteView);
  VolumeGrid (*parse)(ByteView, const std::string&, WarningList&);
};
constexpr VolumeFormat kVolumeFormats[] = {{is_cvol, parse_cvol},
                                           {is_mitsuba_volume, parse_mitsuba_volume},
                                           {is_openvdb, parse_openvdb},
                                           {is_nanovdb, parse_nanovdb}};

/// How many of the values were no amounts, and now are 0.
std::size_t without_invalid(std::vector<float>& values) {
  std::size_t invalid = 0;
  for (float& value : values)
    if (!(value >= 0 && std::isfinite(value))) value = 0, ++invalid;
  return invalid;
}

} // namespace

void check_volume_cells(const std::string& file, std::int64_t x, std::int64_t y, std::int64_t z) {
  if (x <= 0 || y <= 0 || z <= 0)
    throw input_error({file}, "cells", fmt::format("{} x {} x {} has no cell", x, y, z),
                      "give at least 1 along each axis");
  constexpr auto kMost = static_cast<std::int64_t>(VolumeGrid::kMaxCells);
  if (x > kMost || y > kMost / x || z > kMost / (x * y))
    throw limit_error({file}, "cells",
                      fmt::format("{} x {} x {} are more than the {} that are read", x, y, z, kMost),
                      "make the grid coarser, or crop it");
}

Bounds3 checked_volume_bounds(const std::string& file, glm::dvec3 lo, glm::dvec3 hi) {
  constexpr double kFar = 1e9;
  const Bounds3 bounds{vec3(lo), vec3(hi)};
  const bool near = glm::all(glm::lessThan(glm::abs(lo), glm::dvec3(kFar))) &&
                    glm::all(glm::lessThan(glm::abs(hi), glm::dvec3(kFar)));
  if (!near || !glm::all(glm::lessThan(bounds.lo, bounds.hi)))
    throw input_error({file}, "bounds", "they are no box within 1e9 units of the origin",
                      "give a lower corner below the upper one");
  return bounds;
}

void clean_volume_values(VolumeGrid& grid, const std::string& file, WarningList& warnings) {
  const auto check = [&](std::vector<float>& values, const char* name) {
    if (const std::size_t invalid = without_invalid(values); invalid > 0)
      warnings.add({file}, fmt::format("{}: {} of {} values are negative, infinite or undefined: taken for 0",
                                       name, invalid, values.size()));
    warnings.check_stop();
  };
  check(grid.density, "density");
  check(grid.temperature, "temperature");
  if (!grid.temperature.empty())
    if (const float most = *std::ranges::max_element(grid.temperature); most > 1) {
      for (float& value : grid.temperature) value /= most;
      warnings.add({file}, fmt::format("temperature: divided by the largest value, {:g}", most));
    }
  std::size_t invalid = 0;
  for (vec3& color : grid.color) {
    vec3 valid(0);
    for (int c = 0; c < 3; ++c)
      if (color[c] >= 0) valid[c] = std::min(color[c], 1.0f);
    if (!(valid == color)) color = valid, ++invalid;
  }
  if (invalid > 0)
    warnings.add({file}, fmt::format("color: {} of {} values are not in [0, 1]: moved into it", invalid,
                                     grid.color.size()));
}

bool is_volume_name(std::string_view path) {
  return std::ranges::find(kVolumeEndings, lower_ending(path)) != std::end(kVolumeEndings);
}

VolumeGrid parse_volume(ByteView bytes, const std::string& file, WarningList& warnings) {
  for (const VolumeFormat& format : kVolumeFormats) {
    if (!format.is(bytes)) continue;
    VolumeGrid grid = format.parse(bytes, file, warnings);
    clean_volume_values(grid, file, warnings);
    grid.source = file;
    if (const std::string problem = volume_grid_problem(grid); !problem.empty()) {
      const std::size_t colon = problem.find(": "), semicolon = problem.find("; ");
      throw input_error({file}, problem.substr(0, colon), problem.substr(colon + 2, semicolon - colon - 2),
                        problem.substr(semicolon + 2));
    }
    return grid;
  }
  throw input_error({file}, "volume", "it is in no known format",
                    "give a .vdb, .nvdb or .cvol file, or one of Mitsuba's .vol");
}

std::shared_ptr<const VolumeGrid> read_volume(const std::string& path, WarningList& warnings) {
  const Bytes bytes = read_file_bytes(path, "volume", &warnings.progress());
  const ProgressPart part = warnings.part(path, bytes.size());
  return std::make_shared<const VolumeGrid>(parse_volume(bytes, path, warnings));
}

} // namespace candela
