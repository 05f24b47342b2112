#pragma once
// Scenes of random materials, textures, lights, shapes, cameras and settings: whatever the rows allow.

#include "render/render_testing.h"
#include "support/textures.h"
#include "support/volumes.h"

#include <random>

namespace candela::test {

namespace detail {

class SceneGenerator {
public:
  explicit SceneGenerator(std::uint64_t seed) : random_(seed) {}

  Document make() {
    const int textures = pick(4);
    for (int i = 0; i < textures; ++i) scene().textures.push_back(texture());
    const int media = one_in(2) ? 0 : 1 + pick(3);
    for (int i = 0; i < media; ++i) scene().media.push_back(medium(i));
    if (media > 0 && one_in(3)) scene().medium = any_medium();
    const int materials = 1 + pick(4);
    for (int i = 0; i < materials; ++i) s_.material(material());
    const int shapes = 1 + pick(6);
    for (int i = 0; i < shapes; ++i) add_shape();
    const int lights = pick(4);
    for (int i = 0; i < lights; ++i) scene().lights.push_back(light());
    camera();
    settings();
    return std::move(s_.document);
  }

private:
  SceneDesc& scene() { return s_.document.scene; }

  float number(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }
  int pick(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool one_in(int n) { return pick(n) == 0; }
  vec3 point(float extent) {
    const float x = number(-extent, extent), y = number(-extent, extent);
    return {x, y, number(-extent, extent)};
  }
  vec3 direction() { return glm::normalize(point(1) + vec3(1e-3f)); }

  /// Somewhere in the row's range: wide ranges by orders of magnitude, and one in eight at an end. Where
  /// there is no end, not far from 0: values whose product overflows are no fault of the renderer.
  float value_of(const FieldInfo& row) {
    constexpr double kFar = 1e4;
    const double low = std::max(row.minimum, -kFar), high = std::min(row.maximum, kFar);
    const double span = high - low;
    if (!row.above_minimum && one_in(16)) return static_cast<float>(low);
    if (one_in(16)) return static_cast<float>(high);
    const auto u = static_cast<double>(number(0, 1));
    double value = low + u * span;
    if (span > 100)
      value = std::clamp(std::pow(10.0, 6 * u - 3) * (low < 0 && one_in(2) ? -1 : 1), low, high);
    if (row.above_minimum) value = std::max(value, low + 1e-3 * span);
    return static_cast<float>(value);
  }

  /// The value at `address`, which the row describes.
  void randomise(const FieldInfo& row, void* address) {
    switch (row.type) {
    case FieldType::boolean: *static_cast<bool*>(address) = one_in(2); break;
    case FieldType::integer: {
      const double low = std::max(row.minimum, -100.0), high = std::min(row.maximum, 100.0);
      *static_cast<int*>(address) = static_cast<int>(low) + pick(static_cast<int>(high - low) + 1);
      break;
    }
    case FieldType::choice: *static_cast<int*>(address) = pick(static_cast<int>(row.choices.size())); break;
    case FieldType::material: { // of those before, so that none is a part of itself; null cannot be one
      const int part = pick(static_cast<int>(scene().materials.size()) + 1) - 1;
      const bool fits = part >= 0 && !is_null(scene().materials[static_cast<std::size_t>(part)]);
      *static_cast<int*>(address) = fits ? part : -1;
      break;
    }
    case FieldType::real: *static_cast<float*>(address) = value_of(row); break;
    case FieldType::angle: *static_cast<float*>(address) = radians(value_of(row)); break;
    case FieldType::point: {
      vec3& place = *static_cast<vec3*>(address);
      place = one_in(4) ? direction() : point(3);
      if (row.minimum >= 0) place = glm::max(glm::abs(place), vec3(static_cast<float>(row.minimum)));
      break;
    }
    case FieldType::color: {
      vec3& color = *static_cast<vec3*>(address);
      const FieldInfo within = limited_color(row);
      if (one_in(3)) {
        color = vec3(value_of(within));
      } else {
        for (int c = 0; c < 3; ++c) color[c] = value_of(within);
      }
      break;
    }
    }
  }
  static FieldInfo limited_color(FieldInfo row) {
    row.maximum = std::min(row.maximum, 100.0);
    return row;
  }

  std::shared_ptr<const Texture> texture() {
    const auto names = texture_kind_names();
    const int kind = pick(static_cast<int>(names.size()));
    auto model = texture_of_kind(names[static_cast<std::size_t>(kind)]);
    if (!model || std::holds_alternative<ImageTexture>(*model)) {
      const int width = 1 + pick(5), height = 1 + pick(5), channels = std::array{1, 3, 4}[pick(3)];
      std::vector<std::uint8_t> values;
      for (int i = 0; i < width * height * channels; ++i)
        values.push_back(static_cast<std::uint8_t>(one_in(4) ? 255 * pick(2) : pick(256)));
      return picture_texture(width, height, std::move(values), channels);
    }
    auto made = std::make_shared<Texture>(Texture{"", *model});
    std::visit(
        [&](auto& kind_of) {
          for (const auto& row : std::decay_t<decltype(kind_of)>::rows())
            randomise(row, row.address(kind_of));
        },
        made->model);
    return made;
  }

  void use_texture(const ParameterRef& parameter) {
    TextureUse& use = parameter.use();
    for (const Field<TextureUse>& row : texture_use_fields()) randomise(row, row.address(use));
    use.texture = pick(static_cast<int>(scene().textures.size()));
  }

  MediumDesc medium(int index) {
    MediumDesc m = default_medium(pick(static_cast<int>(medium_type_field().choices.size())));
    m.name = std::to_string(index);
    m.phase = default_phase(pick(static_cast<int>(phase_type_field().choices.size())));
    for (const Field<MediumDesc>& row : medium_fields(m))
      if (row.key != "emission" || one_in(4)) randomise(row, row.address(m));
    for (const Field<PhaseDesc>& row : phase_fields(m.phase)) randomise(row, row.address(m.phase));
    if (auto* made = std::get_if<ProceduralMediumModel>(&m.model)) made->resolution = 16 + pick(9);
    if (takes_grid(m) && !one_in(8)) {
      VolumeGrid grid = random_grid({1 + pick(20), 1 + pick(20), 1 + pick(20)}, random_());
      if (one_in(2)) grid.temperature = grid.density;
      if (one_in(2)) grid.color.assign(grid.density.size(), vec3(0.3f, 0.8f, 1));
      set_medium_grid(m, std::make_shared<const VolumeGrid>(std::move(grid)));
    }
    return m;
  }
  std::string any_medium() {
    return scene().media[static_cast<std::size_t>(pick(static_cast<int>(scene().media.size())))].name;
  }

  Material material() {
    for (;;) {
      Material m = default_material(pick(kMaterialTypeCount));
      for (const MaterialField& row : material_fields(m)) {
        const ParameterRef parameter = row.parameter != nullptr ? row.parameter(m) : ParameterRef{};
        if (!one_in(3)) randomise(row, parameter ? parameter.value() : row.address(m));
        if (parameter && !scene().textures.empty() && one_in(5)) use_texture(parameter);
      }
      if (!one_in(4)) m.opacity = 1.0f;
      if (!one_in(3)) m.emission = vec3(0);
      if (!scene().media.empty() && one_in(2)) m.medium = any_medium();
      if (material_problem(m, scene().textures.size()).empty()) return m;
    }
  }

  LightDesc light() {
    for (;;) {
      LightDesc l = default_light(pick(kLightTypeCount));
      for (const Field<LightDesc>& row : light_fields(l)) randomise(row, row.address(l));
      if (light_problem(l).empty()) return l;
    }
  }

  Mesh mesh() {
    if (one_in(2))
      return sphere_mesh(static_cast<unsigned>(2 + pick(5)), static_cast<unsigned>(3 + pick(8)), one_in(2));
    Mesh m;
    const int vertices = 3 + pick(12), triangles = 1 + pick(12);
    const bool uvs = one_in(2), normals = one_in(2);
    for (int i = 0; i < vertices; ++i) {
      m.positions.push_back(one_in(6) && i > 0 ? m.positions.back() : point(1));
      if (uvs) m.uvs.emplace_back(one_in(3) ? vec2(0) : vec2(point(2)));
      if (normals) m.normals.push_back(one_in(5) ? vec3(0) : direction());
    }
    auto corner = [&] { return static_cast<unsigned>(pick(vertices)); };
    for (int i = 0; i < triangles; ++i) { // corners may coincide
      const unsigned a = corner(), b = corner();
      m.triangles.emplace_back(a, b, corner());
    }
    if (one_in(4)) {
      for (const vec3 p : m.positions) m.positions_end.push_back(one_in(4) ? p : p + point(0.5f));
      for (std::size_t i = 0; i < m.normals.size(); ++i) m.normals_end.push_back(direction());
    }
    return m;
  }

  /// Points and widths may coincide or be 0.
  std::shared_ptr<const Strands> strands() {
    Strands s;
    s.basis = static_cast<CurveBasis>(pick(2));
    const int count = 1 + pick(3);
    for (int i = 0; i < count; ++i) {
      const int points = s.basis == CurveBasis::bspline ? 4 + pick(4) : 4 + 3 * pick(3);
      s.counts.push_back(static_cast<std::uint32_t>(points));
      for (int j = 0; j < points; ++j)
        s.points.push_back(one_in(5) && !s.points.empty() ? s.points.back() : point(1));
    }
    s.widths.resize(one_in(2) ? 2 : s.points.size());
    for (float& width : s.widths) width = one_in(5) ? 0 : number(0, 0.3f);
    return std::make_shared<const Strands>(std::move(s));
  }

  mat4 transform() {
    mat4 m = glm::translate(mat4(1), point(one_in(10) ? 1e5f : 1.5f));
    m = glm::rotate(m, number(0, 6), direction());
    const float size = one_in(8) ? std::pow(10.0f, number(-5, 3)) : number(0.2f, 1.5f);
    const vec3 flat = one_in(8) ? vec3(1, 1, std::pow(10.0f, number(-6, 0))) : vec3(1);
    return glm::scale(m, size * flat * (one_in(6) ? vec3(-1, 1, 1) : vec3(1)));
  }

  void add_shape() {
    const int material = pick(static_cast<int>(scene().materials.size()));
    const auto names = shape_names();
    std::optional<Shape> shape =
        shape_of_name(names[static_cast<std::size_t>(pick(static_cast<int>(names.size())))]);
    if (!shape) shape = std::make_shared<const Mesh>(mesh());
    if (auto* curves = std::get_if<CurvesShape>(&*shape)) curves->strands = strands();
    for (const Field<Shape>& row : shape_fields(*shape)) {
      Shape changed = *shape;
      randomise(row, row.address(changed));
      if (shape_problem(changed).empty()) shape = changed;
    }
    scene().instances.push_back({"", *shape, transform(), {material}, one_in(5) ? motion() : Motion()});
  }

  Motion motion() {
    Motion m;
    for (const Field<Motion>& row : motion_fields())
      if (row.key != "scale" && !one_in(3)) randomise(row, row.address(m));
    if (one_in(3)) m.scale = {number(0.1f, 4), number(0.1f, 4), number(0.1f, 4)};
    return motion_problem(m).empty() ? m : Motion();
  }

  void camera() {
    Camera& c = scene().camera;
    do {
      c = Camera{};
      c.position = point(4);
      c.target = one_in(6) ? c.position + direction() * std::pow(10.0f, number(-3, 4)) : point(1);
      c.up = direction();
      c.vertical_fov = radians(number(1, 170));
      c.projection = static_cast<Projection>(pick(3));
      if (one_in(2)) c.aperture_radius = number(0, 1);
      if (one_in(3)) c.focus_distance = std::pow(10.0f, number(-3, 3));
      c.blades = pick(9);
      if (one_in(2)) c.shutter_open = number(0, 1), c.shutter_close = number(0, 1);
      if (one_in(4)) c.motion_position = point(1), c.motion_target = point(1), c.motion_up = point(0.5f);
      if (one_in(6)) c.motion_fov = number(-2, 2);
      // The pupils of a lens take a while to find: few scenes have one.
      if (one_in(40)) c.lens = static_cast<Lens>(1 + pick(4));
    } while (!camera_value_problem(c).empty());
  }

  void settings() {
    const RenderSettings standard = s_.document.settings;
    for (const Field<Document>& row : settings_table()) {
      const bool chosen = row.key.starts_with("path.") || row.key.starts_with("sampler.") ||
                          row.key.starts_with("ao.") || row.key == "integrator" || row.key == "film.filter";
      if (!chosen || one_in(2)) continue;
      randomise(row, row.address(s_.document));
    }
    PathSettings& path = s_.document.settings.path;
    path.light_samples = std::min(path.light_samples, 4);
    path.split = std::min(path.split, 4);
    path.only_depth = std::min(path.only_depth, 4);
    if (one_in(10)) {
      OverrideSettings& by = s_.document.settings.override_brdf;
      by.brdf = 1 + pick(kMaterialTypeCount);
      for (const Field<MaterialChoice>& row : material_choice_fields())
        randomise(row, row.address(by.values));
    }
    if (!document_problem(s_.document).empty()) s_.document.settings = standard;
  }

  std::mt19937_64 random_;
  SceneMaker s_{8, 6, 2};
};

} // namespace detail

/// Valid, of a few pixels and samples, and always the same of the same seed. Values lie anywhere in their
/// rows, now and then at an end; meshes have degenerate triangles, transforms may flatten.
inline Document random_scene(std::uint64_t seed) { return detail::SceneGenerator(seed).make(); }

} // namespace candela::test
