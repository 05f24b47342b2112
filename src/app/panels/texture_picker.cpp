#include "app/panels/texture_picker.h"

#include "app/panels/material_picker.h"
#include "app/tools/texture_users.h"
#include "core/color.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::string_view kPrefix = "material.", kSuffix = ".texture";

ImU32 shown(vec3 linear) {
  auto byte = [](float x) {
    return static_cast<int>(255 * srgb_from_linear(std::clamp(x, 0.0f, 1.0f)) + 0.5f);
  };
  return IM_COL32(byte(linear.x), byte(linear.y), byte(linear.z), 255);
}

/// The texture over [0, 1]^2 as a few squares: recognisable, without a texture in the graphics driver.
void draw_thumbnail(const Texture& texture, ImVec2 lo, ImVec2 hi) {
  constexpr int kCells = 12;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const TextureUse use;
  const float w = (hi.x - lo.x) / kCells, h = (hi.y - lo.y) / kCells;
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const vec2 cell(x, y), uv = (cell + 0.5f) / static_cast<float>(kCells);
      const ImVec2 from(lo.x + cell.x * w, lo.y + cell.y * h);
      list.AddRectFilled(from, ImVec2(from.x + w, from.y + h),
                         shown(texture_color(texture, use, vec2(uv.x, 1 - uv.y))));
    }
}

void set_constant(const ParameterRef& parameter) {
  parameter.use() = parameter.standard_use();
  if (parameter.number != nullptr)
    parameter.number->offset = 0;
  else
    parameter.color->offset = vec3(0);
}

/// A new texture of that kind with default values.
int add_texture(SceneDesc& scene, std::string_view kind) {
  scene.textures.push_back(
      std::make_shared<const Texture>(Texture{std::string(kind), *texture_of_kind(kind)}));
  return static_cast<int>(scene.textures.size()) - 1;
}

/// The list; true if another texture, or none, was chosen.
bool choose_texture(Ui& ui, ViewerState& state, const std::string& name, const TextureTarget& target,
                    const ParameterRef& parameter) {
  SceneDesc& scene = state.document.scene;
  const int before = parameter.use().texture;
  if (before >= 0) {
    if (ui.item(name + "/view", "View", false)) state.texture_view.show(before, target);
    ImGui::Separator();
  }
  if (ui.item(name + "/none", "none", before < 0)) {
    set_constant(parameter);
    return before >= 0;
  }
  int chosen = before;
  for (int i = 0; i < static_cast<int>(scene.textures.size()); ++i)
    if (ui.item(fmt::format("{}/{}", name, i), texture_label(scene, i).c_str(), i == before)) chosen = i;
  ImGui::Separator();
  for (std::string_view kind : texture_kind_names())
    if (kind != ImageTexture::kName &&
        ui.item(fmt::format("{}/new {}", name, kind), fmt::format("new {}", kind).c_str(), false))
      chosen = add_texture(scene, kind);
  ImGui::TextDisabled("Drop a picture on the thumbnail");
  parameter.use().texture = chosen;
  return chosen != before;
}

void thumbnail(Ui& ui, ViewerState& state, const std::string& name, const TextureTarget& target,
               const ParameterRef& parameter) {
  const float side = ImGui::GetFrameHeight();
  const ImVec2 lo = ImGui::GetCursorScreenPos(), hi(lo.x + side, lo.y + side);
  if (ImGui::InvisibleButton(name.c_str(), ImVec2(side, side))) ImGui::OpenPopup(name.c_str());
  ui.record(name);
  const SceneDesc& scene = state.document.scene;
  const int texture = parameter.use().texture;
  if (texture >= 0) {
    ui.tooltip(
        fmt::format("{}: click for another texture, or drop a picture here", texture_label(scene, texture)));
    draw_thumbnail(*scene.textures[static_cast<std::size_t>(texture)], lo, hi);
  } else {
    ui.tooltip("A constant: click for a texture, or drop a picture here");
  }
  const ImU32 border =
      ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_ButtonHovered : ImGuiCol_TextDisabled);
  ImGui::GetWindowDrawList()->AddRect(lo, hi, border);
  if (ImGui::BeginPopup(name.c_str())) {
    state.edited |= choose_texture(ui, state, name, target, parameter);
    ImGui::EndPopup();
  }
}

/// How the texture is used, and the values of a procedural one.
void texture_fields(Ui& ui, ViewerState& state, const std::string& name, const TextureTarget& target,
                    const ParameterRef& parameter) {
  TextureUse& use = parameter.use();
  if (ui.button((name + ".view").c_str(), "View", "Shows it over the picture"))
    state.texture_view.show(use.texture, target);
  TextureUse standard = parameter.standard_use();
  for (const auto& row : texture_use_fields()) {
    FieldContext context;
    context.initial = row.address(standard);
    state.edited |= ui.field(fmt::format("{}.{}", name, row.key), row, row.address(use), context);
  }
  constexpr double kMost = 1e6;
  const float one = 1, zero = 0;
  auto pair = [&](std::string_view key, std::string_view help, vec2& value, const float& usual) {
    for (int axis = 0; axis < 2; ++axis) {
      const std::string label = fmt::format("{}_{}", key, "uv"[axis]);
      const FieldInfo row{label, FieldType::real, -kMost, kMost, "", help};
      FieldContext context;
      context.initial = &usual;
      state.edited |= ui.field(fmt::format("{}.{}", name, label), row, &value[axis], context);
    }
  };
  pair("scale", "Copies of the texture along one unit of the coordinates", use.uv.scale, one);
  pair("offset", "Added to the coordinates once they are scaled and turned", use.uv.offset, zero);
  auto& shared = state.document.scene.textures[static_cast<std::size_t>(use.texture)];
  Texture edited = *shared;
  bool changed = false;
  std::visit(
      [&](auto& kind) {
        std::decay_t<decltype(kind)> initial;
        for (const auto& row : kind.rows()) {
          FieldContext context;
          context.initial = row.address(initial);
          changed |= ui.field(fmt::format("{}.{}", name, row.key), row, row.address(kind), context);
        }
      },
      edited.model);
  if (!changed) return;
  shared = std::make_shared<const Texture>(std::move(edited));
  state.edited = true;
}

} // namespace

void material_field(Ui& ui, ViewerState& state, std::size_t index, const MaterialField& row,
                    const FieldContext& context) {
  Material& material = state.document.scene.materials[index];
  const std::string name = fmt::format("{}{}", kPrefix, row.key);
  if (row.type == FieldType::material) {
    material_part_field(ui, state, index, row);
    return;
  }
  if (row.parameter == nullptr) {
    state.edited |= ui.field(name, row, row.address(material), context);
    return;
  }
  const ParameterRef parameter = row.parameter(material);
  const TextureTarget target{index, std::string(row.key)};
  const std::string texture = name + std::string(kSuffix);
  if (ImGui::BeginTable(texture.c_str(), 2, ImGuiTableFlags_NoPadOuterX)) {
    ImGui::TableSetupColumn("field", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("thumbnail", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
    ImGui::TableNextColumn();
    state.edited |= ui.field(name, row, parameter.value(), context);
    ImGui::TableNextColumn();
    thumbnail(ui, state, texture, target, parameter);
    ImGui::EndTable();
  }
  if (parameter.use().texture < 0) return;
  const std::string fold = texture + "_use", label = fmt::format("Texture of {}", row.key);
  if (ui.subsection(fold.c_str(), label.c_str(), false))
    texture_fields(ui, state, texture, target, parameter);
}

std::string parameter_at(std::span<const WidgetRecord> widgets, vec2 point) {
  for (const WidgetRecord& widget : widgets) {
    const std::string_view name = widget.name;
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
    const vec2 lo = glm::max(widget.lo, widget.clip_lo), hi = glm::min(widget.hi, widget.clip_hi);
    if (point.x < lo.x || point.y < lo.y || point.x >= hi.x || point.y >= hi.y) continue;
    return std::string(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kSuffix.size()));
  }
  return {};
}

void set_parameter_texture(SceneDesc& scene, const TextureTarget& target,
                           const std::shared_ptr<const Texture>& texture) {
  if (target.material >= scene.materials.size()) return;
  const ParameterRef parameter = find_parameter(scene.materials[target.material], target.key);
  if (!parameter) return; // the type has changed since
  const auto same =
      std::ranges::find_if(scene.textures, [&](const auto& known) { return *known == *texture; });
  if (parameter.use().texture < 0) {
    // Not scaled by the former constant, which may be black.
    if (parameter.number != nullptr)
      parameter.number->value = 1;
    else
      parameter.color->value = vec3(1);
  }
  parameter.use().texture = static_cast<int>(same - scene.textures.begin());
  if (same == scene.textures.end()) scene.textures.push_back(texture);
}

} // namespace candela
