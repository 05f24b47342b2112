#include "app/viewer/preferences.h"

#include "core/error.h"
#include "io/files/atomic_file.h"
#include "io/files/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace candela {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kMaxPreferencesBytes = 1 << 20;
constexpr std::size_t kMaxRecent = 10, kMaxSections = 500, kMaxPath = 4096;

/// Deep nesting is refused: the parser recurses when the value is destroyed.
constexpr int kMaxDepth = 8;

/// Reads the valid members and collects the names of the others.
class Reader {
public:
  explicit Reader(const json& root) : root_(root) {}

  void boolean(const char* key, bool& value) {
    if (const json* found = find(key)) {
      if (found->is_boolean())
        value = found->get<bool>();
      else
        odd_.emplace_back(key);
    }
  }
  template <class Number>
  void number(const char* key, Number& value, double lo, double hi) {
    if (const json* found = find(key)) {
      if (const double read = found->is_number() ? found->get<double>() : lo - 1; read >= lo && read <= hi)
        value = static_cast<Number>(read);
      else
        odd_.emplace_back(key);
    }
  }
  const json* find(const char* key) const {
    const auto found = root_.find(key);
    return found == root_.end() ? nullptr : &*found;
  }
  void odd(const char* key) { odd_.emplace_back(key); }
  const std::vector<std::string>& odd() const { return odd_; }

private:
  const json& root_;
  std::vector<std::string> odd_;
};

bool is_path(const json& value) {
  return value.is_string() && value.get_ref<const std::string&>().size() <= kMaxPath &&
         fs::path(value.get_ref<const std::string&>()).is_absolute();
}

Preferences from_json(const json& root, std::vector<std::string>& odd) {
  Preferences p;
  Reader reader(root);
  reader.number("window_width", p.window.x, 64, 16384);
  reader.number("window_height", p.window.y, 64, 16384);
  reader.number("text_zoom", p.text_zoom, 0.5, 3);
  reader.number("speed_factor", p.speed_factor, 0.01, 100);
  reader.boolean("panels_visible", p.panels_visible);
  reader.boolean("overlays_visible", p.overlays_visible);
  if (const json* sections = reader.find("open_sections")) {
    bool good = sections->is_object() && sections->size() <= kMaxSections;
    if (good)
      for (const auto& [name, open] : sections->items()) {
        good &= open.is_boolean();
        if (open.is_boolean()) p.open_sections[name] = open.get<bool>();
      }
    if (!good) reader.odd("open_sections");
  }
  if (const json* recent = reader.find("recent")) {
    bool good = recent->is_array();
    if (good)
      for (const json& path : *recent) {
        good &= is_path(path);
        if (is_path(path) && p.recent.size() < kMaxRecent) p.recent.push_back(path.get<std::string>());
      }
    if (!good) reader.odd("recent");
  }
  odd = reader.odd();
  return p;
}

} // namespace

ivec2 size_at_scale_one(ivec2 framebuffer, float scale) { return glm::round(vec2(framebuffer) / scale); }

ivec2 size_at_scale(ivec2 size, float scale) { return glm::round(vec2(size) * scale); }

fs::path default_preferences_path() {
  auto folder = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value != nullptr && fs::path(value).is_absolute() ? fs::path(value) : fs::path();
  };
  fs::path config = folder("XDG_CONFIG_HOME"); // a relative one is to be ignored, says its specification
  if (config.empty() && !folder("HOME").empty()) config = folder("HOME") / ".config";
  return config.empty() ? config : config / "candela" / "preferences.json";
}

Preferences read_preferences(const fs::path& path, std::string& warning) {
  std::error_code failed;
  if (!fs::exists(path, failed)) return {};
  try {
    const std::string text = read_text_file(path.string(), "preferences", kMaxPreferencesBytes);
    auto not_too_deep = [](int depth, json::parse_event_t, json&) {
      if (depth > kMaxDepth) throw std::length_error("nested too deeply");
      return true;
    };
    const json root = json::parse(text, not_too_deep);
    if (!root.is_object()) throw std::invalid_argument("is no JSON object");
    std::vector<std::string> odd;
    Preferences preferences = from_json(root, odd);
    if (!odd.empty())
      warning = fmt::format("{}: the values of {} are invalid and ignored: the file will be rewritten",
                            path.string(), fmt::join(odd, ", "));
    return preferences;
  } catch (const std::exception& error) { // an Error of the file, or the JSON library's
    warning = fmt::format("{}: the preferences are not used ({}): they will be written anew", path.string(),
                          error.what());
    return {};
  }
}

void write_preferences(const Preferences& p, const fs::path& path) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed); // an error is reported when the file is written
  const json root = {{"window_width", p.window.x},         {"window_height", p.window.y},
                     {"text_zoom", p.text_zoom},           {"speed_factor", p.speed_factor},
                     {"panels_visible", p.panels_visible}, {"overlays_visible", p.overlays_visible},
                     {"open_sections", p.open_sections},   {"recent", p.recent}};
  // A path need not be UTF-8: invalid bytes are written as U+FFFD rather than refused.
  write_file_atomically(path.string(), root.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

void add_recent(Preferences& preferences, const std::string& path) {
  std::error_code failed;
  const fs::path absolute = fs::weakly_canonical(fs::absolute(path, failed), failed);
  if (failed) return;
  std::erase(preferences.recent, absolute.string());
  preferences.recent.insert(preferences.recent.begin(), absolute.string());
  if (preferences.recent.size() > kMaxRecent) preferences.recent.resize(kMaxRecent);
}

} // namespace candela
