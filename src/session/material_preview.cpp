#include "session/material_preview.h"

#include "core/progress.h"
#include "imaging/display_transform.h"
#include "materials/material_parts.h"
#include "render/film/film_view.h"
#include "session/offline_render.h"

#include <algorithm>

namespace candela {

namespace {

/// Calls visit(index) for each index of another material of the scene that the material has.
template <class Visit>
void each_part_index(Material& material, Visit visit) {
  for (const MaterialField& row : material_fields(material))
    if (row.type == FieldType::material) visit(*static_cast<int*>(row.address(material)));
}

/// Takes materials and textures out of a scene, each once, as they are met.
struct SampleTaker {
  const SceneDesc& scene;
  MaterialSample sample;
  std::vector<int> taken_materials, taken_textures; ///< indices in the scene, of those in the sample

  /// The index in the sample. Scenes have no cycles (parts_problem()).
  int take(int material) {
    if (const auto known = std::ranges::find(taken_materials, material); known != taken_materials.end())
      return static_cast<int>(known - taken_materials.begin());
    const auto index = sample.materials.size();
    taken_materials.push_back(material);
    Material copy = scene.materials[static_cast<std::size_t>(material)];
    copy.name.clear();
    copy.group.clear();
    sample.materials.push_back(copy);
    each_parameter(copy, [&](const MaterialField&, const ParameterRef& parameter) {
      int& texture = parameter.use().texture;
      if (texture >= 0) texture = take_texture(texture);
    });
    each_part_index(copy, [&](int& part) {
      if (part >= 0) part = take(part);
    });
    sample.materials[index] = std::move(copy);
    return static_cast<int>(index);
  }
  int take_texture(int texture) {
    const auto known = std::ranges::find(taken_textures, texture);
    const auto index = known - taken_textures.begin();
    if (known == taken_textures.end()) {
      taken_textures.push_back(texture);
      sample.textures.push_back(scene.textures[static_cast<std::size_t>(texture)]);
    }
    return static_cast<int>(index);
  }
};

} // namespace

MaterialSample material_sample(const SceneDesc& scene, std::size_t material) {
  SampleTaker taker{scene, {}, {}, {}};
  taker.take(static_cast<int>(material));
  return std::move(taker.sample);
}

std::optional<Document> preview_document(const Document& studio, const MaterialSample& sample, int side,
                                         int spp) {
  Document document = studio;
  SceneDesc& scene = document.scene;
  const auto place = std::ranges::find(scene.materials, "material", &Material::name);
  if (place == scene.materials.end() || sample.materials.empty()) return std::nullopt;
  const int first_texture = static_cast<int>(scene.textures.size());
  // The sample's first material takes the studio's place, its parts follow behind.
  const int own = static_cast<int>(place - scene.materials.begin()),
            behind = static_cast<int>(scene.materials.size()) - 1;
  for (std::size_t i = 0; i < sample.materials.size(); ++i) {
    Material material = sample.materials[i];
    each_parameter(material, [&](const MaterialField&, const ParameterRef& parameter) {
      int& texture = parameter.use().texture;
      if (texture >= 0) texture += first_texture;
    });
    each_part_index(material, [&](int& part) {
      if (part >= 0) part = part == 0 ? own : behind + part;
    });
    if (i == 0)
      scene.materials[static_cast<std::size_t>(own)] = std::move(material);
    else
      scene.materials.push_back(std::move(material));
  }
  scene.textures.insert(scene.textures.end(), sample.textures.begin(), sample.textures.end());
  if (const auto view = std::ranges::find(scene.bookmarks, "ball", &Bookmark::name);
      view != scene.bookmarks.end())
    scene.camera = view->camera;
  document.settings.film.width = document.settings.film.height = side;
  document.settings.stop = {};
  document.settings.stop.spp = spp;
  document.settings.adaptive = {};
  document.settings.display.denoise = false;
  return document;
}

std::optional<MaterialPreview> render_preview(const Document& document,
                                              std::shared_ptr<const RenderScene> previous,
                                              const std::atomic<bool>& stop) {
  OfflineOptions options;
  options.previous = std::move(previous);
  options.pass.threads = 1;
  options.stop = &stop;
  try {
    const OfflineResult result = render_document(document, options);
    if (result.interrupted || stop.load(std::memory_order_relaxed)) return std::nullopt;
    const View view = document.settings.view;
    const Image image = view_image(result.film, view);
    std::vector<std::uint8_t> rgba(4 * image.pixels.size());
    display_rgba8(image.pixels, {image.width, {}},
                  display_transform(image.pixels, image.width, image.height, document.settings.display, view,
                                    result.display_scale),
                  rgba);
    return MaterialPreview{std::move(rgba), result.scene};
  } catch (const Cancelled&) { return std::nullopt; }
}

} // namespace candela
