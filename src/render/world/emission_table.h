#pragma once
// What emitters with textures send out, as a whole and part by part: for choosing and sampling them.

#include "core/progress.h"
#include "lights/emission_grid.h"
#include "render/world/surface_material.h"

#include <functional>
#include <memory>
#include <optional>

namespace candela {

struct EmissionTable {
  vec3 mean{0};                             ///< W/(m^2 sr)
  std::shared_ptr<const EmissionGrid> grid; ///< null where the radiance is too even for it to pay
};

/// How a light's surface is laid out on the unit square, equal areas to equal areas.
enum class EmissionChart {
  rectangle,          ///< texture coordinates along its edges
  mirrored_rectangle, ///< the first coordinate from 1 to 0
  disc,               ///< DiscLight::from_polar
  sphere,             ///< SphereLight::from_square
};
/// The texture coordinates of a place on the chart.
vec2 chart_uv(EmissionChart chart, vec2 place);

/// Of a light with that chart: emission times opacity, as the material evaluates both. The grid has some
/// cells for each texel, no more than kMostCells along each side; a cell is the mean of lookups, of which a
/// side has kMostLookups at most. Throws Cancelled soon after `progress` is told to end; it may be null.
inline constexpr int kMostCells = 256, kMostLookups = 1024;
EmissionTable tabulate_emission(const SurfaceMaterial& material, EmissionChart chart,
                                const Progress* progress = nullptr);

/// Whether the coordinates alone do not tell what it sends out: light sampling guesses then.
inline bool places_radiance(const SurfaceMaterial& material) {
  auto asks = [](const TexturedParameter* lookup) { return lookup != nullptr && lookup->asks_place(); };
  return asks(material.emission_texture) || asks(material.opacity_texture);
}

/// What light sampling expects of an emitter, W/(m^2 sr): the mean over its own part of the textures.
/// `uv_at` maps the unit square to its texture coordinates, equal areas to equal areas.
vec3 mean_radiance(const SurfaceMaterial& material, const std::function<vec2(vec2)>& uv_at);
/// The same of a triangle, by the barycentric coordinates of its second and third corner.
vec3 mean_radiance_of_triangle(const SurfaceMaterial& material, const std::function<vec2(vec2)>& uv_at);

/// What light sampling is told of a light.
struct LightRadiance {
  Spectrum mean{0}; ///< W/(m^2 sr); black only where it sends out nothing
  bool two_sided = false;
  const EmissionGrid* picture = nullptr; ///< over the light's chart, if it has one
};

/// Finds the LightRadiance of the lights of a material, given the texture coordinates of each. A path that
/// meets a partly transparent light sees it with the probability of its opacity; sampling the light must
/// expect the same.
class EmitterRadiance {
public:
  /// `table` makes the EmissionTable of a light, or knows it.
  using Table = std::function<const EmissionTable&(const SurfaceMaterial&, EmissionChart)>;
  EmitterRadiance(const SurfaceMaterial& material, const Table& table) : material_(material), table_(table) {}

  /// The arguments as those of mean_radiance, mean_radiance_of_triangle, tabulate_emission.
  LightRadiance over(const std::function<vec2(vec2)>& uv_at) const {
    return textured() ? with_mean(mean_radiance(material_, uv_at)) : even();
  }
  /// Nothing where a texture gives the radiance, or light passes through.
  std::optional<LightRadiance> even_and_opaque() const {
    return textured() || material_.opacity < 1 ? std::nullopt : std::optional(even());
  }
  LightRadiance over_triangle(const std::function<vec2(vec2)>& uv_at) const {
    return textured() ? with_mean(mean_radiance_of_triangle(material_, uv_at)) : even();
  }
  LightRadiance over_chart(EmissionChart chart) const {
    if (!textured()) return even();
    if (places_radiance(material_)) return over([chart](vec2 place) { return chart_uv(chart, place); });
    const EmissionTable& table = table_(material_, chart);
    return {table.mean, material_.two_sided_emission, table.grid.get()};
  }

private:
  bool textured() const { return has_textured_radiance(material_); }
  LightRadiance with_mean(vec3 mean) const { return {mean, material_.two_sided_emission}; }
  LightRadiance even() const { return with_mean(material_.emission * material_.opacity); }

  const SurfaceMaterial& material_;
  const Table& table_;
};

} // namespace candela
