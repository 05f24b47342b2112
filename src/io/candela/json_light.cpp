#include "io/candela/json_light.h"

#include "io/candela/json_fields.h"
#include "io/candela/json_profile.h"
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

/// Reads the files of one light, and of those inline.
class LightFiles {
public:
  LightFiles(LightDesc& light, const std::string& element, SceneBuilder& builder, const std::string& folder)
      : light_(light), element_(element), builder_(builder), folder_(folder) {}

  static bool is_file(std::string_view key) {
    return key == "file" || key == "files" || key == "image" || key == "profile";
  }
  void read(JsonValue key, JsonValue value) {
    if (key.string() == "profile")
      read_profile(key, value);
    else
      read_picture(key, value);
  }
  /// After all values: what of them does not go together.
  void check(std::optional<JsonValue> mapping) const {
    auto* environment = std::get_if<EnvironmentLightModel>(&light_.model);
    if (environment == nullptr || !picture_) return;
    if (files_ && !mapping) environment->mapping = EnvironmentMapping::faces;
    if (files_ && environment->mapping != EnvironmentMapping::faces)
      throw input_error(mapping->where(), element_ + ".mapping", "six files are the faces of a cube",
                        "give \"faces\", or one \"file\"");
    const Image& image = environment->panorama->image;
    auto problem = mapping_problem(environment->mapping, image.width, image.height);
    if (!problem.empty()) builder_.warnings().add(picture_->where(), problem);
  }

private:
  std::string name(JsonValue key) const { return fmt::format("{}.{}", element_, key.string()); }
  FoundFile found(JsonValue key, JsonValue value) const {
    return builder_.policy().require(read_string(value, name(key)), folder_, value.where(), name(key));
  }

  void read_profile(JsonValue key, JsonValue value) {
    if (!takes_profile(light_))
      throw input_error(value.where(), element_, "only a point or a spot light has a photometric file",
                        "say \"type\": \"point\" or \"spot\"");
    set_profile(light_, value.type() == JsonType::object ? read_json_profile(value, name(key))
                                                         : builder_.profile(found(key, value)));
  }

  void read_picture(JsonValue key, JsonValue value) {
    const bool of_faces = key.string() == "files";
    if (!takes_panorama(light_) || (of_faces && !std::holds_alternative<EnvironmentLightModel>(light_.model)))
      throw input_error(value.where(), element_,
                        of_faces ? "only an environment has six pictures"
                                 : "only an environment, a point and a projector have a picture",
                        of_faces ? "say \"type\": \"environment\"" : "say another \"type\"");
    if (picture_)
      throw input_error(key.where(), element_, "it has two pictures",
                        "keep one of \"file\", \"files\" and \"image\"");
    picture_ = value;
    if (key.string() == "file")
      set_panorama(light_, builder_.panorama({found(key, value)}));
    else if (of_faces)
      files_ = true,
      set_panorama(light_, builder_.panorama(read_faces(value, name(key), builder_.policy(), folder_)));
    else
      set_panorama(light_, read_inline(value, name(key), builder_.warnings()));
  }

  LightDesc& light_;
  const std::string& element_;
  SceneBuilder& builder_;
  const std::string& folder_;
  std::optional<JsonValue> picture_;
  bool files_ = false;
};

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
  std::vector<std::string_view> known = keys_of(light_fields(light), {"name", "type", "group"});
  if (takes_panorama(light))
    for (const char* key : {"file", "image"}) known.emplace_back(key);
  if (std::holds_alternative<EnvironmentLightModel>(light.model)) known.emplace_back("files");
  if (takes_profile(light)) known.emplace_back("profile");
  LightFiles files(light, element, builder, folder);
  std::optional<JsonValue> mapping;
  for (auto [key, value] : object.members()) {
    std::string name = fmt::format("{}.{}", element, key.string());
    if (key.string() == "type") continue;
    if (key.string() == "name") {
      light.name = read_string(value, name);
    } else if (key.string() == "group") {
      light.group = read_string(value, name);
    } else if (LightFiles::is_file(key.string())) {
      files.read(key, value);
    } else if (read_row(light_fields(light), light, key, value, element)) {
      if (key.string() == "mapping") mapping = value;
    } else if (read_for_other_types(kLightTypeCount, default_light,
                                    [&, &key = key, &value = value](LightDesc& other) {
                                      return read_row(light_fields(other), other, key, value, element);
                                    })) {
      builder.warnings().add(key.where(), fmt::format("{}: a light of the type {} has no such value", name,
                                                      light_type_name(light)));
    } else {
      throw unknown_key(key, element, known);
    }
  }
  files.check(mapping);
  if (const std::string problem = light_problem(light); !problem.empty())
    throw input_error(object.where(), element, problem.substr(0, problem.find("; ")),
                      problem.substr(problem.find("; ") + 2));
  return light;
}

LightGroup read_json_light_group(JsonValue object, const std::string& element) {
  LightGroup group;
  for (auto [key, value] : object.members())
    if (key.string() == "name")
      group.name = read_string(value, element + ".name");
    else if (!read_row(light_group_fields(), group, key, value, element))
      throw unknown_key(key, element, keys_of(light_group_fields(), {"name"}));
  return group;
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
