#include "io/images/panorama_reader.h"

#include "io/files/apart.h"
#include "io/images/image_codec.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace candela {

namespace {

constexpr float kLargestRadiance = 1e9f;

void make_radiance(Image& image, const Location& where, WarningList& warnings) {
  make_finite(image, where, warnings);
  bool changed = false;
  for (vec3& pixel : image.pixels)
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp(pixel[c], 0.0f, kLargestRadiance);
      changed |= value != pixel[c];
      pixel[c] = value;
    }
  if (changed) warnings.add(where, "values below 0 or above 1e9 are taken for 0 or 1e9");
}

} // namespace

std::shared_ptr<const Panorama> read_panorama(std::span<const std::string> paths, WarningList& warnings) {
  auto panorama = std::make_shared<Panorama>();
  Image& all = panorama->image;
  for (const std::string& path : paths) {
    warnings.check_stop();
    auto bytes = std::make_shared<const Bytes>(read_file_bytes(path, "image", &warnings.progress()));
    ProgressPart progress = warnings.part(path, bytes->size());
    Image image = run_apart(&progress, &warnings, [bytes, path](ProgressPart* part, WarningList* said) {
      Image decoded = decode_image(*bytes, {path}, part, said);
      make_radiance(decoded, {path}, *said);
      return decoded;
    });
    if (panorama->sources.empty()) {
      panorama->name = std::filesystem::path(path).filename().string();
      check_image_size({path}, image.width, std::int64_t{image.height} * std::ssize(paths));
      all.width = image.width;
      if (paths.size() > 1) all.pixels.reserve(image.pixels.size() * paths.size());
    } else if (image.width != all.width ||
               image.height * static_cast<int>(panorama->sources.size()) != all.height) {
      throw input_error({path}, "panorama",
                        fmt::format("{} x {} pixels, where the first face has {} x {}", image.width,
                                    image.height, all.width,
                                    all.height / static_cast<int>(panorama->sources.size())),
                        "give six faces of one size");
    }
    all.height += image.height;
    if (paths.size() == 1) all.pixels = std::move(image.pixels);
    for (auto row = image.pixels.begin(); row != image.pixels.end(); row += image.width) {
      warnings.check_stop();
      all.pixels.insert(all.pixels.end(), row, row + image.width);
    }
    panorama->sources.push_back(path);
  }
  return panorama;
}

std::string mapping_problem(EnvironmentMapping mapping, int width, int height) {
  std::int64_t w = width, h = height;
  switch (mapping) {
  case EnvironmentMapping::latlong: return {};
  case EnvironmentMapping::angular:
    return w == h ? "" : fmt::format("an angular map is square, not {} x {}: it is stretched", w, h);
  case EnvironmentMapping::cross:
    return 3 * w == 4 * h || 4 * w == 3 * h
               ? ""
               : fmt::format("a cross has the proportions 4 : 3 or 3 : 4, not {} x {}: it is stretched", w,
                             h);
  case EnvironmentMapping::faces:
    return 6 * w == h ? ""
                      : fmt::format("a cube's faces are square, not {} x {}: they are stretched", w, h / 6.0);
  }
  return {};
}

EnvironmentMapping likely_mapping(const Image& image) {
  using enum EnvironmentMapping;
  for (EnvironmentMapping mapping : {angular, cross, faces})
    if (mapping_problem(mapping, image.width, image.height).empty()) return mapping;
  return latlong;
}

std::size_t set_environment(SceneDesc& scene, std::shared_ptr<const Panorama> panorama,
                            std::size_t preferred) {
  auto& lights = scene.lights;
  auto is_environment = [](const LightDesc& l) {
    return std::holds_alternative<EnvironmentLightModel>(l.model);
  };
  // A lamp that shows a picture shows another one; one that may have a profile instead does not begin to.
  if (preferred < lights.size() && !is_environment(lights[preferred]) && takes_panorama(lights[preferred]) &&
      (light_panorama(lights[preferred]) || !takes_profile(lights[preferred]))) {
    set_panorama(lights[preferred], std::move(panorama));
    return preferred;
  }
  auto is_constant = [](const LightDesc& l) { return std::holds_alternative<ConstantLightModel>(l.model); };
  auto light = std::ranges::find_if(lights, is_environment);
  if (preferred < lights.size() && is_environment(lights[preferred]))
    light = lights.begin() + static_cast<std::ptrdiff_t>(preferred);
  if (light == lights.end()) light = std::ranges::find_if(lights, is_constant);
  if (light == lights.end()) {
    LightDesc fresh;
    fresh.name = "environment";
    light = lights.insert(lights.end(), fresh);
  }
  if (!is_environment(*light)) {
    light->color = vec3(1), light->scale = 1, light->temperature = 0;
    light->model = EnvironmentLightModel{};
  }
  auto& model = std::get<EnvironmentLightModel>(light->model);
  model.mapping = likely_mapping(panorama->image);
  model.panorama = std::move(panorama);
  return static_cast<std::size_t>(light - lights.begin());
}

} // namespace candela
