// The panel of the scene's objects.

#include "app/panels/material_picker.h"
#include "app/panels/panel_list.h"
#include "app/tools/transform_parts.h"
#include "app/ui/item_list.h"

namespace candela {

namespace {

constexpr auto kInf = std::numeric_limits<double>::infinity();

const FieldInfo kPosition{
    "position",        FieldType::point, -kInf, kInf, "scene units", "World position of the object's origin",
    Invalidates::scene};
const FieldInfo kRotation{"rotation",
                          FieldType::point,
                          -kInf,
                          kInf,
                          "degrees",
                          "Rotation about the world's x, then y, then z axis through the object's centre",
                          Invalidates::scene};
const FieldInfo kScale{"scale",
                       FieldType::point,
                       -1e6,
                       1e6,
                       "",
                       "Factors along the object's own axes, about its centre",
                       Invalidates::scene};

std::string shape_text(const Shape& shape) {
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape))
    return fmt::format("{}, {} triangles", shape_name(shape), (*mesh)->triangles.size());
  if (const auto* curves = std::get_if<CurvesShape>(&shape))
    return fmt::format("{}, {} strands", shape_name(shape), curves->strands->counts.size());
  return std::string(shape_name(shape));
}

/// The values of a shape of this kind. `home` is the loaded shape; null if it had another kind.
void shape_values(Ui& ui, ViewerState& state, Shape& shape, Shape* home) {
  for (const auto& row : shape_fields(shape)) {
    FieldInfo limits = shape_limits(shape, row);
    FieldContext context;
    if (home != nullptr) context.initial = row.address(*home);
    if (row.type == FieldType::real) { // a length has no upper limit for a slider: 100 pixels double it
      limits.logarithmic = false;
      context.drag_speed = 0.01f * *static_cast<const float*>(row.address(shape));
    }
    state.edited |= ui.field(fmt::format("object.{}", row.key), limits, row.address(shape), context);
  }
}

/// The angles as they were typed: several sets of angles give the same matrix.
TransformParts shown_parts(ViewerState& state, const mat4& matrix) {
  if (state.typed_transform && transform_of(*state.typed_transform) == matrix) return *state.typed_transform;
  state.typed_transform.reset();
  return transform_parts(matrix);
}

void transform_fields(Ui& ui, ViewerState& state, Instance& instance, const Instance* home) {
  TransformParts parts = shown_parts(state, instance.world_from_object);
  TransformParts initial = home != nullptr ? transform_parts(home->world_from_object) : TransformParts{};
  FieldContext context;
  context.drag_speed = 0.005f * state.natural_speed;
  context.initial = &initial.position;
  if (ui.field("object.position", kPosition, &parts.position, context)) {
    instance.world_from_object[3] = vec4(parts.position, 1);
    state.edited = true;
    if (state.typed_transform) state.typed_transform->position = parts.position;
  }
  if (has_shear(instance.world_from_object)) {
    ImGui::TextDisabled("It is sheared: rotation and scale cannot be typed.");
    return;
  }
  bool changed = false;
  context.drag_speed = 0.5f;
  context.initial = &initial.rotation;
  changed |= ui.field("object.rotation", kRotation, &parts.rotation, context);
  context.drag_speed = 0.01f;
  context.initial = &initial.scale;
  changed |= ui.field("object.scale", kScale, &parts.scale, context);
  if (!changed) return;
  for (int i = 0; i < 3; ++i) // a flat object has no inverse
    if (std::abs(parts.scale[i]) < 1e-6f) parts.scale[i] = 1e-6f;
  parts = about_middle(instance.world_from_object, parts, state.selection_middle);
  instance.world_from_object = transform_of(parts);
  state.typed_transform = parts;
  state.edited = true;
}

/// How the object moves while the shutter is open.
void motion_values(Ui& ui, ViewerState& state, Instance& instance, Instance* home) {
  if (!ui.subsection("object.motion", "Motion", instance.motion.any())) return;
  for (const auto& row : motion_fields()) {
    FieldContext context;
    context.drag_speed = row.key == "angle"       ? 0.5f
                         : row.key == "translate" ? 0.005f * state.natural_speed
                                                  : 0.01f;
    Motion standing;
    context.initial = row.address(home != nullptr ? home->motion : standing);
    const Motion before = instance.motion;
    if (!ui.field(fmt::format("object.motion.{}", row.key), row, row.address(instance.motion), context))
      continue;
    if (!motion_problem(instance.motion).empty()) instance.motion = before;
    state.edited = true;
  }
  const Camera& camera = state.document.scene.camera;
  if (instance.motion.any() && camera.shutter_open == camera.shutter_close)
    ImGui::TextDisabled("The camera's shutter is open for an instant: no blur.");
}

void material_choices(Ui& ui, ViewerState& state, Instance& instance) {
  std::vector<std::string> names;
  const auto& materials = state.document.scene.materials;
  for (std::size_t i = 0; i < materials.size(); ++i)
    names.push_back(name_or_number(materials[i].name, "Material", i));
  const std::vector<std::string_view> choices(names.begin(), names.end());
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  auto picture = [&](std::size_t i, vec2 lo, vec2 hi) { draw_material_thumbnail(state, i, lo, hi); };
  for (std::size_t slot = 0; slot < instance.materials.size(); ++slot) {
    const bool single = instance.materials.size() == 1;
    const std::string label = single ? "material" : name_or_number((*mesh)->slot_names[slot], "slot", slot);
    if (!ui.choice(fmt::format("object.material.{}", slot).c_str(), label.c_str(), instance.materials[slot],
                   choices, "The object's material.\nRebuilds the geometry, then restarts the image.",
                   picture))
      continue;
    state.edited = true;
    state.selected_material = instance.materials[slot];
  }
}

} // namespace

void objects_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.objects", "Objects", false)) return;
  auto& instances = state.document.scene.instances;
  if (instances.empty()) {
    ImGui::TextDisabled("The scene has none.");
    return;
  }
  const bool selected = state.selection.kind == Selection::Kind::object;
  const int chosen = selected ? state.selection.index : -1;
  item_list(ui, "list.objects", instances.size(), state.reveal_selection ? chosen : -1, [&](std::size_t i) {
    if (ui.item(fmt::format("objects/{}", i), name_or_number(instances[i].name, "Object", i).c_str(),
                static_cast<int>(i) == chosen))
      state.select_requested = Selection{Selection::Kind::object, static_cast<int>(i)};
  });
  if (!selected) {
    ImGui::TextDisabled("Click an object here or in the picture.");
    return;
  }
  const auto index = static_cast<std::size_t>(chosen);
  Instance& instance = instances[index];
  auto& homes = state.home.scene.instances;
  Instance* home = homes.size() == instances.size() ? &homes[index] : nullptr;
  const bool same_kind = home != nullptr && home->shape.index() == instance.shape.index();
  ImGui::PushID(chosen);
  ui.readout("shape", shape_text(instance.shape));
  ui.record(fmt::format("object.shape/{}", shape_name(instance.shape)));
  shape_values(ui, state, instance.shape, same_kind ? &home->shape : nullptr);
  transform_fields(ui, state, instance, home);
  motion_values(ui, state, instance, home);
  material_choices(ui, state, instance);
  ImGui::PopID();
}

} // namespace candela
