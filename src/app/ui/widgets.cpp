#include "app/ui/widgets.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h> // the selection within a text field
#include <imgui_stdlib.h>

#include <algorithm>

namespace candela {

namespace {

constexpr float kLabelWidth = 132; // at scale 1

vec2 to_vec2(ImVec2 v) { return {v.x, v.y}; }

std::string humanised(std::string_view key) {
  auto dot = key.rfind('.');
  std::string label(dot == std::string_view::npos ? key : key.substr(dot + 1));
  std::ranges::replace(label, '_', ' ');
  return label;
}

std::string_view consequence(Invalidates invalidates) {
  switch (invalidates) {
  case Invalidates::nothing: return "Restarts nothing.";
  case Invalidates::display: return "Only updates the display; restarts nothing.";
  case Invalidates::image: return "Restarts the image.";
  case Invalidates::scene: return "Rebuilds the lights or the geometry, then restarts the image.";
  }
  return "";
}

std::string_view how_to_edit(FieldType type) {
  switch (type) {
  case FieldType::boolean:
  case FieldType::material:
  case FieldType::choice: return "Double-click the name to reset.";
  default: return "Ctrl+click to type, double-click to reset.";
  }
}

} // namespace

std::string field_label(const FieldInfo& row) { return humanised(row.key); }

std::string field_tooltip(const FieldInfo& row, const void* initial) {
  std::string text = fmt::format("{}\n{}.\n{}.", row.key, row.help, field_domain(row));
  if (initial != nullptr) text += fmt::format("\nDefault: {}.", field_to_text(row, initial));
  return text + fmt::format("\n{}\n{}", consequence(row.invalidates), how_to_edit(row.type));
}

void Ui::begin_frame(float scale) {
  scale_ = scale;
  widgets_.clear();
  if (!typing_drawn_) typing_ = 0; // its panel was closed: drop the typed text
  typing_drawn_ = false;
  typed_field_ = std::exchange(typed_now_, std::nullopt);
}

void Ui::record(std::string name) {
  const ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 clip_lo = list->GetClipRectMin(), clip_hi = list->GetClipRectMax();
  widgets_.push_back({std::move(name), to_vec2(ImGui::GetItemRectMin()), to_vec2(ImGui::GetItemRectMax()),
                      to_vec2(clip_lo), to_vec2(clip_hi)});
  if (ImGui::IsItemActive() && ImGui::GetIO().WantTextInput) typed_now_ = widgets_.back();
}

void Ui::record(std::string name, vec2 lo, vec2 hi) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  widgets_.push_back({std::move(name), lo, hi, vec2(0), to_vec2(room)});
}

void Ui::tooltip(std::string_view text) {
  if (text.empty() || ImGui::IsAnyItemActive() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(360 * scale_);
  ImGui::TextUnformatted(text.data(), text.data() + text.size());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool Ui::section(const char* name, const char* label, bool open_at_first) {
  const auto known = open_sections_.find(name);
  if (known != open_sections_.end()) ImGui::SetNextItemOpen(known->second, ImGuiCond_Once);
  const bool open =
      ImGui::CollapsingHeader(fmt::format("{}##{}", label, name).c_str(),
                              open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  record(name);
  if (known != open_sections_.end())
    known->second = open;
  else if (open != open_at_first)
    open_sections_[name] = open;
  return open;
}

bool Ui::subsection(const char* name, const char* label, bool open_at_first) {
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.68f, 0.68f, 0.68f, 1));
  const bool open = section(name, label, open_at_first);
  ImGui::PopStyleColor(2);
  return open;
}

bool Ui::button(const char* name, const char* label, std::string_view tip, float width) {
  const bool pressed = ImGui::Button(fmt::format("{}##{}", label, name).c_str(), ImVec2(width, 0));
  record(name);
  tooltip(tip);
  return pressed;
}

bool Ui::item(const std::string& name, const char* label, bool selected) {
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.34f, 0.34f, 0.34f, 1));
  const bool pressed = ImGui::Selectable(fmt::format("{}##{}", label, name).c_str(), selected);
  ImGui::PopStyleColor();
  record(name);
  return pressed;
}

float Ui::picture_side() const { return std::round(34 * scale_); }

bool Ui::item(const std::string& name, const char* label, bool selected, std::size_t i,
              const ItemPicture& picture) {
  const float side = picture_side();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(0.34f, 0.34f, 0.34f, 1));
  const bool pressed = ImGui::Selectable(fmt::format("##{}", name).c_str(), selected, 0, ImVec2(0, side));
  ImGui::PopStyleColor();
  record(name);
  if (!ImGui::IsItemVisible()) return pressed;
  picture(i, to_vec2(at), to_vec2(at) + side);
  ImGui::GetWindowDrawList()->AddText(
      ImVec2(at.x + side + 8 * scale_, at.y + 0.5f * (side - ImGui::GetTextLineHeight())),
      ImGui::GetColorU32(ImGuiCol_Text), label);
  return pressed;
}

bool Ui::choice(const char* name, const char* label, int& value, std::span<const std::string_view> choices,
                std::string_view tip, const ItemPicture& picture) {
  label_cell(name, label, false);
  tooltip(tip);
  const bool changed = choice_widget(name, value, choices, picture);
  tooltip(tip);
  return changed;
}

bool Ui::number(const char* name, const char* label, float& value, float lo, float hi, const char* format,
                float initial, std::string_view tip) {
  label_cell(name, label, value != initial);
  bool reset = double_clicked_here();
  tooltip(tip);
  ImGui::SameLine(kLabelWidth * scale_ + ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextItemWidth(-1);
  Scalar edited{false, 0, value};
  const NumberStyle style{false, true, true, lo, hi, 0, format};
  bool changed = scalar(fmt::format("##{}", name).c_str(), edited, style, reset);
  record(name);
  tooltip(tip);
  if (reset) edited.f = initial, changed = value != initial;
  value = std::clamp(edited.f, lo, hi);
  return changed;
}

bool Ui::text(const char* name, const char* hint, std::string& value, float width) {
  ImGui::SetNextItemWidth(width);
  const bool entered = ImGui::InputTextWithHint(fmt::format("##{}", name).c_str(), hint, &value,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  record(name);
  return entered;
}

bool Ui::asked_path(const char* name, const char* hint, std::string& value, float width, bool& wanted) {
  const ImGuiID item = ImGui::GetID(fmt::format("##{}", name).c_str());
  if (wanted && ImGui::GetActiveID() != item) ImGui::SetKeyboardFocusHere();
  const bool entered = text(name, hint, value, width);
  if (!wanted || ImGui::GetActiveID() != item) return entered;
  wanted = false;
  if (ImGuiInputTextState* state = ImGui::GetInputTextState(item)) { // folder and ending usually stay
    const std::size_t slash = value.rfind('/'), begin = slash == std::string::npos ? 0 : slash + 1;
    const std::size_t dot = value.rfind('.'),
                      end = dot == std::string::npos || dot <= begin ? value.size() : dot;
    state->Stb.select_start = ImTextCountCharsFromUtf8(value.c_str(), value.c_str() + begin);
    state->Stb.select_end = state->Stb.cursor = ImTextCountCharsFromUtf8(value.c_str(), value.c_str() + end);
  }
  return entered;
}

void Ui::readout(const char* label, std::string_view value, std::string_view tip) {
  ImGui::TextDisabled("%s", label);
  tooltip(tip);
  ImGui::SameLine(kLabelWidth * scale_ + ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(value.data(), value.data() + value.size());
  tooltip(tip);
}

void Ui::label_cell(const std::string& name, std::string_view label, bool changed) {
  ImGui::AlignTextToFramePadding();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (changed) // a dot in the margin: not the default
    ImGui::GetWindowDrawList()->AddCircleFilled(
        ImVec2(at.x - 5.5f * scale_, at.y + 0.5f * ImGui::GetFrameHeight()), 2.2f * scale_,
        ImGui::GetColorU32(ImGuiCol_CheckMark));
  // One that is too long for its column ends in dots; its tooltip has the key.
  std::string shown(label);
  const float room = (kLabelWidth - 6) * scale_;
  for (std::size_t kept = label.size(); kept > 0 && ImGui::CalcTextSize(shown.c_str()).x > room;)
    shown = fmt::format("{}...", label.substr(0, --kept));
  ImGui::TextUnformatted(shown.c_str());
  record(name + "#label");
}

bool Ui::double_clicked_here() const {
  return ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
}

bool Ui::choice_widget(const std::string& name, int& value, std::span<const std::string_view> choices,
                       const ItemPicture& picture) {
  ImGui::SameLine(kLabelWidth * scale_ + ImGui::GetStyle().WindowPadding.x);
  ImGui::SetNextItemWidth(-1);
  bool changed = false;
  const std::string current(choices[static_cast<std::size_t>(value)]);
  const bool open =
      ImGui::BeginCombo(fmt::format("##{}", name).c_str(), current.c_str(), ImGuiComboFlags_HeightLargest);
  // If the popup is open, BeginCombo has begun its window, so the combo's rectangle must be taken before.
  if (!open) {
    record(name);
    return false;
  }
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const bool selected = value == static_cast<int>(i);
    const std::string id = fmt::format("{}/{}", name, choices[i]), text(choices[i]);
    const bool pressed =
        picture ? item(id, text.c_str(), selected, i, picture) : item(id, text.c_str(), selected);
    if (pressed && !selected) value = static_cast<int>(i), changed = true;
  }
  ImGui::EndCombo();
  record(name);
  return changed;
}

bool Ui::field(const std::string& name, const FieldInfo& row, void* value, const FieldContext& context) {
  ImGui::PushID(name.c_str());
  label_cell(name, context.label.empty() ? humanised(row.key) : context.label,
             context.initial != nullptr && !field_equal(row, value, context.initial));
  bool reset = double_clicked_here();
  const std::string tip = field_tooltip(row, context.initial);
  tooltip(tip);
  const float column = kLabelWidth * scale_ + ImGui::GetStyle().WindowPadding.x;

  alignas(
      vec3) unsigned char storage[sizeof(vec3)] = {}; // a copy of the value, so that an edit can be refused
  void* edited = storage;
  field_copy(row, edited, value);
  switch (row.type) {
  case FieldType::boolean:
    ImGui::SameLine(column);
    ImGui::Checkbox("##value", static_cast<bool*>(edited));
    record(name);
    tooltip(tip);
    break;
  case FieldType::choice: {
    int index = 0;
    std::copy_n(storage, sizeof index, reinterpret_cast<unsigned char*>(&index));
    choice_widget(name, index, row.choices);
    tooltip(tip);
    std::copy_n(reinterpret_cast<unsigned char*>(&index), sizeof index, storage);
    break;
  }
  case FieldType::integer:
  case FieldType::real:
  case FieldType::angle: {
    ImGui::SameLine(column);
    ImGui::SetNextItemWidth(-1);
    Scalar number;
    number.integer = row.type == FieldType::integer;
    if (number.integer)
      number.i = *static_cast<int*>(edited);
    else if (row.type == FieldType::angle)
      number.f = degrees(*static_cast<float*>(edited));
    else
      number.f = *static_cast<float*>(edited);
    const Scalar before = number;
    scalar("##value", number,
           style_of(row, number.integer ? number.i : static_cast<double>(number.f), context), reset);
    record(name);
    tooltip(tip);
    if (number == before) break; // converting to degrees and back may change the float
    if (number.integer)
      *static_cast<int*>(edited) =
          static_cast<int>(std::clamp(static_cast<double>(number.i), row.minimum, row.maximum));
    else {
      const auto clamped =
          static_cast<float>(std::clamp(static_cast<double>(number.f), row.minimum, row.maximum));
      *static_cast<float*>(edited) = row.type == FieldType::angle ? radians(clamped) : clamped;
    }
    break;
  }
  case FieldType::point:
  case FieldType::color:
    ImGui::SameLine(column);
    vector_field(name, row, *static_cast<vec3*>(edited), context, reset);
    break;
  case FieldType::material: break; // panels draw these, for they know the scene
  }
  ImGui::PopID();
  if (reset && context.initial != nullptr) field_copy(row, edited, context.initial);
  if (field_equal(row, edited, value) || !field_problem(row, edited).empty()) return false;
  field_copy(row, value, edited);
  return true;
}

} // namespace candela
