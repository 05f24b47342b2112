#include "io/ini_job.h"

#include "io/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

namespace candela {

namespace fs = std::filesystem;

namespace {

/// The line without its comment, which begins with a ';' outside of quotes, as in Qt's QSettings.
std::string_view without_comment(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\')
      ++i; // skips the escaped character
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ';' && !quoted)
      return line.substr(0, i);
  }
  return line;
}

constexpr std::size_t kMaxIniBytes = std::size_t{1} << 20;
constexpr std::string_view kSections[] = {"IO", "Settings"};
constexpr std::string_view kIoKeys[] = {"scene", "output"};
constexpr std::string_view kSettingsKeys[] = {"imageWidth",         "imageHeight",
                                              "samplesPerPixel",    "pathContinuationProb",
                                              "directLightingOnly", "numDirectLightingSamples"};

class IniReader {
public:
  IniReader(const std::string& path, bool allow_outside, WarningList& warnings)
      : path_(path), allow_outside_(allow_outside),
        text_(read_text_file(path, "job", kMaxIniBytes, &warnings)) {}

  IniJob run() {
    std::string_view rest = text_;
    while (!rest.empty()) {
      std::size_t end = std::min(rest.find('\n'), rest.size());
      line(trimmed(without_comment(rest.substr(0, end))));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (scene_.empty())
      throw input_error({path_, 1, 1}, "scene", "the job names no scene", "add scene = FILE to [IO]");
    IniJob job;
    job.scene = find_scene();
    job.output = output_;
    // As in the assignment's reference pictures, which are 2/3 of a stop darker than the radiance of their
    // scenes.
    document_.settings.display.tone_map = ToneMap::reinhard;
    document_.settings.display.exposure = -0.65f;
    job.settings = document_.settings;
    return job;
  }

private:
  Location at(std::string_view part) const {
    return locate(path_, text_, static_cast<std::size_t>(part.data() - text_.data()));
  }

  void line(std::string_view text) {
    if (text.empty() || text.front() == '#') return;
    if (text.front() == '[') return section(text);
    auto equals = text.find('=');
    if (equals == std::string_view::npos)
      throw input_error(at(text), "job", "the line is neither [section] nor key = value",
                        "write key = value");
    std::string_view key = trimmed(text.substr(0, equals)), value = trimmed(text.substr(equals + 1));
    if (value.empty()) value = text.substr(text.size()); // so that the location of an empty value is valid
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    auto names = keys();
    if (std::ranges::find(names, key) == names.end()) {
      std::string near = nearest_name(key, names);
      throw input_error(at(text), section_.empty() ? "job" : section_,
                        fmt::format("there is no key '{}'", key.substr(0, 60)),
                        near.empty() ? fmt::format("the keys are {}", fmt::join(names, ", "))
                                     : fmt::format("did you mean {}?", near));
    }
    if (!seen_.insert(std::string(key)).second)
      throw input_error(at(text), key, "it is here a second time", "keep one of them");
    if (value.empty()) throw input_error(at(value), key, "it has no value", "write key = value");
    entry(key, value);
  }

  std::span<const std::string_view> keys() const {
    if (section_ == "IO") return kIoKeys;
    if (section_ == "Settings") return kSettingsKeys;
    return {};
  }

  void section(std::string_view text) {
    std::string_view name =
        text.ends_with(']') ? trimmed(text.substr(1, text.size() - 2)) : std::string_view();
    if (std::ranges::find(kSections, name) == std::end(kSections))
      throw input_error(at(text), "job", fmt::format("there is no section {}", text.substr(0, 60)),
                        "the sections are [IO] and [Settings]");
    section_ = name;
  }

  void entry(std::string_view key, std::string_view value) {
    PathSettings& p = document_.settings.path;
    if (key == "scene")
      scene_ = value;
    else if (key == "output")
      output_ = value;
    else if (key == "imageWidth")
      set("film.width", key, value);
    else if (key == "imageHeight")
      set("film.height", key, value);
    else if (key == "samplesPerPixel") {
      set("stop.spp", key, value);
      if (document_.settings.stop.spp == 0) // 0 would mean: never stop
        throw input_error(at(value), key, "0 samples make no picture", "give an integer from 1");
    } else if (key == "pathContinuationProb") {
      set("path.rr_probability", key, value);
      p.rr = RussianRoulette::fixed, p.rr_depth = 1;
    } else if (key == "directLightingOnly") {
      std::string word(value);
      for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      const bool only = word == "true" || word == "1";
      if (!only && word != "false" && word != "0")
        throw input_error(at(value), key, fmt::format("'{}' does not fit", value.substr(0, 60)),
                          "give true or false");
      p.max_depth = only ? 2 : -1;
    } else {
      set("path.light_samples", key, value);
    }
  }

  /// Sets a row of the settings table and checks its range.
  void set(std::string_view setting, std::string_view key, std::string_view value) {
    const auto* row = find_setting(setting);
    try {
      field_from_text(*row, row->address(document_), value);
    } catch (const Error&) { // a usage error without a location
      throw input_error(at(value), key, fmt::format("'{}' does not fit", value.substr(0, 60)),
                        fmt::format("give {}", field_domain(*row)));
    }
  }

  FoundFile find_scene() const {
    constexpr int kMaxLevels = 4;
    constexpr std::string_view kUsualFolder = "example-scenes/";
    std::string name(scene_);
    std::replace(name.begin(), name.end(), '\\', '/');
    fs::path parts(name);
    bool goes_up = std::ranges::find(parts, fs::path("..")) != parts.end();
    if (!allow_outside_ && (parts.is_absolute() || goes_up))
      throw input_error(at(scene_), "scene", fmt::format("'{}' may lie outside the job's folder tree", name),
                        "name it without a leading / and without .., or allow it with --allow-outside");
    std::vector<std::string> names = {name};
    if (name.starts_with(kUsualFolder)) names.push_back(name.substr(kUsualFolder.size()));
    std::string folder = folder_of(path_);
    std::vector<std::string> tried;
    for (int level = 0; level <= kMaxLevels; ++level, folder += "/..") {
      PathPolicy policy(folder, allow_outside_);
      for (const std::string& candidate : names) {
        if (candidate.empty()) continue;
        if (auto found = policy.find(candidate, folder, at(scene_), "scene")) return *found;
        tried.push_back((fs::path(folder) / candidate).lexically_normal().string());
      }
    }
    throw input_error(at(scene_), "scene",
                      fmt::format("there is no file '{}' (tried {})", name, fmt::join(tried, ", ")),
                      "put the scene into one of these places");
  }

  std::string path_;
  bool allow_outside_;
  std::string text_;
  std::string_view scene_; ///< points into text_
  std::string output_;
  std::string section_;
  std::set<std::string> seen_;
  Document document_;
};

} // namespace

IniJob read_ini_job(const std::string& path, bool allow_outside, WarningList& warnings) {
  return IniReader(path, allow_outside, warnings).run();
}

} // namespace candela
