#pragma once
// Which lights' radiance a film keeps apart, so that groups are switched, scaled and coloured in the finished
// picture. Light is additive: the picture is the sum over the groups g of factor_g x L_g, with the radiance
// L_g of its lights at factor 1.

#include "scene/document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace candela {

/// More groups, or layers that would take more memory, are scaled in the scene instead.
inline constexpr std::size_t kMostLiveGroups = 16;
inline constexpr std::size_t kMostLayerBytes = std::size_t{2} << 30;

/// What a LayerFilm of so many layers takes: per channel a sum (double), the sum of every other sample, and
/// the products of each two layers (floats).
constexpr std::size_t layer_bytes_per_pixel(std::size_t layers) {
  return 3 * (layers * (sizeof(double) + sizeof(float)) + layers * (layers + 1) / 2 * sizeof(float));
}

/// A layer for each group that lights or materials belong to, then one for the lights without a group.
struct LightLayers {
  std::vector<std::string> names; ///< of the groups
  bool has_rest = false;          ///< whether lights without a group have a layer
  /// Layers of lights and materials, by their index in the scene. Those of what does not shine mean nothing.
  std::vector<std::uint8_t> of_light, of_material;
  bool operator==(const LightLayers&) const = default;

  bool empty() const { return names.empty(); }
  std::size_t count() const { return names.size() + (has_rest ? 1 : 0); }
};

/// The layers of the document's film; none where its groups are scaled in the scene: layers_problem() says
/// why.
LightLayers light_layers(const Document& document);
/// Why the film does not keep the groups apart: "cause; remedy"; empty where it does.
///
/// Light selection does not know the factors then: a group that is off has its samples all the same. Where
/// the samples must know them, the factors are part of the scene: adaptive sampling, that would stop pixels
/// for one mix. Views that do not add up radiance, and ambient occlusion, have no layers either.
std::string layers_problem(const Document& document);

/// By layer, what its radiance is multiplied by.
using LightMix = std::vector<vec3>;
LightMix light_mix(const SceneDesc& scene, const LightLayers& layers);
/// Whether the picture is that of all lights as they are.
bool is_plain(const LightMix& mix);

/// What a change of the groups, or of who belongs to them, affects.
Invalidates compare_light_groups(const Document& before, const Document& after);

} // namespace candela
