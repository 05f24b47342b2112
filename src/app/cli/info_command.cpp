#include "app/cli/info_command.h"

#include "app/platform/streams.h"
#include "render/world/render_scene.h"
#include "scene/light_group.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <set>

namespace candela {

namespace {

/// The shortest decimal that reads back to the float: 548.8 rather than 548.7999877929688.
nlohmann::ordered_json number_json(float x) {
  return std::isfinite(x) ? nlohmann::ordered_json::parse(fmt::format("{}", x)) : nlohmann::ordered_json();
}

nlohmann::ordered_json vector_json(vec3 v) { return {number_json(v.x), number_json(v.y), number_json(v.z)}; }

/// The camera's values that affect its picture.
nlohmann::ordered_json camera_json(const Document& document) {
  const Camera& camera = document.scene.camera;
  nlohmann::ordered_json out = {{"projection", field_text(*find_setting("camera.projection"), document)},
                                {"position", vector_json(camera.position)},
                                {"target", vector_json(camera.target)},
                                {"up", vector_json(camera.up)}};
  if (camera.projection == Projection::orthographic) {
    out["orthographic_height"] = number_json(camera.orthographic_height);
  } else if (camera.has_elements()) {
    out["lens"] = field_text(*find_setting("camera.lens"), document);
    out["f_stop"] = number_json(camera.f_stop);
    out["sensor_diagonal"] = number_json(camera.sensor_diagonal);
    out["focus_distance"] = number_json(camera.effective_focus_distance());
  } else if (camera.projection == Projection::perspective) {
    out["vertical_fov"] =
        nlohmann::ordered_json::parse(field_text(*find_setting("camera.vertical_fov"), document));
  }
  if (camera.aspect > 0) out["aspect"] = number_json(camera.aspect);
  if (camera.stereo != Stereo::none) {
    out["stereo"] = field_text(*find_setting("camera.stereo"), document);
    out["interocular_distance"] = number_json(camera.interocular_distance);
    if (camera.convergence_distance > 0)
      out["convergence_distance"] = number_json(camera.convergence_distance);
  }
  if (camera.aperture_radius > 0 && !camera.has_elements()) {
    out["aperture_radius"] = number_json(camera.aperture_radius);
    out["focus_distance"] = number_json(camera.effective_focus_distance());
    if (camera.blades >= 3) out["blades"] = camera.blades;
  }
  return out;
}

} // namespace

int run_info(const SceneOptions& options) {
  check_stdout();
  LoadedScene loaded = load_scene(options);
  const SceneDesc& desc = loaded.document.scene;
  auto scene = RenderScene::build(loaded.document);
  const Geometry& geometry = scene->geometry();
  AccelStats accel = geometry.accel().stats();

  std::set<const Mesh*> meshes;
  std::size_t distinct = 0, placed = 0;
  for (const Instance& instance : desc.instances)
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape)) {
      placed += (*mesh)->triangles.size();
      if (meshes.insert(mesh->get()).second) distinct += (*mesh)->triangles.size();
    }

  nlohmann::ordered_json out;
  out["scene"] = options.path;
  out["files"] = nlohmann::ordered_json::array();
  for (const auto& [file, stamp] : loaded.files) {
    nlohmann::ordered_json entry = {{"path", file}};
    if (!stamp.exists) entry["missing"] = true;
    out["files"].push_back(std::move(entry));
  }
  out["instances"] = desc.instances.size();
  out["shapes"] = nlohmann::ordered_json::object();
  for (const Instance& instance : desc.instances) {
    auto& count = out["shapes"][std::string(shape_name(instance.shape))];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  out["meshes"] = meshes.size();
  out["triangles"] = {{"distinct", distinct}, {"placed", placed}};
  out["spheres"] = geometry.spheres().size();
  out["rectangles"] = geometry.rectangles().size();
  out["discs"] = geometry.discs().size();
  std::set<const Strands*> hair;
  std::size_t strands = 0;
  for (const Instance& instance : desc.instances)
    if (const auto* curves = std::get_if<CurvesShape>(&instance.shape))
      if (hair.insert(curves->strands.get()).second) strands += curves->strands->counts.size();
  out["curves"] = {{"strands", strands}, {"pieces", geometry.curves().segments.size()}};
  out["materials"] = desc.materials.size();
  out["material_types"] = nlohmann::ordered_json::object();
  for (const Material& material : desc.materials) {
    auto& count = out["material_types"][std::string(material_type_name(material))];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  out["textures"] = desc.textures.size();
  Bounds3 bounds = geometry.bounds();
  if (bounds.empty())
    out["bounds"] = nullptr;
  else
    out["bounds"] = {{"min", vector_json(bounds.lo)}, {"max", vector_json(bounds.hi)}};
  nlohmann::ordered_json lights = nlohmann::ordered_json::object();
  for (const Light& light : scene->lights()) {
    auto& count = lights[std::string(light_name(light))];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  out["lights"] = lights;
  out["light_groups"] = light_group_names(desc);
  out["camera"] = camera_json(loaded.document);
  out["bookmarks"] = nlohmann::ordered_json::array();
  for (const Bookmark& bookmark : desc.bookmarks) out["bookmarks"].push_back(bookmark.name);
  out["film"] = {{"width", loaded.document.settings.film.width},
                 {"height", loaded.document.settings.film.height}};
  out["bvh"] = {{"nodes", accel.nodes}, {"leaves", accel.leaves},
                {"depth", accel.depth}, {"sah_cost", accel.sah_cost},
                {"bytes", accel.bytes}, {"skipped_primitives", accel.skipped}};
  out["memory_bytes"] = scene->memory_bytes();
  out["warnings"] = nlohmann::ordered_json::array();
  for (const Warning& w : loaded.warnings) out["warnings"].push_back({{"text", w.text}, {"count", w.count}});
  print_result(out.dump(2) + "\n");
  return 0;
}

} // namespace candela
