// Numbers, vectors and colours of the widgets.

#include "app/widgets.h"
#include "core/color.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // TempInputIsActive: whether a slider is a text field at the moment

#include <algorithm>

namespace candela {

namespace {

/// Upper end of a logarithmic slider whose row goes on for ever; typed values may be larger.
constexpr double kLogSliderEnd = 1000;
/// A range that a slider of some 200 pixels can still be aimed on.
constexpr double kSliderRange = 512;

/// A percent sign would be taken for a conversion.
std::string escaped(std::string_view unit) {
  std::string out;
  for (char c : unit) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

vec3 encoded(vec3 linear) {
  vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = srgb_from_linear(std::clamp(linear[i], 0.0f, 1.0f));
  return out;
}

} // namespace

Ui::NumberStyle Ui::style_of(const FieldInfo& row, double value, const FieldContext& context) {
  NumberStyle style;
  style.integer = row.type == FieldType::integer;
  style.lo = row.minimum;
  style.hi = row.maximum;
  style.logarithmic = row.logarithmic;
  if (row.logarithmic) {
    style.slider = true;
    style.hi = std::min(row.maximum, kLogSliderEnd);
  } else {
    style.slider = row.maximum - row.minimum <= kSliderRange;
  }
  // Without a slider's ends, the step follows the value: some 100 pixels double it.
  style.speed =
      style.integer ? std::max(0.1f, static_cast<float>(std::abs(value)) * 0.01f) : context.drag_speed;
  const std::string unit = row.type == FieldType::angle ? "°" : escaped(row.unit);
  const bool spaced = !unit.empty() && row.type != FieldType::angle;
  style.format = fmt::format("{}{}{}", style.integer ? "%d" : "%.4g", spaced ? " " : "", unit);
  return style;
}

bool Ui::scalar(const char* id, Scalar& value, const NumberStyle& style, bool& reset) {
  const ImGuiID item = ImGui::GetID(id);
  ImGuiIO& io = ImGui::GetIO();

  // A double click resets. ImGui must not see it: it would begin to type (drags) or to slide.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight());
  const bool double_click = io.MouseClickedCount[0] == 2 && !io.KeyCtrl && ImGui::IsWindowHovered() &&
                            ImGui::IsMouseHoveringRect(at, end);
  if (double_click) {
    reset = true;
    if (ImGui::GetActiveID() == item) ImGui::ClearActiveID();
    io.MouseClicked[0] = false;
    io.MouseClickedCount[0] = 0;
  }

  Scalar edited = value;
  void* number = style.integer ? static_cast<void*>(&edited.i) : static_cast<void*>(&edited.f);
  const ImGuiDataType type = style.integer ? ImGuiDataType_S32 : ImGuiDataType_Float;
  const int lo_int = static_cast<int>(std::max(style.lo, -2147483648.0));
  const int hi_int = static_cast<int>(std::min(style.hi, 2147483647.0));
  const float lo_float = static_cast<float>(std::max(style.lo, -1e30));
  const float hi_float = static_cast<float>(std::min(style.hi, 1e30));
  const void* lo = style.integer ? static_cast<const void*>(&lo_int) : static_cast<const void*>(&lo_float);
  const void* hi = style.integer ? static_cast<const void*>(&hi_int) : static_cast<const void*>(&hi_float);
  const ImGuiSliderFlags flags = style.logarithmic && style.slider ? ImGuiSliderFlags_Logarithmic : 0;
  bool changed = style.slider ? ImGui::SliderScalar(id, type, number, lo, hi, style.format.c_str(), flags)
                              : ImGui::DragScalar(id, type, number, style.speed, lo, hi, style.format.c_str(),
                                                  ImGuiSliderFlags_None);
  if (double_click) {
    io.MouseClicked[0] = true;
    io.MouseClickedCount[0] = 2;
    return false;
  }

  if (ImGui::TempInputIsActive(item)) {
    if (typing_ != item) typing_ = item, typed_ = value;
    if (changed) typed_ = edited;
    typing_drawn_ = true;
    return false;
  }
  if (typing_ == item) { // done: by Enter, Tab or a click elsewhere; Escape takes it back
    typing_ = 0;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) return false;
    if (!changed) edited = typed_;
    changed = edited != value;
  }
  if (!changed || (!edited.integer && !std::isfinite(edited.f))) return false;
  value = edited;
  return true;
}

bool Ui::vector_field(const std::string& name, const FieldInfo& row, vec3& value, const FieldContext& context,
                      bool& reset) {
  const bool color = row.type == FieldType::color;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const std::string tip = field_tooltip(row, context.initial);
  bool changed = false;
  if (color) {
    changed |= color_swatch(name, value);
    ImGui::SameLine(0, gap);
  }
  const float width = std::max(1.0f, std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) / 3));
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(width);
    NumberStyle style;
    style.lo = row.minimum, style.hi = row.maximum;
    style.format = "%.3g";
    style.speed = row.logarithmic ? std::max(0.01f, std::abs(value[i]) * 0.01f)
                  : color         ? 0.002f
                                  : context.drag_speed;
    Scalar component{false, 0, value[i]};
    if (scalar("##component", component, style, reset)) {
      value[i] = static_cast<float>(std::clamp(static_cast<double>(component.f), row.minimum, row.maximum));
      changed = true;
    }
    record(fmt::format("{}.{}", name, (color ? "rgb" : "xyz")[i]));
    tooltip(tip);
    ImGui::PopID();
  }
  return changed;
}

/// The swatch shows the colour as the screen will; the picker works on the encoded values, where equal steps
/// look equal, and leaves the brightness of an emission above 1 as it is.
bool Ui::color_swatch(const std::string& name, vec3& linear) {
  const float brightness = std::max(1.0f, max_component(linear));
  vec3 shown = encoded(linear / brightness);
  const float side = ImGui::GetFrameHeight();
  const ImGuiColorEditFlags plain = ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop;
  if (ImGui::ColorButton("##swatch", ImVec4(shown.x, shown.y, shown.z, 1), plain, ImVec2(side, side)))
    ImGui::OpenPopup("##picker");
  record(name + ".swatch");
  tooltip("Pick a colour");
  if (!ImGui::BeginPopup("##picker")) return false;
  ImGui::SetNextItemWidth(200 * scale_);
  const bool changed =
      ImGui::ColorPicker3("##color", &shown.x,
                          ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_DisplayRGB |
                              ImGuiColorEditFlags_DisplayHex | ImGuiColorEditFlags_NoDragDrop);
  record(name + ".picker");
  ImGui::EndPopup();
  if (!changed) return false;
  for (int i = 0; i < 3; ++i) linear[i] = brightness * linear_from_srgb(std::clamp(shown[i], 0.0f, 1.0f));
  return true;
}

} // namespace candela
