#include "app/console/aov_output.h"

#include "app/console/picture_output.h"
#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::string_view kComponents[] = {"emitted", "direct", "indirect"};
constexpr std::string_view kLightGroups = "light_groups";

Aov parse_aov(const std::string& name) {
  const auto* component = std::ranges::find(kComponents, name);
  if (component != std::end(kComponents))
    return {.name = name, .component = static_cast<int>(component - kComponents)};
  if (name == kLightGroups) return {.name = name, .groups = true};
  std::span<const std::string_view> views = find_setting("view")->choices;
  auto view = std::ranges::find(views, name);
  if (view != views.end()) return {.name = name, .view = static_cast<View>(view - views.begin())};
  std::vector<std::string_view> all(std::begin(kComponents), std::end(kComponents));
  all.push_back(kLightGroups);
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

void check_aovs(const std::vector<Aov>& aovs, const Document& document) {
  if (std::ranges::none_of(aovs, &Aov::groups)) return;
  const std::string problem = layers_problem(document);
  if (problem.empty()) return;
  const std::size_t split = problem.find("; ");
  throw usage_error(fmt::format("--aov {}", kLightGroups), problem.substr(0, split),
                    problem.substr(split + 2));
}

std::vector<std::string> aov_paths(const Aov& aov, const std::vector<std::string>& outputs) {
  std::vector<std::string> paths;
  for (const std::string& output : outputs) {
    const std::size_t dot = output.rfind('.'); // present, since it tells the format
    std::string path =
        fmt::format("{}.{}{}", output.substr(0, dot), aov.name, aov.groups ? ".exr" : output.substr(dot));
    if (!aov.groups || std::ranges::find(paths, path) == paths.end()) paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<std::string> layer_names(const LightLayers& layers) {
  constexpr std::size_t kLongest = 200; // EXR has 255 bytes
  std::vector<std::string> groups = layers.names, names;
  if (layers.has_rest) groups.push_back("ungrouped");
  for (std::string& group : groups) {
    for (char& c : group)
      if (static_cast<unsigned char>(c) < 0x20 ||
          std::string_view("./\\:\"").find(c) != std::string_view::npos)
        c = '_';
    const std::string name = "Combined_" + group.substr(0, kLongest);
    std::string own = name;
    for (int i = 2; std::ranges::find(names, own) != names.end(); ++i) own = fmt::format("{}-{}", name, i);
    names.push_back(own);
  }
  return names;
}

namespace {

/// The picture and the layers of light groups.
void write_groups(const std::string& path, const Document& document, const OfflineResult& rendered) {
  const LightLayers& layers = rendered.scene->light_layers();
  const std::vector<std::string> names = layer_names(layers);
  const LightMix mix = light_mix(document.scene, layers);
  ImageMetadata metadata = picture_metadata(rendered.spp, false);
  std::vector<ImageLayer> images;
  for (std::size_t i = 0; i < names.size(); ++i) {
    images.push_back({names[i], rendered.layers.image(rendered.film, i)});
    metadata["candela.factor." + names[i]] = fmt::format("{} {} {}", mix[i].x, mix[i].y, mix[i].z);
  }
  write_exr_layers(rendered.film.image(), images, path, metadata);
}

} // namespace

std::vector<std::string> write_aovs(const std::vector<Aov>& aovs, const std::vector<std::string>& outputs,
                                    const Document& document, const OfflineResult& rendered,
                                    const OfflineOptions& options, OutputWriter& writer) {
  std::vector<std::string> paths;
  for (const Aov& aov : aovs) {
    if (aov.groups) {
      for (const std::string& path : aov_paths(aov, outputs)) {
        writer.attempt(path, [&] { write_groups(path, document, rendered); });
        paths.push_back(path);
      }
      continue;
    }
    ViewPicture picture;
    if (aov.component >= 0)
      picture.image = rendered.components[static_cast<std::size_t>(aov.component)].image();
    else
      picture = render_view(document, rendered, aov.view, options);
    for (const std::string& path : aov_paths(aov, outputs)) {
      paths.push_back(path);
      writer.attempt(path, [&] {
        write_picture(picture.image, path, document.settings.display, aov.view, picture.display_scale,
                      picture_metadata(rendered.spp, false), rendered.film.origin());
      });
    }
  }
  return paths;
}

} // namespace candela
