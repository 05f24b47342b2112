#include "io/candela/json_instance_list.h"

#include "io/candela/json_curves.h"
#include "io/candela/json_mesh.h"
#include "io/candela/json_transform.h"

#include <algorithm>

namespace candela {

namespace {

/// What only curves have is an error in other shapes.
void refuse_strands(const std::map<std::string_view, JsonValue>& parts, std::string_view kind,
                    const std::string& element) {
  for (std::string_view key : {"basis", "strands", "width", "widths", "source"})
    if (const auto given = parts.find(key); given != parts.end())
      throw input_error(given->second.where(), element, fmt::format("a {} has no {}", kind, key),
                        "leave it out, or say \"shape\": \"curves\"");
}

/// The values of the shape's kind; those of other kinds are errors.
void read_shape_values(Shape& shape, const std::map<std::string_view, JsonValue>& parts, JsonValue object,
                       const std::string& element) {
  auto rows = shape_fields(shape);
  for (std::string_view key : {"radius", "height", "minor_radius", "caps", "form", "thickness"}) {
    auto given = parts.find(key);
    if (given == parts.end()) continue;
    auto row = std::ranges::find(rows, key, &FieldInfo::key);
    if (row == rows.end())
      throw input_error(given->second.where(), element, fmt::format("a {} has no {}", shape_name(shape), key),
                        "leave it out; a transform scales any shape");
    read_field(*row, row->address(shape), given->second, fmt::format("{}.{}", element, key));
  }
  std::string problem = shape_problem(shape);
  if (problem.empty()) return;
  std::string_view key = std::string_view(problem).substr(0, problem.find(':'));
  auto given = parts.find(key);
  throw input_error((given == parts.end() ? object : given->second).where(),
                    fmt::format("{}.{}", element, key), problem.substr(key.size() + 2),
                    "correct it, or scale the shape by its transform");
}

} // namespace

void JsonInstanceList::read_meshes(JsonValue object) {
  expect(object, JsonType::object, "meshes");
  for (auto [key, value] : object.members()) {
    source_.reach(value);
    std::string element = fmt::format("meshes.{}", key.string().substr(0, 60));
    expect(value, JsonType::object, element);
    std::string name = key.string();
    std::optional<JsonValue> file, file_end;
    for (auto [part_key, part_value] : value.members()) {
      if (part_key.string() == "name") name = read_string(part_value, element + ".name");
      if (part_key.string() == "file") file = part_value;
      if (part_key.string() == "file_end") file_end = part_value;
    }
    if (!file) {
      meshes_[key.string()] = {
          std::make_shared<const Mesh>(read_json_mesh(value, name, element, source_.builder.warnings())),
          nullptr};
      continue;
    }
    constexpr std::string_view kKeys[] = {"file", "file_end", "name"};
    for (auto [part_key, part_value] : value.members())
      if (std::ranges::find(kKeys, part_key.string()) == std::end(kKeys))
        throw unknown_key(part_key, element, kKeys);
    meshes_[key.string()] = file_end ? deforming_mesh(*file, *file_end, name, element)
                                     : mesh_of_file(*file, name, element + ".file");
  }
}

/// The mesh of a file with the vertices of another one at time 1.
JsonInstanceList::NamedMesh JsonInstanceList::deforming_mesh(JsonValue begin, JsonValue end,
                                                             const std::string& name,
                                                             const std::string& element) {
  NamedMesh mesh = mesh_of_file(begin, name, element + ".file");
  const std::string end_element = element + ".file_end";
  const std::shared_ptr<const Mesh> target = mesh_of_file(end, "", end_element).mesh;
  if (const std::string problem = topology_problem(*mesh.mesh, *target); !problem.empty())
    throw input_error(end.where(), end_element, problem,
                      "export both from one mesh, made of triangles: its vertices alone may differ");
  mesh.mesh = std::make_shared<const Mesh>(deforming(*mesh.mesh, *target));
  return mesh;
}

Motion JsonInstanceList::read_motion(JsonValue object, const std::string& element) const {
  expect(object, JsonType::object, element);
  Motion motion;
  for (auto [key, value] : object.members())
    if (!read_row(motion_fields(), motion, key, value, element))
      throw unknown_key(key, element, keys_of(motion_fields(), {}));
  if (const std::string problem = motion_problem(motion); !problem.empty()) {
    const std::size_t name = problem.find(": "), remedy = problem.find("; ");
    throw input_error(object.where(), fmt::format("{}.{}", element, problem.substr(0, name)),
                      problem.substr(name + 2, remedy - name - 2), problem.substr(remedy + 2));
  }
  return motion;
}

JsonInstanceList::NamedMesh JsonInstanceList::mesh_of_file(JsonValue value, const std::string& name,
                                                           const std::string& element) {
  const FoundFile found = source_.require_file(value, element);
  MeshFile& file = source_.builder.mesh_file(found, name, value.where(), element);
  return {file.mesh, &file};
}

void JsonInstanceList::read_instances(JsonValue array) {
  source_.each_object(array, "instances",
                      [&](JsonValue object, const std::string& element) { read_instance(object, element); });
}

void JsonInstanceList::read_instance(JsonValue object, const std::string& element) {
  constexpr std::string_view kKeys[] = {"name",      "shape",     "mesh",   "file",    "material",
                                        "materials", "transform", "radius", "height",  "minor_radius",
                                        "caps",      "form",      "basis",  "strands", "thickness",
                                        "width",     "widths",    "source", "motion"};
  std::map<std::string_view, JsonValue> parts;
  for (auto [key, value] : object.members()) {
    auto known = std::ranges::find(kKeys, key.string());
    if (known == std::end(kKeys)) throw unknown_key(key, element, kKeys);
    parts.emplace(*known, value);
  }
  auto part = [&](std::string_view key) -> const JsonValue* {
    auto found = parts.find(key);
    return found == parts.end() ? nullptr : &found->second;
  };
  Instance out;
  if (const auto* name = part("name")) out.name = read_string(*name, element + ".name");
  glm::dmat4 world_from_object(1);
  if (const auto* transform = part("transform"))
    world_from_object = read_transform(*transform, element + ".transform");

  if (const auto* motion = part("motion")) out.motion = read_motion(*motion, element + ".motion");

  bool names_mesh = part("mesh") || part("file");
  const auto* shape = part("shape");
  if (!shape && !names_mesh)
    throw input_error(object.where(), element, "it has no shape",
                      fmt::format("give a \"shape\": {}", fmt::join(shape_names(), ", ")));
  std::string kind = shape ? read_string(*shape, element + ".shape") : "mesh";
  const bool curves = kind == shape_name(CurvesShape{});
  if (kind != "mesh" && names_mesh && !(curves && !part("mesh")))
    throw input_error((part("mesh") ? part("mesh") : part("file"))->where(), element,
                      fmt::format("a {} has no mesh", kind), "leave it out, or say \"shape\": \"mesh\"");
  MeshFile* file = nullptr;
  if (kind == "mesh") {
    NamedMesh mesh = mesh_part(object, part("mesh"), part("file"), element);
    file = mesh.file;
    out.shape = std::move(mesh.mesh);
  } else if (curves) {
    out.shape = CurvesShape{read_strands(parts, object, element)};
  } else if (auto standard = shape_of_name(kind)) {
    out.shape = *standard;
  } else {
    throw input_error(shape->where(), element + ".shape",
                      fmt::format("there is no shape '{}'", kind.substr(0, 60)),
                      fmt::format("give one of {}", fmt::join(shape_names(), ", ")));
  }
  if (!curves) refuse_strands(parts, kind, element);
  read_shape_values(out.shape, parts, object, element);
  source_.builder.place(out, world_from_object, object.where());
  read_instance_materials(out, part("material"), part("materials"), file, object, element);
  source_.builder.scene().instances.push_back(std::move(out));
}

std::shared_ptr<const Strands> JsonInstanceList::read_strands(const Parts& parts, JsonValue object,
                                                              const std::string& element) const {
  auto part = [&](std::string_view key) {
    const auto found = parts.find(key);
    return found == parts.end() ? std::nullopt : std::optional(found->second);
  };
  const auto file = part("file");
  const JsonStrands inline_parts{part("basis"), part("strands"), part("width"), part("widths"),
                                 part("source")};
  if (!file)
    return std::make_shared<const Strands>(
        read_json_strands(inline_parts, object, element, source_.builder.warnings()));
  for (const auto& given : {inline_parts.basis, inline_parts.strands, inline_parts.width, inline_parts.widths,
                            inline_parts.source})
    if (given)
      throw input_error(given->where(), element, "its strands are those of a file",
                        "leave this out, or the file; \"thickness\" multiplies all widths");
  return source_.builder.strands(source_.require_file(*file, element + ".file"));
}

JsonInstanceList::NamedMesh JsonInstanceList::mesh_part(JsonValue object, const JsonValue* mesh,
                                                        const JsonValue* file, const std::string& element) {
  if (mesh && file)
    throw input_error(file->where(), element, "it has both a mesh and a file", "keep one of them");
  if (file) return mesh_of_file(*file, "", element + ".file");
  if (!mesh) throw input_error(object.where(), element, "it names no mesh", "give \"mesh\" or \"file\"");
  std::string name = read_string(*mesh, element + ".mesh");
  auto known = meshes_.find(name);
  if (known != meshes_.end()) return known->second;
  std::vector<std::string_view> names;
  for (const auto& [key, value] : meshes_) names.push_back(key);
  throw missing_name(*mesh, element + ".mesh", "mesh", "meshes", names);
}

void JsonInstanceList::read_instance_materials(Instance& out, const JsonValue* all, const JsonValue* by_slot,
                                               MeshFile* file, JsonValue object, const std::string& element) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&out.shape);
  const std::vector<std::string> one{""};
  const std::vector<std::string>& slots = mesh ? (*mesh)->slot_names : one;
  out.materials.assign(slots.size(), all ? materials_.material_of(*all, element + ".material") : -1);
  if (by_slot) {
    std::string name = element + ".materials";
    if (by_slot->type() == JsonType::array) {
      if (by_slot->size() != slots.size())
        throw input_error(by_slot->where(), name,
                          fmt::format("{} materials for {} slots", by_slot->size(), slots.size()),
                          "give one for each slot");
      auto slot = out.materials.begin();
      for (JsonValue value : *by_slot) *slot++ = materials_.material_of(value, name);
    } else {
      expect(*by_slot, JsonType::object, name);
      for (auto [key, value] : by_slot->members()) {
        auto slot = std::ranges::find(slots, key.string());
        std::vector<std::string_view> names(slots.begin(), slots.end());
        if (slot == slots.end()) throw unknown_key(key, name, names);
        out.materials[static_cast<std::size_t>(slot - slots.begin())] =
            materials_.material_of(value, fmt::format("{}.{}", name, key.string()));
      }
    }
  }
  for (std::size_t slot = 0; slot < out.materials.size(); ++slot) {
    int& material = out.materials[slot];
    if (material < 0 && file) {
      material = source_.builder.imported_material(*file, slot);
      if (material < 0) material = source_.builder.missing_material(*file, slot, object.where());
    }
    if (material < 0) material = source_.builder.default_material();
  }
}

} // namespace candela
