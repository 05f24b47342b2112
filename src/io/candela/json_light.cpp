#include "io/candela/json_light.h"

#include "io/candela/json_fields.h"
#include "io/images/panorama_reader.h"

#include <fmt/format.h>

namespace candela {

namespace {

std::shared_ptr<const Panorama> read_inline(JsonValue object, const std::string& element,
                                            const WarningList& warnings) {
  constexpr std::string_view kKeys[] = {"name", "width", "height", "pixels"};
  constexpr int kMaxSide = 65536;
  auto panorama = std::make_shared<Panorama>();
  Image& image = panorama->image;
  std::optional<JsonValue> pixels;
  expect(object, JsonType::object, element);
  for (auto [key, value] : object.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "name")
      panorama->name = read_string(value, name);
    else if (key.string() == "width")
      image.width = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "height")
      image.height = read_integer(value, name, 1, kMaxSide);
    else if (key.string() == "pixels")
      pixels = value;
    else
      throw unknown_key(key, element, kKeys);
  }
  auto due = 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (!pixels || pixels->type() != JsonType::array || due == 0 || pixels->size() != due)
    throw input_error((pixels ? *pixels : object).where(), element, "it is no picture",
                      "give width, height and 3 width height numbers as \"pixels\"");
  std::string name = element + ".pixels";
  image.pixels.reserve(due / 3);
  int channel = 0;
  for (JsonValue value : *pixels) {
    warnings.check_stop();
    float v = read_real(value, name);
    if (v < 0) throw input_error(value.where(), name, fmt::format("{} is negative", v), "give radiances");
    if (channel == 0) image.pixels.emplace_back(0);
    image.pixels.back()[channel] = v;
    channel = (channel + 1) % 3;
  }
  return panorama;
}

/// Reads "files".
std::vector<FoundFile> read_faces(JsonValue array, const std::string& element, const PathPolicy& policy,
                                  const std::string& folder) {
  expect(array, JsonType::array, element);
  if (array.size() != 6)
    throw input_error(array.where(), element, fmt::format("{} files", array.size()),
                      "give the six faces of a cube: +x, -x, +y, -y, +z, -z");
  std::vector<FoundFile> files;
  for (JsonValue value : array)
    files.push_back(policy.require(read_string(value, element), folder, value.where(), element));
  return files;
}

} // namespace

LightDesc read_json_light(JsonValue object, const std::string& element, SceneBuilder& builder,
                          const std::string& folder) {
  LightDesc light;
  for (auto [key, value] : object.members()) // first, because the other keys depend on it
    if (key.string() == "type") {
      int type = 0;
      read_field(light_type_field(), &type, value, element + ".type");
      light = default_light(type);
    }
  auto* environment = std::get_if<EnvironmentLightModel>(&light.model);
  std::vector<std::string_view> known = keys_of(light_fields(light), {"name", "type"});
  if (environment != nullptr) known.insert(known.end(), {"file", "files", "image"});
  std::optional<JsonValue> mapping, picture, files;
  for (auto [key, value] : object.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "type") continue;
    if (key.string() == "name") {
      light.name = read_string(value, name);
    } else if (key.string() == "file" || key.string() == "files" || key.string() == "image") {
      if (environment == nullptr)
        throw input_error(value.where(), element, "only an environment has a picture",
                          "say \"type\": \"environment\"");
      if (picture)
        throw input_error(key.where(), element, "it has two panoramas",
                          "keep one of \"file\", \"files\" and \"image\"");
      picture = value;
      if (key.string() == "file")
        environment->panorama = builder.panorama(
            {builder.policy().require(read_string(value, name), folder, value.where(), name)});
      else if (key.string() == "files")
        files = key,
        environment->panorama = builder.panorama(read_faces(value, name, builder.policy(), folder));
      else
        environment->panorama = read_inline(value, name, builder.warnings());
    } else if (read_row(light_fields(light), light, key, value, element)) {
      if (key.string() == "mapping") mapping = value;
    } else if (read_for_other_types(kLightTypeCount, default_light, [&](LightDesc& other) {
                 return read_row(light_fields(other), other, key, value, element);
               })) {
      builder.warnings().add(key.where(), fmt::format("{}: a light of the type {} has no such value", name,
                                                      light_type_name(light)));
    } else {
      throw unknown_key(key, element, known);
    }
  }
  if (files && !mapping) environment->mapping = EnvironmentMapping::faces;
  if (files && environment->mapping != EnvironmentMapping::faces)
    throw input_error(mapping->where(), element + ".mapping", "six files are the faces of a cube",
                      "give \"faces\", or one \"file\"");
  if (const std::string problem = light_problem(light); !problem.empty())
    throw input_error(object.where(), element, problem.substr(0, problem.find("; ")),
                      problem.substr(problem.find("; ") + 2));
  if (environment != nullptr && environment->panorama) {
    const Image& image = environment->panorama->image;
    auto problem = mapping_problem(environment->mapping, image.width, image.height);
    if (!problem.empty()) builder.warnings().add(picture->where(), problem);
  }
  return light;
}

std::string json_panorama_member(const Panorama& panorama) {
  const Image& image = panorama.image;
  std::string out = fmt::format("\"image\": {{\"name\": {}, \"width\": {}, \"height\": {}, \"pixels\": [",
                                json_quoted(panorama.name), image.width, image.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    out +=
        fmt::format("{}{},{},{}", i > 0 ? "," : "", image.pixels[i].x, image.pixels[i].y, image.pixels[i].z);
  return out + "]}";
}

} // namespace candela
