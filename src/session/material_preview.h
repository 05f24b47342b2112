#pragma once
// A picture of one material in a studio: the scene that is rendered for it, and the render.

#include "scene/document.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace candela {

class RenderScene;

/// A material with all that it names, taken out of its scene: what its picture depends on, and no more.
/// Samples with equal values are equal, whatever their names and their places in scenes; textures are
/// compared by identity.
struct MaterialSample {
  /// The material, then its parts; without names and light groups. Indices are those of these lists.
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const Texture>> textures;
  bool operator==(const MaterialSample&) const = default;
};
MaterialSample material_sample(const SceneDesc& scene, std::size_t material);

/// The studio with the sample in the place of its material called "material", seen from its bookmark "ball"
/// (else its camera), in side x side pixels of `spp` samples. Nothing if the studio has no such material.
std::optional<Document> preview_document(const Document& studio, const MaterialSample& sample, int side,
                                         int spp);

struct MaterialPreview {
  std::vector<std::uint8_t> rgba; ///< sRGB, row 0 is the top; alpha is 255
  std::shared_ptr<const RenderScene> scene;
};

/// Renders with the calling thread alone. The bits depend on the document only. `previous` is the scene of
/// another preview in the same studio, which saves building its geometry, or null. Nothing once `stop` is
/// set. Throws what render_document() does.
std::optional<MaterialPreview> render_preview(const Document& document,
                                              std::shared_ptr<const RenderScene> previous,
                                              const std::atomic<bool>& stop);

} // namespace candela
