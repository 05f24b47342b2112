#include "app/console/scene_options.h"

#include "app/platform/data_file.h"
#include "app/platform/streams.h"
#include "core/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>

namespace candela {

namespace {

void go_to_bookmark(SceneDesc& scene, const std::string& name) {
  std::vector<std::string_view> names;
  for (const Bookmark& bookmark : scene.bookmarks) {
    if (bookmark.name == name) {
      scene.camera = bookmark.camera;
      return;
    }
    names.push_back(bookmark.name);
  }
  const std::string near = nearest_name(name, names);
  throw usage_error(fmt::format("--bookmark {}", name), "the scene has no such bookmark",
                    !near.empty()   ? fmt::format("did you mean {}?", near)
                    : names.empty() ? "it has none: add one in the window or under \"bookmarks\""
                                    : fmt::format("it has {}", fmt::join(names, ", ")));
}

} // namespace

LoadedScene load_scene(const SceneOptions& options) {
  std::string path = options.path.empty() ? find_data_file("scenes/cornell_box.json").string() : options.path;
  LoadedScene scene = read_scene(path, {options.allow_outside});
  for (const Warning& w : scene.warnings)
    say("candela: warning: {}{}\n", w.text, w.count > 1 ? fmt::format(" ({} times)", w.count) : "");
  if (options.bookmark) go_to_bookmark(scene.document.scene, *options.bookmark);
  for (const std::string& s : options.settings) apply_setting(scene.document, s);
  if (auto problem = document_problem(scene.document); !problem.empty())
    throw Error(ExitCode::bad_input, fmt::format("{}: {}", path, problem));
  return scene;
}

std::vector<int> integers(const std::string& text, char separator, std::size_t n, std::string_view option,
                          std::string_view form) {
  std::vector<int> out;
  const char* p = text.data();
  const char* end = p + text.size();
  while (true) {
    int value = 0;
    auto [next, status] = std::from_chars(p, end, value);
    if (status != std::errc()) break;
    out.push_back(value);
    p = next;
    if (p == end || *p != separator) break;
    ++p;
  }
  if (p != end || out.size() != n)
    throw usage_error(fmt::format("{} {}", option, text), "it is not of the form",
                      fmt::format("write {}", form));
  return out;
}

} // namespace candela
