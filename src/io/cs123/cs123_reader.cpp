#include "io/cs123/cs123_reader.h"

#include "io/candela/json_transform.h"
#include "io/cs123/cs123_light.h"
#include "io/cs123/cs123_material.h"
#include "io/files/apart.h"
#include "io/files/text_file.h"
#include "io/obj/obj_line.h"

#include <fmt/format.h>

#include <set>

namespace candela {

namespace {

using glm::dmat4;
using glm::dvec3;

constexpr std::size_t kMaxXmlBytes = std::size_t{64} << 20;
constexpr int kMaxTreeDepth = 64;
constexpr std::size_t kMaxInstances = 1'000'000;
/// Share of the reading time that parsing takes.
constexpr double kSyntaxShare = 0.5;
constexpr std::size_t kMaxTransblocks = 4'000'000;

struct Cs123Shape {
  Shape shape;
  dmat4 unit_from_shape{1.0};
};

/// A primitive: all fit the cube of side 1 about the origin; the axis is y.
std::optional<Cs123Shape> cs123_shape(std::string_view kind) {
  const dmat4 y_from_z = rotation({1, 0, 0}, -90);
  const dmat4 half_down = glm::translate(dmat4(1), {0, -0.5, 0});
  if (kind == "sphere") return Cs123Shape{SphereShape{0.5f}, y_from_z}; // so stand its textures
  if (kind == "cube") return Cs123Shape{CubeShape{}, glm::scale(dmat4(1), dvec3(0.5))};
  if (kind == "cylinder") return Cs123Shape{CylinderShape{0.5f, 1, true}, half_down * y_from_z};
  if (kind == "cone") return Cs123Shape{ConeShape{0.5f, 1, true}, half_down * y_from_z};
  if (kind == "torus") return Cs123Shape{TorusShape{0.375f, 0.125f}, y_from_z};
  return std::nullopt;
}

class Cs123Reader {
public:
  Cs123Reader(const FoundFile& file, const PathPolicy& policy, WarningList& warnings)
      : file_(file), folder_(folder_of(file.shown)), text_(std::make_shared<const std::string>(read_text_file(
                                                         file.canonical, "scene", kMaxXmlBytes, &warnings))),
        places_(file.shown, *text_), progress_(warnings.part(file.canonical, text_->size())),
        values_(places_, warnings), builder_(document_.scene, policy, MtlDialect::cs123, warnings) {}

  Document run() {
    pugi::xml_node scene = parse();
    expect_files(scene, 0);
    progress_.reach(kSyntaxShare);
    Camera& camera = document_.scene.camera;
    camera.position = vec3(5), camera.target = vec3(4), camera.vertical_fov = radians(45.0f);
    for (pugi::xml_node part : scene.children()) {
      if (part.type() != pugi::node_element) continue;
      std::string_view name = part.name();
      if (name == "globaldata")
        global_data(part);
      else if (name == "cameradata")
        camera_data(part);
      else if (name == "lightdata")
        add_cs123_light(document_.scene, builder_, read_cs123_light(part, values_));
      else if (name == "object")
        declare(part);
      else
        values_.ignore(part);
    }
    auto root = trees_.find("root");
    if (root == trees_.end())
      throw input_error(places_.element(scene), "scenefile", "it has no tree named root",
                        "add <object type=\"tree\" name=\"root\">");
    tree(root->second, dmat4(1), 1);
    return std::move(document_);
  }

private:
  pugi::xml_node parse() {
    auto result = run_apart(&progress_, nullptr, [text = text_, xml = xml_](ProgressPart*, WarningList*) {
      // Offsets refer to the text only without encoding conversion.
      return xml->load_buffer(text->data(), text->size(), pugi::parse_default, pugi::encoding_utf8);
    });
    if (!result)
      throw input_error(places_.offset(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
                        "XML", result.description(), "correct the syntax here");
    pugi::xml_node scene = xml_->child("scenefile");
    if (!scene) {
      pugi::xml_node first = xml_->document_element();
      throw input_error(first ? places_.element(first) : Location{file_.shown}, "scene",
                        fmt::format("<{}> is no CS123 scene", std::string_view(first.name()).substr(0, 40)),
                        "give a file with <scenefile>");
    }
    return scene;
  }

  /// Announces the files that will be read, for the progress.
  void expect_files(pugi::xml_node node, int depth) {
    if (depth > 3 * kMaxTreeDepth) return; // reported later
    progress_.check();
    for (const char* key : {"filename", "file"})
      if (auto name = node.attribute(key)) builder_.expect_file(name.value(), folder_);
    for (pugi::xml_node child : node.children()) expect_files(child, depth + 1);
  }

  void global_data(pugi::xml_node data) {
    for (pugi::xml_node part : data.children()) {
      if (part.type() != pugi::node_element) continue;
      std::string_view name = part.name();
      if (name == "diffusecoeff" || name == "kd")
        global_.diffuse = coefficient(part);
      else if (name == "specularcoeff" || name == "ks")
        global_.specular = coefficient(part);
      else if (name == "transparentcoeff" || name == "kt")
        global_.transparent = coefficient(part);
      else if (name != "ambientcoeff" && name != "ka")
        values_.ignore(part);
    }
  }

  float coefficient(pugi::xml_node part) {
    float v = values_.number(part, {"v", "value"});
    if (v < 0)
      throw input_error(places_.element(part), part.name(), fmt::format("{} is negative", v),
                        "give a number from 0");
    return v;
  }

  void camera_data(pugi::xml_node data) {
    if (has_camera_)
      throw input_error(places_.element(data), "cameradata", "there is a second camera", "keep one of them");
    has_camera_ = true;
    Camera& camera = document_.scene.camera;
    std::optional<vec3> look, focus;
    for (pugi::xml_node part : data.children()) {
      if (part.type() != pugi::node_element) continue;
      std::string_view name = part.name();
      if (name == "pos")
        camera.position = values_.vector(part);
      else if (name == "up")
        camera.up = values_.vector(part);
      else if (name == "look")
        look = values_.vector(part), focus.reset();
      else if (name == "focus")
        focus = values_.vector(part), look.reset();
      else if (name == "heightangle")
        height_angle(part);
      else
        values_.ignore(part);
    }
    camera.target = focus ? *focus : camera.position + look.value_or(vec3(-1));
    dvec3 view = dvec3(camera.target) - dvec3(camera.position);
    if (view == dvec3(0) || glm::cross(view, dvec3(camera.up)) == dvec3(0))
      throw input_error(places_.element(data), "cameradata",
                        view == dvec3(0) ? "it looks nowhere: focus is pos, or look is zero"
                                         : "up is parallel to the view",
                        "move one of them");
  }

  void height_angle(pugi::xml_node part) {
    const auto* row = find_setting("camera.vertical_fov");
    float deg = values_.number(part, {"v", "angle", "value"});
    if (!(deg >= static_cast<float>(row->minimum) && deg <= static_cast<float>(row->maximum)))
      throw input_error(places_.element(part), "heightangle", fmt::format("{} is out of range", deg),
                        fmt::format("give {}", field_domain(*row)));
    document_.scene.camera.vertical_fov =
        static_cast<float>(static_cast<double>(deg) * (std::numbers::pi / 180));
  }

  void declare(pugi::xml_node object) {
    std::string name = object.attribute("name").value();
    if (std::string_view(object.attribute("type").value()) != "tree" || name.empty())
      throw input_error(places_.element(object), "object", "only named trees stand at the top",
                        "write <object type=\"tree\" name=\"…\">");
    if (!trees_.emplace(name, object).second)
      throw input_error(places_.element(object), "object",
                        fmt::format("there is a second tree '{}'", name.substr(0, 60)),
                        "give it another name");
  }

  void tree(pugi::xml_node object, const dmat4& world_from_tree, int depth) {
    if (depth > kMaxTreeDepth)
      throw limit_error(places_.element(object), "object",
                        fmt::format("more than {} levels of trees", kMaxTreeDepth), "flatten the scene");
    for (pugi::xml_node part : object.children()) {
      if (part.type() != pugi::node_element) continue;
      if (std::string_view(part.name()) == "transblock")
        transblock(part, world_from_tree, depth);
      else
        values_.ignore(part);
    }
  }

  void transblock(pugi::xml_node block, dmat4 m, int depth) {
    values_.warnings().check_stop();
    if (++transblocks_ > kMaxTransblocks)
      throw limit_error(places_.element(block), "transblock",
                        fmt::format("more than {} of them", kMaxTransblocks), "nest fewer master objects");
    bool done = false;
    for (pugi::xml_node part : block.children()) {
      if (part.type() != pugi::node_element) continue;
      std::string_view name = part.name();
      if (done)
        values_.warnings().add(places_.element(part), "what follows the object of a transblock is ignored");
      else if (name == "object")
        object(part, m, depth), done = true;
      else if (name == "translate")
        m = m * glm::translate(dmat4(1), dvec3(values_.vector(part)));
      else if (name == "scale")
        m = m * glm::scale(dmat4(1), dvec3(values_.vector(part)));
      else if (name == "rotate")
        m = m * rotate(part);
      else if (name == "matrix")
        m = m * matrix(part);
      else
        values_.ignore(part);
    }
    if (!done) values_.warnings().add(places_.element(block), "a transblock without an object is ignored");
  }

  dmat4 rotate(pugi::xml_node part) {
    dvec3 axis(values_.vector(part));
    double deg = static_cast<double>(values_.number(part, {"angle", "v"}));
    if (axis == dvec3(0))
      throw input_error(places_.element(part), "rotate", "the axis has no length", "give x, y, z and angle");
    return rotation(axis, deg);
  }

  dmat4 matrix(pugi::xml_node part) {
    std::vector<float> v;
    if (part.child("row")) {
      for (pugi::xml_node row : part.children("row"))
        for (auto names : {std::initializer_list<const char*>{"a", "v1", "x"},
                           {"b", "v2", "y"},
                           {"c", "v3", "z"},
                           {"d", "v4", "w"}})
          v.push_back(values_.number(row, names));
    } else {
      std::string text = part.child_value();
      for (char& c : text)
        if (c == '\n' || c == '\r' || c == ',') c = ' ';
      std::string_view rest = text;
      for (std::string_view word = next_word(rest); !word.empty() && v.size() <= 16; word = next_word(rest))
        v.push_back(values_.parse(word, part, places_.element(part)));
    }
    if (v.size() != 16)
      throw input_error(places_.element(part), "matrix", fmt::format("{} numbers", v.size()),
                        "give 16 numbers, row by row");
    dmat4 m;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) m[c][r] = static_cast<double>(v[static_cast<std::size_t>(4 * r + c)]);
    return m;
  }

  void object(pugi::xml_node node, const dmat4& m, int depth) {
    std::string_view type = node.attribute("type").value();
    std::string name = node.attribute("name").value();
    if (type == "primitive") return primitive(node, name, m);
    bool has_content = !node.first_child().empty();
    if (type == "tree" && (has_content || name.empty())) return tree(node, m, depth + 1);
    if (type == "master" || type == "tree") return instance_of_master(node, name, m, depth);
    auto attribute = node.attribute("type");
    throw input_error(attribute ? places_.attribute(attribute, node) : places_.element(node), "object",
                      fmt::format("there is no object type '{}'", type.substr(0, 40)),
                      "give tree, master or primitive");
  }

  void instance_of_master(pugi::xml_node node, const std::string& name, const dmat4& m, int depth) {
    auto master = trees_.find(name);
    if (master == trees_.end()) {
      std::vector<std::string_view> names;
      for (const auto& [key, tree_node] : trees_) names.push_back(key);
      std::string near = nearest_name(name, names);
      throw input_error(places_.element(node), "object",
                        fmt::format("there is no master object '{}'", name.substr(0, 60)),
                        near.empty() ? "declare it as <object type=\"tree\" name=\"…\"> at the top"
                                     : fmt::format("did you mean '{}'?", near));
    }
    if (name == "root" || !open_masters_.insert(name).second)
      throw input_error(places_.element(node), "object",
                        fmt::format("'{}' contains itself", name.substr(0, 60)),
                        "take the instance out of its own tree");
    tree(master->second, m, depth + 1);
    open_masters_.erase(name);
  }

  void primitive(pugi::xml_node node, const std::string& kind, const dmat4& m) {
    if (document_.scene.instances.size() >= kMaxInstances)
      throw limit_error(places_.element(node), "object", fmt::format("more than {} instances", kMaxInstances),
                        "merge meshes, or nest fewer master objects");
    if (auto problem = transform_problem(m); !problem.empty())
      throw input_error(places_.element(node), "transblock", problem, "correct its transformations");
    Instance instance;
    if (kind == "mesh") {
      mesh(node, instance, m);
    } else if (auto shape = cs123_shape(kind)) {
      instance.name = kind;
      instance.shape = shape->shape;
      instance.world_from_object = mat4(m * shape->unit_from_shape);
      int own = own_material(node, kind);
      instance.materials = {own >= 0 ? own : builder_.default_material()};
    } else {
      auto attribute = node.attribute("name");
      throw input_error(attribute ? places_.attribute(attribute, node) : places_.element(node), "object",
                        fmt::format("there is no primitive '{}'", kind.substr(0, 40)),
                        "give cube, cylinder, cone, sphere, torus or mesh");
    }
    document_.scene.instances.push_back(std::move(instance));
  }

  /// Index of the object's own material, -1 if it has none. Instances of a master object share it.
  int own_material(pugi::xml_node node, const std::string& kind) {
    auto [known, is_new] = own_materials_.try_emplace(node.internal_object(), -1);
    if (!is_new) return known->second;
    auto material = cs123_material(node, values_, global_, builder_.policy(), folder_);
    if (material)
      known->second =
          add_mtl_material(builder_, *material, fmt::format("{} {}", kind.substr(0, 40), ++own_count_));
    return known->second;
  }

  void mesh(pugi::xml_node node, Instance& instance, const dmat4& m) {
    auto attribute = node.attribute("filename") ? node.attribute("filename") : node.attribute("file");
    if (!attribute)
      throw input_error(places_.element(node), "object", "a mesh without a file", "write filename=\"….obj\"");
    Location where = places_.attribute(attribute, node);
    // The course's scenes have absolute paths of the machines on which they were created.
    auto found =
        builder_.policy().find_exported(attribute.value(), folder_, where, "filename", builder_.warnings());
    if (!found) found = builder_.policy().require(attribute.value(), folder_, where, "filename");
    MeshFile& file = builder_.mesh_file(*found, "", where, "filename");
    instance.name = file.mesh->name;
    instance.shape = file.mesh;
    builder_.place(instance, m, where);
    for (std::size_t slot = 0; slot < file.mesh->slot_names.size(); ++slot) {
      int material = builder_.imported_material(file, slot);
      if (material < 0) material = own_material(node, "mesh");
      if (material < 0) material = builder_.missing_material(file, slot, where);
      instance.materials.push_back(material);
    }
  }

  FoundFile file_;
  std::string folder_;
  std::shared_ptr<const std::string> text_;
  XmlPlaces places_;
  ProgressPart progress_;
  Cs123Values values_;
  std::shared_ptr<pugi::xml_document> xml_ = std::make_shared<pugi::xml_document>();
  Document document_;
  SceneBuilder builder_;
  Cs123Coefficients global_;
  bool has_camera_ = false;
  std::map<std::string, pugi::xml_node, std::less<>> trees_;
  std::set<std::string> open_masters_;
  std::size_t transblocks_ = 0;
  std::map<const void*, int> own_materials_; ///< by node
  int own_count_ = 0;
};

} // namespace

Document read_cs123(const FoundFile& file, const PathPolicy& policy, WarningList& warnings) {
  return Cs123Reader(file, policy, warnings).run();
}

} // namespace candela
