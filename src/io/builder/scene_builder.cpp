#include "io/builder/scene_builder.h"

#include "io/curves/curves_file.h"
#include "io/files/text_file.h"
#include "io/ies/ies_reader.h"
#include "io/images/panorama_reader.h"
#include "io/images/texels_reader.h"
#include "io/volumes/volume_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace candela {

void SceneBuilder::expect_file(const std::string& reference, const std::string& folder) {
  if (!expected_.insert(reference).second) return;
  try {
    if (auto file = policy_.find(reference, folder, {}, "")) warnings_.expect_file(file->canonical);
  } catch (const Error&) {} // reported when the file is read
}

MeshFile& SceneBuilder::mesh_file(const FoundFile& file, const std::string& name, const Location& where,
                                  std::string_view element) {
  auto& by_name = meshes_[file.canonical];
  if (by_name.empty()) {
    if (lower_ending(file.shown) != ".obj")
      throw input_error(where, element, fmt::format("'{}' is no mesh file that can be read", file.shown),
                        "give an OBJ file");
    ObjModel model = read_obj(file, policy_, dialect_, warnings_);
    std::string key = name.empty() ? model.mesh.name : name;
    model.mesh.name = key;
    std::vector<int> none(model.materials.size(), -1);
    return by_name[key] = {std::make_shared<const Mesh>(std::move(model.mesh)), std::move(model.materials),
                           none};
  }
  const MeshFile& first = by_name.begin()->second;
  std::string key = name;
  if (key.empty()) key = std::filesystem::path(file.shown).stem().string();
  if (auto known = by_name.find(key); known != by_name.end()) return known->second;
  Mesh renamed = *first.mesh;
  renamed.name = key;
  std::vector<int> none(first.mtl.size(), -1);
  return by_name[key] = {std::make_shared<const Mesh>(std::move(renamed)), first.mtl, none};
}

std::shared_ptr<const Strands> SceneBuilder::strands(const FoundFile& file) {
  auto& known = strands_[file.canonical];
  if (!known) known = read_curves_file(file.canonical, warnings_);
  return known;
}

int SceneBuilder::texture(const FoundFile& file) {
  if (auto known = textures_.find(file.canonical); known != textures_.end()) return known->second;
  return append_texture(file);
}

int SceneBuilder::texture_or_none(const FoundFile& file, const Location& where) {
  if (broken_textures_.contains(file.canonical)) return -1;
  try {
    return texture(file);
  } catch (const Error& problem) {
    broken_textures_.insert(file.canonical);
    warnings_.add(where, fmt::format("no texture: {}", problem.what()));
    return -1;
  }
}

std::shared_ptr<const Texels> SceneBuilder::texels_of(const std::string& path) {
  auto texels = read_texels(path, warnings_);
  for (const auto& texture : scene_.textures) // another file may have the same pixels
    if (const auto* image = texture->image(); image != nullptr && *image->texels == *texels)
      return image->texels;
  return texels;
}

int SceneBuilder::append_texture(const FoundFile& file, const std::string& name) {
  auto known = textures_.find(file.canonical);
  auto texture =
      known == textures_.end() ? nullptr : scene_.textures[static_cast<std::size_t>(known->second)];
  const std::string own_name =
      name.empty() ? std::filesystem::path(file.canonical).filename().string() : name;
  if (!texture || texture->name != own_name)
    texture = std::make_shared<const Texture>(
        Texture{own_name, ImageTexture{file.canonical,
                                       texture ? texture->image()->texels : texels_of(file.canonical)}});
  return append_texture(std::move(texture), &file);
}

int SceneBuilder::append_texture(std::shared_ptr<const Texture> texture, const FoundFile* file) {
  auto index = static_cast<int>(scene_.textures.size());
  scene_.textures.push_back(std::move(texture));
  if (file != nullptr) textures_.try_emplace(file->canonical, index);
  return index;
}

std::shared_ptr<const Panorama> SceneBuilder::panorama(const std::vector<FoundFile>& files) {
  std::vector<std::string> paths;
  for (const FoundFile& file : files) paths.push_back(file.canonical);
  auto& panorama = panoramas_[paths];
  if (!panorama) panorama = read_panorama(paths, warnings_);
  return panorama;
}

std::shared_ptr<const IesProfile> SceneBuilder::profile(const FoundFile& file) {
  auto& profile = profiles_[file.canonical];
  if (!profile) profile = read_ies(file.canonical, warnings_);
  return profile;
}

std::shared_ptr<const VolumeGrid> SceneBuilder::volume(const FoundFile& file) {
  auto& volume = volumes_[file.canonical];
  if (!volume) volume = read_volume(file.canonical, warnings_);
  return volume;
}

std::string SceneBuilder::unused_material_name(const std::string& wish) const {
  std::string name = wish;
  for (int i = 2; material_names_.contains(name); ++i) name = fmt::format("{}-{}", wish, i);
  return name;
}

int SceneBuilder::add_material(Material material) {
  material_names_.insert(material.name);
  scene_.materials.push_back(std::move(material));
  return static_cast<int>(scene_.materials.size()) - 1;
}

void SceneBuilder::set_material_part(int material, const MaterialField& row, int part) {
  *static_cast<int*>(row.address(scene_.materials[static_cast<std::size_t>(material)])) = part;
}

int add_mtl_material(SceneBuilder& builder, const MtlMaterial& source, const std::string& name) {
  Material material = source.material;
  material.name = name;
  for (const MtlTexture& map : source.textures) {
    const int texture = builder.texture_or_none(map.file, map.where);
    const ParameterRef parameter = find_parameter(material, map.key);
    if (texture < 0 || !parameter) continue;
    parameter.use() = map.use;
    parameter.use().texture = texture;
  }
  return builder.add_material(std::move(material));
}

int SceneBuilder::imported_material(MeshFile& file, std::size_t slot) {
  if (!file.mtl[slot]) return -1;
  int& index = file.imported[slot];
  if (index < 0)
    index = add_mtl_material(
        *this, *file.mtl[slot],
        unused_material_name(fmt::format("{}/{}", file.mesh->name, file.mesh->slot_names[slot])));
  return index;
}

int SceneBuilder::default_material() {
  if (default_material_ < 0) {
    Material grey;
    grey.name = unused_material_name("default");
    default_material_ = add_material(std::move(grey));
  }
  return default_material_;
}

int SceneBuilder::vertex_color_material() {
  if (vertex_color_material_ < 0) {
    Material colored;
    colored.name = unused_material_name("vertex colors");
    DiffuseMaterial matte;
    matte.diffuse.value = vec3(1);
    const std::string name(MeshAttributeTexture::kName);
    matte.diffuse.use.texture =
        append_texture(std::make_shared<const Texture>(Texture{name, MeshAttributeTexture()}));
    colored.model = matte;
    vertex_color_material_ = add_material(std::move(colored));
  }
  return vertex_color_material_;
}

int SceneBuilder::missing_material(const MeshFile& file, std::size_t slot, const Location& where) {
  const std::string& name = file.mesh->slot_names[slot];
  constexpr std::size_t kLongestName = 100;
  const bool has_colors = !file.mesh->vertex_colors.empty();
  const std::string_view instead =
      has_colors ? "one with the colours of its vertices is used" : "a grey one is used";
  warnings_.add(where, name.empty() ? fmt::format("faces without a material: {}", instead)
                                    : fmt::format("there is no material '{}': {}",
                                                  name.substr(0, kLongestName), instead));
  return has_colors ? vertex_color_material() : default_material();
}

void SceneBuilder::place(Instance& instance, const glm::dmat4& world_from_object, const Location& where) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  instance.world_from_object =
      mat4(mesh ? glm::translate(world_from_object, (*mesh)->origin) : world_from_object);
  if (!mesh) return;
  // Errors below this part of a mesh's size are invisible.
  constexpr double kInvisible = 0x1p-13;
  const Bounds3 bounds = instance_bounds({instance});
  const vec3 most = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
  const float far = max_component(most);
  const double size = static_cast<double>(glm::length(bounds.diagonal()));
  const double step = static_cast<double>(std::nextafter(far, std::numeric_limits<float>::max()) - far);
  if (size > 0 && step > kInvisible * size)
    warnings_.add(where,
                  fmt::format("a mesh of size {:.3g} lies {:.3g} from the origin, where floats are {:.2g} "
                              "apart: it loses its shape; move the scene to the origin",
                              size, far, step));
}

Bounds3 object_bounds(const Shape& shape) { return shape_bounds(shape); }

Bounds3 scene_bounds(const SceneDesc& scene) { return instance_bounds(scene.instances); }

bool has_light(const SceneDesc& scene) {
  auto glows = [&](const std::string& medium) {
    const auto known = std::ranges::find(scene.media, medium, &MediumDesc::name);
    return known != scene.media.end() && !is_black(known->emission);
  };
  auto shines = [&](int index) {
    const Material& material = scene.materials[static_cast<std::size_t>(index)];
    return !is_black(material.emission.value) || glows(material.medium);
  };
  return glows(scene.medium) ||
         std::ranges::any_of(scene.lights,
                             [](const LightDesc& l) { return l.scale > 0 && !is_black(l.color); }) ||
         std::ranges::any_of(scene.instances,
                             [&](const Instance& i) { return std::ranges::any_of(i.materials, shines); });
}

void frame_camera(Camera& camera, const Bounds3& bounds) {
  float radius = std::max(0.5f * glm::length(bounds.diagonal()), 1e-6f);
  // A sphere about the bounds touches the view cone; a little more leaves a margin.
  float distance = 1.05f * radius / std::sin(0.5f * camera.vertical_fov);
  camera.target = bounds.center();
  camera.position = camera.target + distance * glm::normalize(vec3(0.3f, 0.25f, 1));
  camera.up = {0, 1, 0};
  camera.orthographic_height = std::min(2 * 1.05f * radius, Camera::kGreatestHeight);
}

} // namespace candela
