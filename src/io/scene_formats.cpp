#include "io/scene_formats.h"

#include "io/candela/candela_json.h"
#include "io/cs123/cs123_reader.h"
#include "io/files/text_file.h"
#include "io/obj_scene.h"

namespace candela {

namespace {

constexpr SceneFormat kFormats[] = {
    {".json", false, read_candela_json},
    {".obj", true, read_obj_scene},
    {".xml", false, read_cs123},
};

} // namespace

std::span<const SceneFormat> scene_formats() { return kFormats; }

const SceneFormat* scene_format(std::string_view path) {
  const std::string ending = lower_ending(path);
  for (const SceneFormat& format : kFormats)
    if (format.ending == ending) return &format;
  return nullptr;
}

std::string scene_endings(std::string_view separator) {
  std::string all;
  for (const SceneFormat& format : kFormats) {
    if (!all.empty()) all += separator;
    all += format.ending;
  }
  return all;
}

} // namespace candela
