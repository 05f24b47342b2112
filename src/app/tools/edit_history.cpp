#include "app/tools/edit_history.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace candela {

namespace {

// Limits of the history: a step of a small scene takes kilobytes, one of ten thousand instances megabytes.
constexpr std::size_t kMaxSteps = 500;
constexpr std::size_t kMaxHistoryBytes = std::size_t{128} << 20;
/// Scenes whose meshes the history keeps alive: the open one and the previous one.
constexpr std::size_t kMaxScenes = 2;

std::size_t own_bytes(const Document& document) {
  const SceneDesc& scene = document.scene;
  return sizeof(Document) + scene.materials.size() * sizeof(Material) +
         scene.lights.size() * sizeof(LightDesc) + scene.instances.size() * (sizeof(Instance) + sizeof(int));
}

void forget_film_size(Document& document) {
  const FilmSettings standard;
  document.settings.film.width = standard.width;
  document.settings.film.height = standard.height;
}

/// The document without the values whose change is not an edit.
Document comparable(Document document, bool fit_film) {
  if (fit_film) forget_film_size(document);
  return document;
}

bool same_state(const EditState& a, const EditState& b) {
  return a.scene == b.scene && a.fit_film == b.fit_film &&
         comparable(a.document, a.fit_film) == comparable(b.document, b.fit_film);
}

std::string shown_name(const std::string& name, std::string_view kind, std::size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

/// The keys of the rows that differ.
template <class Owner>
std::vector<std::string_view> changed_keys(std::span<const Field<Owner>> rows, const Owner& a,
                                           const Owner& b) {
  std::vector<std::string_view> keys;
  for (const auto& row : rows)
    if (!field_equal(row, row.address(const_cast<Owner&>(a)), row.address(const_cast<Owner&>(b))))
      keys.push_back(row.key);
  return keys;
}

/// The change of a list: entries added or removed, one entry (and its values), or several.
template <class T, class Rows>
std::string list_edit(const std::vector<T>& a, const std::vector<T>& b, const char* kind, const char* kinds,
                      Rows rows) {
  if (a.size() != b.size()) return fmt::format("{} {}", b.size() > a.size() ? "Add" : "Remove", kind);
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i])) changed.push_back(i);
  if (changed.empty()) return {};
  if (changed.size() > 1) return fmt::format("{} {}", changed.size(), kinds);
  const std::size_t i = changed.front();
  const std::string what = rows(a[i], b[i]);
  const std::string name = shown_name(b[i].name, kind, i);
  return what.empty() ? name : fmt::format("{}: {}", name, what);
}

std::string material_edit(const Material& a, const Material& b) {
  if (a.model.index() != b.model.index()) return std::string(material_type_field().key);
  std::vector<std::string_view> keys;
  auto &x = const_cast<Material&>(a), &y = const_cast<Material&>(b);
  for (const MaterialField& row : material_fields(a)) {
    const bool same = row.parameter != nullptr ? row.parameter(x).equals(row.parameter(y))
                                               : field_equal(row, row.address(x), row.address(y));
    if (!same) keys.push_back(row.key);
  }
  return fmt::format("{}", fmt::join(keys, ", "));
}

std::string instance_edit(const Instance& a, const Instance& b) {
  if (a.world_from_object != b.world_from_object) {
    bool moved_only = true;
    for (int c = 0; c < 3; ++c) moved_only &= a.world_from_object[c] == b.world_from_object[c];
    return moved_only ? "move" : "transform";
  }
  if (a.materials != b.materials) return "material";
  if (a.shape.index() != b.shape.index()) return "shape";
  if (a.motion != b.motion) return "motion";
  return fmt::format("{}", fmt::join(changed_keys(shape_fields(a.shape), a.shape, b.shape), ", "));
}

} // namespace

std::string edit_name(const EditState& before, const EditState& after) {
  if (before.scene != after.scene) {
    const std::string& path = after.scene ? after.scene->path : std::string();
    return fmt::format("Open {}",
                       path.empty() ? "the built-in scene" : std::filesystem::path(path).filename().string());
  }
  const SceneDesc &a = before.document.scene, &b = after.document.scene;
  std::vector<std::string> parts;
  auto add = [&](std::string part) {
    if (!part.empty()) parts.push_back(std::move(part));
  };
  add(list_edit(a.instances, b.instances, "Object", "objects", instance_edit));
  add(list_edit(a.materials, b.materials, "Material", "materials", material_edit));
  add(list_edit(a.lights, b.lights, "Light", "lights", [](const LightDesc& x, const LightDesc& y) {
    if (light_type(x) != light_type(y)) return std::string("type");
    return fmt::format("{}", fmt::join(changed_keys(light_fields(x), x, y), ", "));
  }));
  if (a.light_groups != b.light_groups) add("Light groups");
  add(list_edit(a.media, b.media, "Medium", "media", [](const MediumDesc& x, const MediumDesc& y) {
    if (medium_type(x) != medium_type(y)) return std::string("type");
    if (x.phase != y.phase) return std::string("phase");
    return fmt::format("{}", fmt::join(changed_keys(medium_fields(x), x, y), ", "));
  }));
  if (a.medium != b.medium) add("Medium of the scene");
  add(list_edit(a.bookmarks, b.bookmarks, "Bookmark", "bookmarks",
                [](const Bookmark&, const Bookmark&) { return std::string(); }));
  std::set<std::string_view> poses = {"camera.position", "camera.target", "camera.up"};
  bool moved = false;
  for (std::string_view key : changed_keys(settings_table(), before.document, after.document)) {
    if (poses.contains(key)) {
      moved = true;
      continue;
    }
    if (after.fit_film && before.fit_film && (key == "film.width" || key == "film.height")) continue;
    add(std::string(key));
  }
  if (moved) parts.insert(parts.begin(), "Camera");
  if (parts.empty()) return before.fit_film != after.fit_film ? "film size" : "Edit";
  constexpr std::size_t kMaxParts = 3;
  const bool more = parts.size() > kMaxParts;
  parts.resize(std::min(parts.size(), kMaxParts));
  return fmt::format("{}{}", fmt::join(parts, ", "), more ? ", …" : "");
}

bool differs_from_file(const Document& document, const Document& saved, bool fit_film) {
  Document a = comparable(document, fit_film), b = comparable(saved, fit_film);
  a.scene.camera.position = b.scene.camera.position;
  a.scene.camera.target = b.scene.camera.target;
  a.scene.camera.up = b.scene.camera.up;
  return a != b;
}

void EditHistory::reset(EditState now) {
  entries_.clear();
  const std::size_t bytes = own_bytes(now.document);
  entries_.push_back({std::move(now), "", bytes});
  cursor_ = 0;
  pending_ = false;
}

void EditHistory::observe(const EditState& now, bool edited, bool in_gesture) {
  pending_ |= edited;
  if (!pending_ || in_gesture) return;
  pending_ = false;
  const Entry& present = entries_[cursor_];
  if (same_state(present.state, now)) return;
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(cursor_) + 1, entries_.end());
  entries_.push_back({now, edit_name(present.state, now), own_bytes(now.document)});
  cursor_ = entries_.size() - 1;
  trim();
}

std::optional<int> EditHistory::undos_to(const std::vector<Instance>& instances) const {
  auto fits = [&](std::size_t i) { return entries_[i].state.document.scene.instances == instances; };
  for (std::size_t i = cursor_ + 1; i-- > 0;)
    if (fits(i)) return static_cast<int>(cursor_ - i);
  for (std::size_t i = cursor_ + 1; i < entries_.size(); ++i)
    if (fits(i)) return -static_cast<int>(i - cursor_);
  return std::nullopt;
}

void EditHistory::trim() {
  std::size_t bytes = 0, kept = 0;
  std::set<const OpenScene*> scenes;
  while (kept < entries_.size()) { // from the newest to the oldest
    const Entry& entry = entries_[entries_.size() - 1 - kept];
    bytes += entry.bytes;
    scenes.insert(entry.state.scene.get());
    if (kept > 0 && (kept == kMaxSteps || bytes > kMaxHistoryBytes || scenes.size() > kMaxScenes)) break;
    ++kept;
  }
  const std::size_t dropped = entries_.size() - kept;
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(dropped));
  cursor_ = entries_.size() - 1;
}

} // namespace candela
