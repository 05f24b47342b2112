#include "render/world/emission_table.h"

#include "lights/disc_light.h"
#include "lights/sphere_light.h"
#include "render/world/sphere_uv.h"

namespace candela {

namespace {

/// Mean of what an emitter sends out, from lookups. Never black, for then what the lookups miss would not be
/// sampled.
class MeanRadiance {
public:
  explicit MeanRadiance(const SurfaceMaterial& material) : material_(material) {}

  /// What light sampling must expect of a place: a ray meets the surface there with the probability of its
  /// opacity.
  vec3 look_up(vec2 uv) {
    auto there = [uv] { return uv; };
    const vec3 emission = emission_at(material_, there), sent = emission * opacity_at(material_, there);
    sum_ += glm::dvec3(sent);
    brightest_ = glm::max(brightest_, emission);
    ++count_;
    return sent;
  }
  vec3 mean() const {
    constexpr float kLeastShare = 1e-3f;
    const vec3 mean(sum_ / static_cast<double>(count_));
    return glm::max(mean, kLeastShare * (is_black(brightest_) ? vec3(1) : brightest_));
  }

private:
  const SurfaceMaterial& material_;
  glm::dvec3 sum_{0};
  vec3 brightest_{0};
  std::size_t count_ = 0;
};

/// How many texels of the finer of its textures lie along a step of the coordinates.
float texels_along(const SurfaceMaterial& material, vec2 step) {
  float most = 0;
  for (const TexturedParameter* textured : {material.emission_texture, material.opacity_texture}) {
    if (textured == nullptr) continue;
    const vec2 cells = std::visit([](const auto& kind) { return kind.cells(); }, textured->texture->model);
    const vec2 crossed = glm::abs(textured->use.uv.apply_to_step(step)) * cells;
    most = std::max({most, crossed.x, crossed.y});
  }
  return most;
}

/// A number of cells or lookups; also of what is no number.
int count_of(float texels, int least, int most) {
  return texels < static_cast<float>(most) ? std::max(static_cast<int>(std::ceil(texels)), least) : most;
}

} // namespace

vec2 chart_uv(EmissionChart chart, vec2 place) {
  switch (chart) {
  case EmissionChart::mirrored_rectangle: return {1 - place.x, place.y};
  case EmissionChart::disc: return 0.5f * DiscLight::from_polar(place) + 0.5f;
  case EmissionChart::sphere: return sphere_uv(SphereLight::from_square(place));
  case EmissionChart::rectangle: break;
  }
  return place;
}

EmissionTable tabulate_emission(const SurfaceMaterial& material, EmissionChart chart,
                                const Progress* progress) {
  float across = texels_along(material, {1, 0}), up = texels_along(material, {0, 1});
  if (chart == EmissionChart::disc) { // along the radius and around the rim
    const float finer = std::max(across, up);
    across = 0.5f * finer, up = kPi * finer;
  }
  // A texel that is blended with its neighbours varies within: two cells, and some lookups in each.
  auto cells_of = [](float texels) { return count_of(2 * texels, 16, kMostCells); };
  auto lookups_of = [](float texels, int cells) {
    return count_of(2 * texels / static_cast<float>(cells), 2, kMostLookups / cells);
  };
  const int columns = cells_of(across), rows = cells_of(up);
  const int wide = lookups_of(across, columns), high = lookups_of(up, rows);
  const vec2 size(columns * wide, rows * high);
  MeanRadiance radiance(material);
  std::vector<float> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0f);
  for (int y = 0; y < rows * high; ++y) {
    if (progress != nullptr) progress->check();
    float* row = &cells[static_cast<std::size_t>(y / high) * static_cast<std::size_t>(columns)];
    for (int x = 0; x < columns * wide; ++x) {
      const vec2 place = (vec2(x, y) + 0.5f) / size;
      row[x / wide] += luminance(radiance.look_up(chart_uv(chart, place)));
    }
  }
  EmissionTable table{radiance.mean(), nullptr};
  // Of more even ones, sampling in solid angle leaves less noise than the cosines do.
  constexpr float kLeastContrast = 0.05f;
  if (std::ranges::all_of(cells, [](float l) { return l == 0; })) return table;
  auto grid = std::make_shared<const EmissionGrid>(cells, static_cast<std::size_t>(columns), progress);
  if (grid->contrast() >= kLeastContrast) table.grid = std::move(grid);
  return table;
}

vec3 mean_radiance_of_triangle(const SurfaceMaterial& material, const std::function<vec2(vec2)>& uv_at) {
  const vec2 a = uv_at({0, 0}), b = uv_at({1, 0}), c = uv_at({0, 1});
  // A mesh may have millions of triangles, most of them small.
  const float longest =
      std::max({texels_along(material, b - a), texels_along(material, c - a), texels_along(material, c - b)});
  const int side = count_of(longest, 2, 16);
  MeanRadiance radiance(material);
  // Lines along its sides cut it into side^2 equal triangles: a lookup in the middle of each.
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side - y; ++x) {
      auto look_up = [&](float offset) {
        radiance.look_up(uv_at((vec2(x, y) + offset) / static_cast<float>(side)));
      };
      look_up(1 / 3.0f);
      if (x + y + 1 < side) look_up(2 / 3.0f);
    }
  return radiance.mean();
}

vec3 mean_radiance(const SurfaceMaterial& material, const std::function<vec2(vec2)>& uv_at) {
  constexpr int kSide = 16;
  MeanRadiance radiance(material);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) radiance.look_up(uv_at((vec2(x, y) + 0.5f) / static_cast<float>(kSide)));
  return radiance.mean();
}

} // namespace candela
