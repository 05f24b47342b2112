#include "scene/document.h"

#include "materials/material_parts.h"
#include "scene/light_layers.h"

#include <fmt/format.h>

#include <set>

namespace candela {

namespace {

template <class T>
bool same_value(const std::shared_ptr<const T>& a, const std::shared_ptr<const T>& b) {
  return a == b || (a && b && *a == *b);
}

bool same_light(const LightDesc& a, const LightDesc& b) {
  if (!same_value(light_panorama(a), light_panorama(b)) || !same_value(light_profile(a), light_profile(b)))
    return false;
  LightDesc c = b;
  if (takes_panorama(c)) set_panorama(c, light_panorama(a));
  if (takes_profile(c)) set_profile(c, light_profile(a));
  return a == c;
}

bool same_medium(const MediumDesc& a, const MediumDesc& b) {
  if (!same_value(medium_grid(a), medium_grid(b))) return false;
  MediumDesc c = b;
  if (takes_grid(c)) set_medium_grid(c, medium_grid(a));
  return a == c;
}

bool same_shape(const Shape& a, const Shape& b) {
  const auto* mesh_a = std::get_if<std::shared_ptr<const Mesh>>(&a);
  const auto* mesh_b = std::get_if<std::shared_ptr<const Mesh>>(&b);
  if (mesh_a && mesh_b) return same_value(*mesh_a, *mesh_b);
  const auto *curves_a = std::get_if<CurvesShape>(&a), *curves_b = std::get_if<CurvesShape>(&b);
  if (!curves_a || !curves_b) return a == b;
  CurvesShape c = *curves_b;
  c.strands = curves_a->strands;
  return same_value(curves_a->strands, curves_b->strands) && *curves_a == c;
}

Invalidates compare_material(const Material& a, const Material& b) {
  if (a.model.index() != b.model.index()) return material_type_field().invalidates;
  auto &x = const_cast<Material&>(a), &y = const_cast<Material&>(b);
  Invalidates worst = Invalidates::nothing;
  for (const MaterialField& row : material_fields(a)) {
    const bool same = row.parameter != nullptr ? row.parameter(x).equals(row.parameter(y))
                                               : field_equal(row, row.address(x), row.address(y));
    if (!same) worst = std::max(worst, row.invalidates);
  }
  return worst;
}

/// Some rows of materials affect shading alone, others also the lights.
Invalidates compare_materials(const std::vector<Material>& a, const std::vector<Material>& b) {
  if (a.size() != b.size()) return Invalidates::scene;
  Invalidates worst = Invalidates::nothing;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].medium != b[i].medium) worst = std::max(worst, Invalidates::image);
    if (!(a[i] == b[i])) worst = std::max(worst, compare_material(a[i], b[i]));
  }
  return worst;
}

template <class T>
std::string row_problem(std::span<const Field<T>> rows, const T& owner, std::string_view name) {
  for (const auto& row : rows)
    if (auto problem = field_problem(row, row.address(const_cast<T&>(owner))); !problem.empty())
      return fmt::format("{}{}: {}; give {}", name, row.key, problem, field_domain(row));
  return {};
}

std::string mesh_problem(const Mesh& mesh) {
  for (const uvec3& t : mesh.triangles)
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) return "a vertex index is out of range";
  for (std::uint32_t slot : mesh.material_slots)
    if (slot >= mesh.slot_names.size()) return "a material slot is out of range";
  auto fits = [](const std::vector<vec3>& colors, std::size_t count) {
    return colors.empty() || colors.size() == count;
  };
  if (!fits(mesh.positions_end, mesh.positions.size())) return "not every vertex has a position at time 1";
  if (mesh.deforms() && mesh.normals_end.size() != mesh.normals.size())
    return "not every normal has one at time 1";
  if (!fits(mesh.vertex_colors, mesh.positions.size())) return "not every vertex has a colour";
  if (!fits(mesh.face_colors, mesh.triangles.size())) return "not every face has a colour";
  return {};
}

/// `checked` holds the meshes and strands that need no second check: many instances may share one.
std::string instance_problem(const SceneDesc& scene, const Instance& instance, std::size_t index,
                             std::set<const void*>& checked) {
  std::size_t slots = 1;
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape)) {
    if (!*mesh) return fmt::format("instances[{}]: has no mesh", index);
    slots = (*mesh)->slot_names.size();
    if (checked.insert(mesh->get()).second)
      if (auto problem = mesh_problem(**mesh); !problem.empty())
        return fmt::format("instances[{}].mesh: {}", index, problem);
  } else if (auto problem = shape_problem(instance.shape); !problem.empty()) {
    return fmt::format("instances[{}].{}", index, problem);
  } else if (const auto* curves = std::get_if<CurvesShape>(&instance.shape)) {
    if (!curves->strands) return fmt::format("instances[{}]: has no strands", index);
    if (checked.insert(curves->strands.get()).second)
      if (auto wrong = strands_problem(*curves->strands); !wrong.empty())
        return fmt::format("instances[{}].{}", index, wrong);
  }
  if (instance.materials.size() != slots)
    return fmt::format("instances[{}].materials: {} given for {} slots", index, instance.materials.size(),
                       slots);
  for (int material : instance.materials)
    if (material < 0 || static_cast<std::size_t>(material) >= scene.materials.size())
      return fmt::format("instances[{}].materials: there is no material {}", index, material);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      if (!std::isfinite(instance.world_from_object[c][r]))
        return fmt::format("instances[{}].transform: is not finite", index);
  if (auto problem =
          row_problem(motion_fields(), instance.motion, fmt::format("instances[{}].motion.", index));
      !problem.empty())
    return problem;
  if (auto problem = motion_problem(instance.motion); !problem.empty())
    return fmt::format("instances[{}].motion.{}", index, problem);
  return {};
}

std::string view_problem(const Camera& camera) {
  vec3 forward = camera.target - camera.position;
  if (!(glm::length(forward) > 0)) return "target: is where the camera is";
  if (!(glm::length(glm::cross(glm::normalize(forward), camera.up)) > 1e-6f * glm::length(camera.up)))
    return "up: is zero or along the view";
  return {};
}

} // namespace

std::string camera_motion_problem(const Camera& camera) {
  if (!camera.moves()) return {};
  if (const std::string problem = view_problem(camera_at_end(camera)); !problem.empty())
    return fmt::format("motion_{} at time 1; give another motion", problem);
  return {};
}

namespace {

std::string bookmarks_problem(const std::vector<Bookmark>& bookmarks) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < bookmarks.size(); ++i) {
    if (bookmarks[i].name.empty()) return fmt::format("bookmarks[{}].name: is empty", i);
    if (!names.insert(bookmarks[i].name).second)
      return fmt::format("bookmarks[{}].name: there is another '{}'", i, bookmarks[i].name);
    if (auto p = camera_value_problem(bookmarks[i].camera); !p.empty())
      return fmt::format("bookmarks[{}].camera.{}", i, p);
  }
  return {};
}

} // namespace

std::string camera_value_problem(const Camera& camera) {
  constexpr std::string_view kPrefix = "camera.";
  Document document;
  document.scene.camera = camera;
  for (const auto& row : settings_table()) {
    if (!row.key.starts_with(kPrefix)) continue;
    if (auto problem = field_problem(row, row.address(document)); !problem.empty())
      return fmt::format("{}: {}; give {}", row.key.substr(kPrefix.size()), problem, field_domain(row));
  }
  if (auto problem = view_problem(camera); !problem.empty()) return problem;
  return camera_motion_problem(camera);
}

Invalidates compare_documents(const Document& before, const Document& after) {
  Invalidates worst = Invalidates::nothing;
  for (const auto& row : settings_table())
    if (!field_equal(row, row.address(const_cast<Document&>(before)),
                     row.address(const_cast<Document&>(after))))
      worst = std::max(worst,
                       row.address(const_cast<Document&>(after)) != &after.settings.view ||
                               accumulated_view(before.settings.view) != accumulated_view(after.settings.view)
                           ? row.invalidates
                           : Invalidates::display);
  if (before.scene.lights != after.scene.lights || before.scene.instances != after.scene.instances ||
      before.scene.textures != after.scene.textures)
    return Invalidates::scene;
  if (before.scene.media != after.scene.media || before.scene.medium != after.scene.medium)
    worst = std::max(worst, Invalidates::image);
  return std::max({worst, compare_materials(before.scene.materials, after.scene.materials),
                   compare_light_groups(before, after)});
}

bool same_content(const Document& a, const Document& b) {
  const SceneDesc &s = a.scene, &t = b.scene;
  if (a.settings != b.settings || s.description != t.description || s.camera != t.camera ||
      s.bookmarks != t.bookmarks || s.materials != t.materials || s.light_groups != t.light_groups ||
      !std::ranges::equal(s.media, t.media, same_medium) || s.medium != t.medium ||
      !std::ranges::equal(s.lights, t.lights, same_light) || s.instances.size() != t.instances.size() ||
      s.textures.size() != t.textures.size())
    return false;
  for (std::size_t i = 0; i < s.textures.size(); ++i)
    if (!same_value(s.textures[i], t.textures[i])) return false;
  for (std::size_t i = 0; i < s.instances.size(); ++i) {
    const Instance &x = s.instances[i], &y = t.instances[i];
    if (x.name != y.name || x.world_from_object != y.world_from_object || x.materials != y.materials ||
        x.motion != y.motion || !same_shape(x.shape, y.shape))
      return false;
  }
  return true;
}

std::string medium_name_problem(const SceneDesc& scene, const std::string& name) {
  if (name.empty() || std::ranges::find(scene.media, name, &MediumDesc::name) != scene.media.end()) return {};
  std::vector<std::string_view> names;
  for (const MediumDesc& medium : scene.media) names.push_back(medium.name);
  const std::string near = nearest_name(name, names);
  return fmt::format("there is no medium '{}'; {}", name,
                     near.empty() ? "give one of \"media\"" : fmt::format("did you mean '{}'?", near));
}

namespace {

std::string medium_names_problem(const SceneDesc& scene) {
  if (auto p = medium_name_problem(scene, scene.medium); !p.empty()) return "medium: " + p;
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (auto p = medium_name_problem(scene, scene.materials[i].medium); !p.empty())
      return fmt::format("materials[{}].medium: {}", i, p);
  return {};
}

} // namespace

std::string document_problem(const Document& document) {
  if (auto problem = row_problem(settings_table(), document, ""); !problem.empty()) return problem;
  const SceneDesc& scene = document.scene;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (auto p = material_problem(scene.materials[i], scene.textures.size()); !p.empty())
      return fmt::format("materials[{}].{}", i, p);
  }
  if (auto p = media_problem(scene.media); !p.empty()) return p;
  if (auto p = medium_names_problem(scene); !p.empty()) return p;
  if (auto p = parts_problem(scene.materials))
    return fmt::format("materials[{}].{}: {}; {}", p->material, p->key, p->cause, p->remedy);
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    if (!scene.textures[i]) return fmt::format("textures[{}]: there is none", i);
    if (auto p = texture_problem(*scene.textures[i]); !p.empty()) return fmt::format("textures[{}].{}", i, p);
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightDesc& light = scene.lights[i];
    if (auto p = light_problem(light); !p.empty()) return fmt::format("lights[{}].{}", i, p);
    if (auto panorama = light_panorama(light))
      if (auto p = panorama_problem(*panorama); !p.empty())
        return fmt::format("lights[{}].panorama: {}", i, p);
  }
  if (auto p = light_groups_problem(scene); !p.empty()) return p;
  std::set<const void*> checked;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    if (auto p = instance_problem(scene, scene.instances[i], i, checked); !p.empty()) return p;
  if (auto p = view_problem(scene.camera); !p.empty()) return "camera." + p;
  if (auto p = camera_motion_problem(scene.camera); !p.empty()) return "camera." + p;
  if (auto p = bookmarks_problem(scene.bookmarks); !p.empty()) return p;
  return {};
}

} // namespace candela
