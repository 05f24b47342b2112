#include "io/picture_state.h"

#include "core/hash.h"
#include "io/candela/candela_json.h"
#include "io/candela/json_fields.h"
#include "io/files/apart.h"
#include "io/files/file_bytes.h"
#include "io/files/text_file.h"
#include "io/images/image_codec.h"
#include "scene/scene_files.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <set>

namespace candela {

namespace fs = std::filesystem;

namespace {

constexpr const char* kScene = "candela.scene";
constexpr const char* kFiles = "candela.files";
constexpr const char* kCrop = "candela.crop";

/// A hash of a file's content. It is not cryptographic: it detects edited files, and cannot be guessed
/// without knowing the content.
std::string content_hash(ByteView bytes, const Progress* progress = nullptr) {
  std::uint64_t hash = bytes.size(), word = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (progress && i % 4096 == 0) progress->check();
    word = word << 8 | bytes[i];
    if (i % 8 == 7) hash = hash_combine(hash, word), word = 0;
  }
  return fmt::format("{:016x}", hash_combine(hash, word));
}

std::string file_list(const SceneDesc& scene, const std::string& folder) {
  std::error_code failed;
  const fs::path base = fs::weakly_canonical(fs::absolute(folder), failed);
  std::string list;
  for (const std::string& source : source_files(scene)) {
    const fs::path file = fs::weakly_canonical(fs::absolute(source), failed);
    if (failed || !fs::is_regular_file(file, failed)) continue;
    const Bytes bytes = read_file_bytes(file.string(), "scene");
    list += fmt::format("{}\n  {{\"path\": {}, \"bytes\": {}, \"hash\": \"{}\"}}", list.empty() ? "" : ",",
                        json_quoted(file.lexically_relative(base).generic_string()), bytes.size(),
                        content_hash(bytes));
  }
  return list.empty() ? "" : fmt::format("[{}\n]\n", list);
}

/// Compares the files with their recorded content; unchanged ones may be opened wherever they are.
void check_files(const std::string& list, const std::string& path, PathPolicy& policy,
                 WarningList& warnings) {
  const Location where{fmt::format("{} ({})", path, kFiles)};
  const JsonTree tree(where.file, list);
  expect(tree.root(), JsonType::array, "files");
  std::set<std::string> seen;
  for (JsonValue entry : tree.root()) {
    expect(entry, JsonType::object, "files");
    std::string name, hash;
    int bytes = -1;
    for (auto [key, value] : entry.members()) {
      if (key.string() == "path") name = read_string(value, "files.path");
      if (key.string() == "hash") hash = read_string(value, "files.hash");
      if (key.string() == "bytes")
        bytes = read_integer(value, "files.bytes", 0, std::numeric_limits<int>::max());
    }
    if (!seen.insert(name).second) continue;
    std::error_code failed;
    const fs::path file = fs::weakly_canonical(fs::absolute(fs::path(folder_of(path)) / name), failed);
    if (failed || bytes < 0 || !fs::is_regular_file(file, failed)) continue; // the scene's reader reports it
    const auto size = fs::file_size(file, failed);
    if (!failed && size == static_cast<std::uintmax_t>(bytes) &&
        content_hash(read_file_bytes(file.string(), "scene", &warnings.progress()), &warnings.progress()) ==
            hash)
      policy.admit(file.string());
    else
      warnings.add({path}, fmt::format("{} is not what it was when the picture was made", name));
  }
}

PictureCrop parse_crop(const std::string& text, const FilmSettings& film, const std::string& path) {
  int values[4] = {};
  const char* at = text.data();
  const char* end = at + text.size();
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    auto [next, status] = std::from_chars(at, end, values[i]);
    good = status == std::errc() && (i == 3 ? next == end : next != end && *next == ',');
    at = next + 1;
  }
  const PictureCrop crop{values[0], values[1], values[2], values[3]};
  if (!good || crop.x < 0 || crop.y < 0 || crop.width < 1 || crop.height < 1 ||
      crop.width > film.width - crop.x || crop.height > film.height - crop.y)
    throw input_error({path}, kCrop, fmt::format("'{}' is no part of the film", text.substr(0, 60)),
                      "save the picture again");
  return crop;
}

/// The texts stored in a picture.
struct PictureTexts {
  std::optional<std::string> scene, files, crop;
};

PictureTexts texts_of(ByteView bytes, const std::string& path) {
  const Location where{path};
  if (is_png(bytes))
    check_png(bytes, where);
  else if (!is_exr(bytes))
    throw input_error(where, "picture", "it is neither PNG nor EXR", "give a picture that Candela saved");
  auto find = [&](const char* name) {
    return is_png(bytes) ? png_text(bytes, name, where) : exr_text(bytes, name, where);
  };
  return {find(kScene), find(kFiles), find(kCrop)};
}

} // namespace

ImageMetadata picture_state_texts(const PictureState& state, const std::string& path) {
  Document document = state.document;
  document.settings.stop = {};
  document.settings.stop.spp = state.spp;
  const std::string folder = folder_of(path);
  ImageMetadata texts{{kScene, candela_json(document, folder)}};
  if (texts[kScene].size() > kMaxPictureText) return {};
  if (std::string files = file_list(document.scene, folder); !files.empty()) texts[kFiles] = std::move(files);
  if (state.crop)
    texts[kCrop] =
        fmt::format("{},{},{},{}", state.crop->x, state.crop->y, state.crop->width, state.crop->height);
  return texts;
}

bool holds_picture_state(const std::string& path) {
  return texts_of(read_file_bytes(path, "picture"), path).scene.has_value();
}

LoadedScene read_picture_state(const std::string& path, const ReadOptions& options, WarningList& warnings) {
  auto bytes = std::make_shared<const Bytes>(read_file_bytes(path, "picture", &warnings.progress()));
  ProgressPart progress = warnings.part(path, bytes->size());
  PictureTexts texts = run_apart(
      &progress, nullptr, [bytes, path](ProgressPart*, WarningList*) { return texts_of(*bytes, path); });
  if (!texts.scene)
    throw input_error({path}, "picture", "it holds no scene",
                      "give a PNG or EXR that Candela saved (without --no-state), or a scene");
  PathPolicy policy(folder_of(path), options.allow_outside);
  if (texts.files) check_files(*texts.files, path, policy, warnings);
  LoadedScene loaded;
  loaded.document = parse_candela_json(std::move(*texts.scene), path, policy, warnings);
  loaded.files = policy.asked();
  if (texts.crop) loaded.crop = parse_crop(*texts.crop, loaded.document.settings.film, path);
  return loaded;
}

} // namespace candela
