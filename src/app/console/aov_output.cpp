#include "app/console/aov_output.h"

#include "app/console/picture_output.h"
#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::string_view kComponents[] = {"emitted", "direct", "indirect"};

Aov parse_aov(const std::string& name) {
  const auto* component = std::ranges::find(kComponents, name);
  if (component != std::end(kComponents))
    return {name, View::radiance, static_cast<int>(component - kComponents)};
  std::span<const std::string_view> views = find_setting("view")->choices;
  auto view = std::ranges::find(views, name);
  if (view != views.end()) return {name, static_cast<View>(view - views.begin()), -1};
  std::vector<std::string_view> all(std::begin(kComponents), std::end(kComponents));
  all.insert(all.end(), views.begin(), views.end());
  throw usage_error(fmt::format("--aov {}", name), "there is no such output",
                    fmt::format("give one of {}", fmt::join(all, ", ")));
}

} // namespace

std::vector<Aov> parse_aovs(const std::vector<std::string>& names) {
  std::vector<Aov> aovs;
  for (const std::string& name : names) aovs.push_back(parse_aov(name));
  return aovs;
}

bool needs_components(const std::vector<Aov>& aovs) {
  return std::ranges::any_of(aovs, [](const Aov& a) { return a.component >= 0; });
}

std::string aov_path(const std::string& output, const std::string& name) {
  std::size_t dot = output.rfind('.'); // present, since it tells the format
  return output.substr(0, dot) + "." + name + output.substr(dot);
}

std::vector<std::string> write_aovs(const std::vector<Aov>& aovs, const std::vector<std::string>& outputs,
                                    const Document& document, const OfflineResult& rendered,
                                    const OfflineOptions& options, OutputWriter& writer) {
  std::vector<std::string> paths;
  for (const Aov& aov : aovs) {
    ViewPicture picture;
    if (aov.component >= 0)
      picture.image = rendered.components[static_cast<std::size_t>(aov.component)].image();
    else
      picture = render_view(document, rendered, aov.view, options);
    for (const std::string& output : outputs) {
      const std::string path = paths.emplace_back(aov_path(output, aov.name));
      writer.attempt(path, [&] {
        write_picture(picture.image, path, document.settings.display, aov.view, picture.display_scale,
                      picture_metadata(rendered.spp, false), rendered.film.origin());
      });
    }
  }
  return paths;
}

} // namespace candela
