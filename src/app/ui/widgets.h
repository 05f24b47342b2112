#pragma once
// The panels' widgets: Dear ImGui's with names (for the tests), labels on the left, range, unit and help from
// the field tables, typed values, and reset by a double click.

#include "core/fields.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace candela {

/// The rectangle of a widget in the last frame, framebuffer pixels.
struct WidgetRecord {
  std::string name; ///< "path.max_depth"; components append ".x", ".r", …, items "/sobol", labels "#label"
  vec2 lo{0};
  vec2 hi{0};
  vec2 clip_lo{0}; ///< parts outside of the clip rectangle are hidden by scrolling
  vec2 clip_hi{0};
};

/// The default value and the appearance of a field.
struct FieldContext {
  const void* initial = nullptr; ///< the value that a double click restores
  std::string_view label;        ///< empty: the last part of the key
  float drag_speed = 0.01f;      ///< units per pixel, for fields without an upper limit
};

class Ui {
public:
  /// Called between ImGui::NewFrame() and the first widget. `scale` 1 is 96 dots per inch.
  void begin_frame(float scale);

  std::span<const WidgetRecord> widgets() const { return widgets_; }
  float scale() const { return scale_; }

  /// A collapsible section; true while it is open.
  bool section(const char* name, const char* label, bool open_at_first);
  /// Sections whose open state differs from the default, by name; stored in the preferences.
  const std::map<std::string, bool>& open_sections() const { return open_sections_; }
  void set_open_sections(std::map<std::string, bool> open) { open_sections_ = std::move(open); }
  bool subsection(const char* name, const char* label, bool open_at_first);
  bool button(const char* name, const char* label, std::string_view tooltip = {}, float width = 0);
  bool item(const std::string& name, const char* label, bool selected);
  /// Draws the picture of a list's item i into a square (framebuffer pixels). Called of visible items only.
  using ItemPicture = std::function<void(std::size_t i, vec2 lo, vec2 hi)>;
  /// Side of the square.
  float picture_side() const;
  bool item(const std::string& name, const char* label, bool selected, std::size_t i,
            const ItemPicture& picture);
  /// With pictures if there is such a function.
  bool choice(const char* name, const char* label, int& value, std::span<const std::string_view> choices,
              std::string_view tooltip, const ItemPicture& picture = {});
  bool number(const char* name, const char* label, float& value, float lo, float hi, const char* format,
              float initial, std::string_view tooltip);
  /// A text field; true when Enter was pressed in it.
  bool text(const char* name, const char* hint, std::string& value, float width);
  /// A text field for a requested path: if `wanted`, it gets the keyboard focus with the file's stem
  /// selected, and `wanted` is cleared.
  bool asked_path(const char* name, const char* hint, std::string& value, float width, bool& wanted);
  /// A label and a read-only text.
  void readout(const char* label, std::string_view value, std::string_view tooltip = {});

  /// The widget of a row of a field table; true when the value changed. Typed values are clamped to the row's
  /// range.
  bool field(const std::string& name, const FieldInfo& row, void* value, const FieldContext& context);

  /// Records the rectangle of the last ImGui item.
  void record(std::string name);
  /// Records the rectangle of something drawn without a widget.
  void record(std::string name, vec2 lo, vec2 hi);
  /// The tooltip of the last item, if the mouse is on it and nothing is being edited: it would cover the
  /// typed text.
  void tooltip(std::string_view text);

  /// The rectangle of the active text field in the last frame, if any.
  std::optional<WidgetRecord> typed_field() const { return typed_field_; }
  /// Why the last entry was refused; returned once, then empty.
  std::string take_refusal() { return std::exchange(refusal_, {}); }
  /// The time on ImGui's clock until which the refusing field is marked.
  double marked_until() const { return marked_until_; }

private:
  struct NumberStyle {
    bool integer = false;
    bool slider = false;
    bool logarithmic = false;
    double lo = 0, hi = 0; ///< range of the slider; typed values may exceed it within the row's range
    float speed = 0.01f;
    std::string format;
  };
  struct Scalar { ///< an int or a float
    bool integer = false;
    int i = 0;
    float f = 0;
    bool operator==(const Scalar&) const = default;
  };

  void label_cell(const std::string& name, std::string_view label, bool changed);
  bool double_clicked_here() const;
  bool scalar(const char* id, Scalar& value, const NumberStyle& style, bool& reset);
  bool type_scalar(unsigned item, const char* id, Scalar& value, const NumberStyle& style);
  bool take_typed(unsigned item, Scalar& value, const NumberStyle& style);
  void refuse(unsigned item, std::string why);
  void mark_refusal(unsigned item) const;
  bool vector_field(const std::string& name, const FieldInfo& row, vec3& value, const FieldContext& context,
                    bool& reset);
  bool color_swatch(const std::string& name, vec3& linear);
  bool color_picker(const std::string& name, vec3& encoded);
  bool color_code(const std::string& name, vec3& encoded);
  bool choice_widget(const std::string& name, int& value, std::span<const std::string_view> choices,
                     const ItemPicture& picture = {});
  static NumberStyle style_of(const FieldInfo& row, double value, const FieldContext& context);

  float scale_ = 1;
  std::map<std::string, bool> open_sections_;
  std::vector<WidgetRecord> widgets_;
  // A typed number is applied when the entry is finished: while 192 is typed, 1 and 19 are not.
  unsigned typing_ = 0; // ImGui's id of the field, 0: none
  bool typing_drawn_ = false;
  std::string typed_, typed_at_first_; // the current text, and the initial one
  std::optional<WidgetRecord> typed_field_, typed_now_;
  std::string refusal_;
  unsigned refused_by_ = 0; // ImGui's id of a field
  double marked_until_ = 0;
};

/// A field's key in words, as panels show it.
std::string field_label(const FieldInfo& row);
/// The text of a field's tooltip: key, help, domain, what it restarts, how to edit.
std::string field_tooltip(const FieldInfo& row, const void* initial);

} // namespace candela
