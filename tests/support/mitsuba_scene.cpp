#include "support/mitsuba_scene.h"

#include "io/images/image_file.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "io/obj/obj_reader.h"
#include "io/volumes/volume_reader.h"
#include "support/binary_ply.h"
#include "support/mitsuba_values.h"

#include <pugixml.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace candela::test {
namespace {

namespace fs = std::filesystem;
using namespace mitsuba_xml;

class Reader {
public:
  Reader(const std::string& path, bool patterns_upside_down) : patterns_upside_down_(patterns_upside_down) {
    read(path);
    document_.settings.path.max_depth = max_depth_;
  }
  Document take() { return std::move(document_); }

private:
  void read(const fs::path& path) {
    files_.push_back(std::make_unique<pugi::xml_document>());
    if (!files_.back()->load_file(path.c_str())) throw std::runtime_error("cannot read " + path.string());
    folders_.push_back(path.parent_path());
    const Node scene = files_.back()->child("scene");
    for (const Node& node : scene.children())
      if (node.attribute("id")) named_[node.attribute("id").value()] = node;
    for (const Node& node : scene.children()) {
      if (std::string_view(node.name()) == "default")
        defaults_.try_emplace(node.attribute("name").value(), node.attribute("value").value());
      fill_in(node);
      element(node);
    }
  }

  /// Puts the values of <default> for "$name".
  void fill_in(const Node& node) {
    for (pugi::xml_attribute attribute : node.attributes()) {
      const std::string value = attribute.value();
      const auto found = value.starts_with("$") ? defaults_.find(value.substr(1)) : defaults_.end();
      if (found != defaults_.end()) attribute.set_value(found->second.c_str());
    }
    for (const Node& part : node.children()) fill_in(part);
  }

  void element(const Node& node) {
    const std::string_view kind = node.name();
    if (kind == "path")
      folders_.push_back(folders_[0] / node.attribute("value").value());
    else if (kind == "include")
      read(folders_[0] / node.attribute("filename").value());
    else if (kind == "integrator") // "moment" around the one that renders: path, or direct
      max_depth_ = static_cast<int>(number(node.child("integrator"), "max_depth", 2));
    else if (kind == "sensor")
      sensor(node);
    else if (kind == "emitter")
      emitter(node);
    else if (kind == "medium")
      medium(node);
    else if (kind == "shape")
      shape(node, mat4(1));
    else if (kind == "texture") // used by name
      face_weights_ |= text(node, "name", "") == "face_weight";
    else if (kind != "default" && kind != "bsdf" && node.type() == pugi::node_element)
      throw unknown("element", node);
  }

  void medium(const Node& node) {
    const Node phase = node.child("phase");
    const std::string_view type = node.attribute("type").value();
    if ((type != "homogeneous" && type != "heterogeneous") ||
        std::string_view(phase.attribute("type").value()) != "isotropic")
      throw unknown("medium", node);
    MediumDesc desc;
    desc.name = node.attribute("id").value();
    const vec3 albedo = color_of(child(node, "albedo"));
    if (type == "heterogeneous") {
      // Its box is the unit cube, scaled and moved.
      const Node volume = child(node, "sigma_t"), place = child(volume, "to_world");
      auto by_axis = [&](const char* element) {
        const Node n = place.child(element);
        return vec3(n.attribute("x").as_float(), n.attribute("y").as_float(), n.attribute("z").as_float());
      };
      WarningList warnings;
      GridMediumModel grid;
      grid.grid = read_volume(file(volume), warnings);
      grid.size = by_axis("scale");
      grid.center = by_axis("translate") + 0.5f * grid.size;
      grid.sigma_t = vec3(1), grid.albedo = albedo;
      desc.model = grid;
    } else {
      desc.model = HomogeneousMediumModel{color_of(child(node, "sigma_t")), albedo};
    }
    desc.scale = number(node, "scale", 1);
    document_.scene.media.push_back(desc);
  }

  std::string file(const Node& node) const {
    const std::string name = text(node, "filename", "");
    for (const fs::path& folder : folders_)
      if (fs::exists(folder / name)) return (folder / name).lexically_normal().string();
    throw unknown("file", node);
  }

  void sensor(const Node& node) {
    Camera& camera = document_.scene.camera;
    FilmSettings& film = document_.settings.film;
    const Node look = child(node, "to_world").child("lookat"), plane = node.child("film");
    camera.position = three(look.attribute("origin").value());
    camera.target = three(look.attribute("target").value());
    camera.up = three(look.attribute("up").value());
    film.width = static_cast<int>(number(plane, "width", 768));
    film.height = static_cast<int>(number(plane, "height", 576));
    if (film.width != film.height) throw unknown("film", plane);
    // Without an angle, Mitsuba takes a lens of 50 mm before 35 mm film, whose diagonal is that of the
    // picture.
    const float diagonal = std::hypot(36.0f, 24.0f) / 50;
    camera.vertical_fov = child(node, "fov") ? radians(number(node, "fov", 0))
                                             : 2 * std::atan(0.5f * diagonal / std::sqrt(2.0f));
    if (std::string_view(plane.child("rfilter").attribute("type").value()) != "box") {
      film.filter = FilterType::gaussian; // sigma 0.5, as ours of this radius
      film.filter_radius = 1.5f;
    }
  }

  void emitter(const Node& node) {
    const std::string type = node.attribute("type").value();
    LightDesc light;
    auto color = [&](const char* name) {
      const Node value = child(node, name);
      if (value) light.color = color_of(value);
    };
    if (type == "constant") {
      light.model = ConstantLightModel{};
      color("radiance");
    } else if (type == "envmap") {
      WarningList warnings;
      const std::string path = file(node);
      light.model = EnvironmentLightModel{
          .panorama = with_rows_of_mitsuba(*read_panorama(std::span(&path, 1), warnings))};
    } else if (type == "spot") {
      const Node look = child(node, "to_world").child("lookat");
      const vec3 from = three(look.attribute("origin").value());
      const float cutoff = number(node, "cutoff_angle", 20);
      SpotLightModel spot;
      spot.position = from, spot.direction = three(look.attribute("target").value()) - from;
      spot.cutoff_angle = radians(cutoff),
      spot.beam_width = radians(number(node, "beam_width", 0.75f * cutoff));
      light.model = spot;
      color("intensity");
    } else if (type == "point") {
      const Node position = child(node, "position");
      const vec3 p = position ? axes(position, 0) : vec3(transform(node)[3]);
      light.model = PointLightModel{.position = p};
      color("intensity");
    } else if (type == "directional") {
      light.model = DirectionalLightModel{three(text(node, "direction", ""))};
      color("irradiance");
    } else if (type == "projector") {
      const Node look = child(node, "to_world").child("lookat");
      const vec3 from = three(look.attribute("origin").value());
      light.model = ProjectorLightModel{.position = from,
                                        .direction = three(look.attribute("target").value()) - from,
                                        .vertical_fov = radians(number(node, "fov", 0))};
      color("irradiance");
      light.color *= kPi; // the radiance that a white diffuse plane at the distance 1 has
    } else {
      throw unknown("emitter", node);
    }
    document_.scene.lights.push_back(light);
  }

  void shape(const Node& node, const mat4& parent) {
    const std::string type = node.attribute("type").value();
    if (type == "shapegroup") return; // shown by its instances
    if (type == "instance") {
      for (const Node& part : named(node.child("ref")).children("shape"))
        shape(part, parent * transform(node));
      return;
    }
    Instance instance;
    instance.name = "shape " + std::to_string(document_.scene.instances.size());
    instance.world_from_object = parent * transform(node);
    std::size_t slots = 1;
    v_downwards_ = type == "obj";
    if (type == "obj" || type == "ply") {
      const std::string path = file(node);
      WarningList warnings;
      Mesh mesh = type == "ply" ? read_binary_ply(path, face_weights_)
                                : read_obj({path, path}, PathPolicy(folder_of(path), false),
                                           MtlDialect::standard, warnings)
                                      .mesh;
      instance.world_from_object = instance.world_from_object * glm::translate(mat4(1), vec3(mesh.origin));
      slots = mesh.slot_names.size();
      instance.shape = std::make_shared<const Mesh>(std::move(mesh));
    } else if (type == "sphere") {
      instance.shape = SphereShape{number(node, "radius", 1)};
    } else if (type == "rectangle") {
      instance.shape = RectangleShape{};
    } else {
      throw unknown("shape", node);
    }
    const int index = material(node.child("bsdf") ? node.child("bsdf") : named(node.child("ref")));
    for (const Node& reference : node.children("ref"))
      if (std::string_view(reference.attribute("name").value()) == "interior")
        document_.scene.materials[static_cast<std::size_t>(index)].medium = reference.attribute("id").value();
    if (const Node light = node.child("emitter"))
      document_.scene.materials[static_cast<std::size_t>(index)].emission =
          color_of(child(light, "radiance"));
    instance.materials.assign(slots, index);
    document_.scene.instances.push_back(instance);
  }

  Node named(const Node& reference) const {
    const auto found = named_.find(reference.attribute("id").value());
    if (found == named_.end()) throw unknown("name", reference);
    return found->second;
  }

  /// A constant, or a texture inside of `node` or named by it.
  void set(Material& material, const char* key, const Node& node) {
    const ParameterRef parameter = find_parameter(material, key);
    if (!parameter) throw std::runtime_error(std::string("no parameter ") + key);
    const std::string_view kind = node.name();
    if (kind == "ref" || kind == "texture")
      texture(parameter, kind == "ref" ? named(node) : node);
    else if (parameter.number != nullptr)
      *parameter.number = numbers(node.attribute("value").value()).at(0);
    else
      *parameter.color = color_of(node);
  }
  /// Each pair: our key, theirs. What the file does not give keeps our default.
  void set_all(Material& material, const Node& bsdf,
               std::initializer_list<std::pair<const char*, const char*>> keys) {
    for (const auto& [ours, theirs] : keys)
      if (const Node value = child(bsdf, theirs)) set(material, ours, value);
  }

  void texture(const ParameterRef& parameter, const Node& node) {
    const std::string type = node.attribute("type").value();
    TextureUse& use = parameter.use();
    Texture made;
    if (type == "bitmap") {
      static const std::map<std::string, TextureWrap> wraps = {
          {"repeat", TextureWrap::repeat}, {"mirror", TextureWrap::mirror}, {"clamp", TextureWrap::clamp}};
      const std::string path = file(node);
      made.model = ImageTexture{path, read_texels(path)};
      use.filter = text(node, "filter_type", "bilinear") == "nearest" ? TextureFilter::nearest
                                                                      : TextureFilter::bilinear;
      use.wrap = wraps.at(text(node, "wrap_mode", "repeat"));
      use.color_space = text(node, "raw", "false") == "true" ? ColorSpace::linear : ColorSpace::srgb;
    } else if (type == "checkerboard") {
      // Half as wide as ours; "color0" touches (0, 0).
      vec3 even = color_of(child(node, "color0")), odd = color_of(child(node, "color1"));
      if (patterns_upside_down_) std::swap(even, odd);
      made.model = CheckerTexture{even, odd, 2};
    } else if (type == "mesh_attribute") {
      using Attribute = MeshAttributeTexture::Attribute;
      const bool vertex = text(node, "name", "").starts_with("vertex_");
      made.model = MeshAttributeTexture{vertex ? Attribute::vertex_color : Attribute::face_color};
    } else {
      throw unknown("texture", node);
    }
    // Mitsuba counts v of OBJ files downwards, as it counts the rows of pictures.
    const mat4 to_uv = transform(node, "to_uv");
    use.uv.scale = {to_uv[0][0], to_uv[1][1]};
    use.uv.offset = vec2(to_uv[3]);
    if (v_downwards_) use.uv.offset.y += use.uv.scale.y, use.uv.scale.y *= -1;
    if (made.image() != nullptr) use.uv.offset.y = 1 - use.uv.offset.y, use.uv.scale.y *= -1;
    if (parameter.number != nullptr)
      *parameter.number = [&] {
        NumberParameter p = 1.0f;
        p.use = use;
        return p;
      }();
    else
      *parameter.color = [&] {
        ColorParameter p = vec3(1);
        p.use = use;
        return p;
      }();
    parameter.use().texture = static_cast<int>(document_.scene.textures.size());
    made.name = "texture " + std::to_string(document_.scene.textures.size());
    document_.scene.textures.push_back(std::make_shared<const Texture>(std::move(made)));
  }

  int add(Material material) {
    auto& all = document_.scene.materials;
    material.name = "material " + std::to_string(all.size());
    all.push_back(std::move(material));
    return static_cast<int>(all.size()) - 1;
  }

  /// Index of the material of a surface.
  int material(const Node& bsdf) {
    const std::string type = bsdf.attribute("type").value();
    if (type == "mask") {
      const int inside = material(bsdf.child("bsdf"));
      set_all(document_.scene.materials[static_cast<std::size_t>(inside)], bsdf, {{"opacity", "opacity"}});
      return inside;
    }
    Material whole;
    if (type == "twosided") {
      const int both = add(closure(bsdf.child("bsdf")));
      whole.model = TwoSidedMaterial{both, both};
    } else if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric" ||
               type == "null") {
      return add(closure(bsdf));
    } else {
      whole.model = TwoSidedMaterial{add(closure(bsdf)), -1};
    }
    return add(whole);
  }

  /// What scatters, as if on both sides.
  Material closure(const Node& bsdf) {
    const std::string type = bsdf.attribute("type").value();
    Material m;
    if (type == "normalmap") {
      m = closure(bsdf.child("bsdf"));
      set(m, "normal_map", child(bsdf, "normalmap"));
    } else if (type == "diffuse") {
      m.model = DiffuseMaterial{vec3(0.5f)};
      set_all(m, bsdf, {{"diffuse", "reflectance"}});
    } else if (type == "blendbsdf") {
      const Node first = bsdf.child("bsdf"), second = first.next_sibling("bsdf");
      const int a = add(closure(first)), b = add(closure(second));
      m.model = BlendMaterial{a, b};
      set_all(m, bsdf, {{"weight", "weight"}});
    } else if (type == "plastic" || type == "roughplastic") {
      m.model =
          PlasticMaterial{.ior = relative_ior(bsdf, "polypropylene"),
                          .roughness = type == "plastic" ? 0.0f : std::sqrt(number(bsdf, "alpha", 0.1f)),
                          .distribution = distribution(bsdf),
                          .nonlinear = text(bsdf, "nonlinear", "false") == "true"};
      set_all(m, bsdf, {{"diffuse", "diffuse_reflectance"}});
    } else if (type == "conductor" || type == "roughconductor") {
      m.model =
          ConductorMaterial{.metal = 0,
                            .roughness = type == "conductor" ? 0.0f : std::sqrt(number(bsdf, "alpha", 0.1f)),
                            .distribution = distribution(bsdf),
                            .energy_compensation = false};
      if (!child(bsdf, "eta")) throw unknown("metal", bsdf);
      set_all(m, bsdf, {{"eta", "eta"}, {"k", "k"}});
    } else if (type == "dielectric") {
      m.model = DielectricMaterial{relative_ior(bsdf, "bk7")};
    } else if (type == "roughdielectric") {
      m.model = RoughDielectricMaterial{.ior = relative_ior(bsdf, "bk7"),
                                        .roughness = std::sqrt(number(bsdf, "alpha", 0.1f)),
                                        .distribution = distribution(bsdf),
                                        .energy_compensation = false};
    } else if (type == "thindielectric") {
      m.model = ThinDielectricMaterial{relative_ior(bsdf, "bk7")};
    } else if (type == "null") {
      m.model = NullMaterial{};
    } else if (type == "principled") {
      m.model = PrincipledMaterial{};
      for (const Node& value : bsdf.children()) set(m, value.attribute("name").value(), value);
    } else {
      throw unknown("bsdf", bsdf);
    }
    return m;
  }

  static int distribution(const Node& bsdf) {
    return text(bsdf, "distribution", "beckmann") == "ggx" ? 0 : 1; // kMicrofacetDistributionNames
  }

  Document document_;
  bool patterns_upside_down_;
  int max_depth_ = 2;
  bool v_downwards_ = false;  ///< of the shape that is being read
  bool face_weights_ = false; ///< they stand for the colours of faces
  std::vector<std::unique_ptr<pugi::xml_document>> files_;
  std::vector<fs::path> folders_; ///< where files are looked for; the first is the scene's
  std::map<std::string, Node> named_;
  std::map<std::string, std::string> defaults_;
};

} // namespace

Document read_mitsuba_scene(const std::string& path, bool patterns_upside_down) {
  return Reader(path, patterns_upside_down).take();
}

} // namespace candela::test
