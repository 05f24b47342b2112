// Widgets of numbers, vectors and colours.

#include "app/ui/typed_number.h"
#include "app/ui/widgets.h"
#include "core/color.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // what a slider is while it is a text field
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace candela {

namespace {

/// Upper end of a logarithmic slider whose row has no maximum; typed values may be larger.
constexpr double kLogSliderEnd = 1000;
/// The largest range that a slider of about 200 pixels can resolve.
constexpr double kSliderRange = 512;

/// Escapes percent signs, which would be read as conversions.
std::string escaped(std::string_view unit) {
  std::string out;
  for (char c : unit) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

/// Significant digits of single numbers, and of several in one row.
constexpr int kDigits = 4, kVectorDigits = 3;
/// Significant digits of a number that is being typed: as many as a float has.
constexpr int kTypedDigits = 7;
constexpr std::size_t kMostTyped = 63; // bytes
constexpr double kMarkSeconds = 2;

/// Sets the text of a field that has just become active, and selects it.
void set_typed_text(ImGuiInputTextState& state, const std::string& text) {
  const char* end = nullptr;
  state.TextW.resize(kMostTyped + 1);
  state.CurLenW = ImTextStrFromUtf8(state.TextW.Data, kMostTyped, text.c_str(), nullptr, &end);
  state.CurLenA = static_cast<int>(end - text.c_str());
  state.InitialTextA.resize(static_cast<int>(text.size()) + 1);
  std::copy_n(text.c_str(), text.size() + 1, state.InitialTextA.Data);
  state.TextAIsValid = false;
  state.SelectAll();
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
  // Without limits, the step is proportional to the value: about 100 pixels double it.
  style.speed =
      style.integer ? std::max(0.1f, static_cast<float>(std::abs(value)) * 0.01f) : context.drag_speed;
  style.format = style.integer ? "%d" : plain_number_format(value, kDigits);
  if (row.type == FieldType::angle) {
    style.format += "°";
  } else if (!row.unit.empty()) {
    const std::string number =
        style.integer ? fmt::format("{}", static_cast<int>(value)) : plain_number(value, kDigits);
    style.format += fmt::format(" {}", escaped(unit_of(number, row.unit)));
  }
  return style;
}

bool Ui::scalar(const char* id, Scalar& value, const NumberStyle& style, bool& reset) {
  const ImGuiID item = ImGui::GetID(id);
  ImGuiIO& io = ImGui::GetIO();
  // A double click resets. It is hidden from ImGui, which would begin text input or sliding.
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end(at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight());
  const bool double_click = io.MouseClickedCount[0] == 2 && !io.KeyCtrl && ImGui::IsWindowHovered() &&
                            ImGui::IsMouseHoveringRect(at, end);
  if (double_click) {
    reset = true;
    if (ImGui::GetActiveID() == item) ImGui::ClearActiveID();
    io.MouseClicked[0] = false;
    io.MouseClickedCount[0] = 0;
    if (typing_ == item) typing_ = 0; // the first click has begun text input
  }
  if (typing_ == item && ImGui::TempInputIsActive(item)) {
    const bool changed = type_scalar(item, id, value, style);
    mark_refusal(item);
    return changed;
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
  const bool changed = style.slider
                           ? ImGui::SliderScalar(id, type, number, lo, hi, style.format.c_str(), flags)
                           : ImGui::DragScalar(id, type, number, style.speed, lo, hi, style.format.c_str(),
                                               ImGuiSliderFlags_None);
  mark_refusal(item);
  if (double_click) {
    io.MouseClicked[0] = true;
    io.MouseClickedCount[0] = 2;
    return false;
  }
  if (ImGui::TempInputIsActive(item)) { // it has become a text field, which type_scalar() handles
    typing_ = item;
    typing_drawn_ = true;
    typed_ =
        style.integer ? fmt::format("{}", value.i) : plain_number(static_cast<double>(value.f), kTypedDigits);
    typed_at_first_ = typed_;
    if (ImGuiInputTextState* state = ImGui::GetInputTextState(item)) set_typed_text(*state, typed_);
    if (refused_by_ == item) refused_by_ = 0;
    return false;
  }
  if (typing_ == item) { // ended by a click elsewhere, or by Tab
    typing_ = 0;
    return take_typed(item, value, style);
  }
  if (!changed || (!edited.integer && !std::isfinite(edited.f))) return false;
  value = edited;
  return true;
}

/// The field while text is typed. Dear ImGui's own drops characters, so that 1,5 became 15, and parses only a
/// prefix, so that 2+3 became 2.
bool Ui::type_scalar(unsigned item, const char* id, Scalar& value, const NumberStyle& style) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImRect box(at, ImVec2(at.x + ImGui::CalcItemWidth(), at.y + ImGui::GetFrameHeight()));
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  if (!ImGui::ItemAdd(box, item, &box, ImGuiItemFlags_Inputable)) return false;
  typing_drawn_ = true;
  std::array<char, kMostTyped + 1> text{};
  std::copy_n(typed_.begin(), std::min(typed_.size(), kMostTyped), text.begin());
  ImGui::TempInputText(box, item, id, text.data(), static_cast<int>(text.size()), ImGuiInputTextFlags_None);
  typed_ = text.data();
  if (ImGui::TempInputIsActive(item)) return false;
  typing_ = 0; // by Enter; Escape reverts
  return !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) && take_typed(item, value, style);
}

/// Parses the typed text; text that is not a number is refused, and the value stays.
bool Ui::take_typed(unsigned item, Scalar& value, const NumberStyle& style) {
  if (typed_ == typed_at_first_) return false; // keeps digits that were not shown
  const std::optional<double> typed = typed_number(typed_);
  if (!typed) {
    const bool both = typed_.find(',') != std::string::npos && typed_.find('.') != std::string::npos;
    refuse(item, fmt::format("\"{}\" is no number{}: {} stays", typed_,
                             both ? " (one point or one comma, before the decimals)" : "", typed_at_first_));
    return false;
  }
  Scalar read = value;
  if (style.integer) {
    if (*typed != std::round(*typed)) {
      refuse(item, fmt::format("{} is no whole number: {} stays", typed_, typed_at_first_));
      return false;
    }
    read.i = static_cast<int>(std::clamp(*typed, -2147483648.0, 2147483647.0));
  } else {
    read.f = static_cast<float>(*typed);
    if (!std::isfinite(read.f)) {
      refuse(item, fmt::format("{} is too large: {} stays", typed_, typed_at_first_));
      return false;
    }
  }
  const bool changed = read != value;
  value = read;
  return changed;
}

void Ui::refuse(unsigned item, std::string why) {
  refusal_ = std::move(why);
  refused_by_ = item;
  marked_until_ = ImGui::GetTime() + kMarkSeconds;
}

/// Draws a red frame around the last item for a short time after it has refused an entry.
void Ui::mark_refusal(unsigned item) const {
  if (refused_by_ != item || ImGui::GetTime() >= marked_until_) return;
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                      IM_COL32(235, 90, 75, 255), ImGui::GetStyle().FrameRounding, 0,
                                      1.5f * scale_);
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
    style.format = plain_number_format(static_cast<double>(value[i]), kVectorDigits);
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

/// The swatch shows the displayed colour. The picker works on encoded values, which are perceptually more
/// uniform, and keeps the brightness of an emission above 1.
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
  const bool changed = color_picker(name, shown);
  ImGui::EndPopup();
  if (!changed) return false;
  for (int i = 0; i < 3; ++i) linear[i] = brightness * linear_from_srgb(std::clamp(shown[i], 0.0f, 1.0f));
  return true;
}

bool Ui::color_picker(const std::string& name, vec3& encoded) {
  const float width = 200 * scale_, gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SetNextItemWidth(width);
  bool changed = ImGui::ColorPicker3("##color", &encoded.x,
                                     ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs |
                                         ImGuiColorEditFlags_NoDragDrop);
  record(name + ".picker");
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine(0, gap);
    ImGui::PushID(i);
    ImGui::SetNextItemWidth(std::floor((width - 2 * gap) / 3));
    NumberStyle style;
    style.integer = true;
    style.hi = 255;
    style.speed = 1;
    style.format = fmt::format("{} %d", "RGB"[i]);
    Scalar level{true, static_cast<int>(std::lround(255 * std::clamp(encoded[i], 0.0f, 1.0f))), 0};
    bool reset = false; // handled by the row of the swatch
    if (scalar("##level", level, style, reset)) {
      encoded[i] = static_cast<float>(std::clamp(level.i, 0, 255)) / 255;
      changed = true;
    }
    record(fmt::format("{}.picker.{}", name, "rgb"[i]));
    ImGui::PopID();
  }
  ImGui::SetNextItemWidth(width);
  return color_code(name + ".picker.code", encoded) || changed;
}

/// The colour as #rrggbb. It is applied as soon as the text is valid; Enter on other text is refused.
bool Ui::color_code(const std::string& name, vec3& encoded) {
  std::string code = "#";
  for (int i = 0; i < 3; ++i)
    code += fmt::format("{:02x}", std::lround(255 * std::clamp(encoded[i], 0.0f, 1.0f)));
  const std::string before = code;
  const bool typed = ImGui::InputText("##code", &code);
  const bool entered = ImGui::IsItemDeactivatedAfterEdit();
  const unsigned item = ImGui::GetItemID();
  record(name);
  mark_refusal(item);
  if ((!typed && !entered) || code == before) return false;
  const std::string_view digits = std::string_view(code).substr(code.starts_with('#') ? 1 : 0);
  unsigned bits = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), bits, 16);
  if (digits.size() != 6 || read.ec != std::errc() || read.ptr != digits.data() + digits.size()) {
    if (entered) refuse(item, fmt::format("\"{}\" is no colour: write #rrggbb; {} stays", code, before));
    return false;
  }
  for (int i = 0; i < 3; ++i) encoded[i] = static_cast<float>(bits >> (16 - 8 * i) & 0xff) / 255;
  return true;
}

} // namespace candela
