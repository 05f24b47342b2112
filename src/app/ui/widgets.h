#pragma once
// The widgets that the panels are made of: Dear ImGui's, with a name for each (what a test clicks on), the
// label on the left, the field table's range, unit and help, typed values, and a double click that resets.

#include "core/fields.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace candela {

/// Where a widget was drawn in the last frame, in framebuffer pixels.
struct WidgetRecord {
  std::string name; ///< "path.max_depth"; components append ".x", ".r", …, items "/sobol", labels "#label"
  vec2 lo{0};
  vec2 hi{0};
  vec2 clip_lo{0}; ///< what lies outside of the clip rectangle was scrolled away
  vec2 clip_hi{0};
};

/// What a field's value goes back to, and how to say what an edit of it costs.
struct FieldContext {
  const void* initial = nullptr; ///< the value that a double click brings back
  std::string_view label;        ///< empty: the last part of the key
  float drag_speed = 0.01f;      ///< units a pixel of fields without an upper limit
};

class Ui {
public:
  /// To be called between ImGui::NewFrame() and the first widget. `scale` 1 is 96 dots an inch.
  void begin_frame(float scale);

  std::span<const WidgetRecord> widgets() const { return widgets_; }
  float scale() const { return scale_; }

  /// A fold; true while it is open.
  bool section(const char* name, const char* label, bool open_at_first);
  /// Which folds are open where that is not how they are at first, by name; to be remembered.
  const std::map<std::string, bool>& open_sections() const { return open_sections_; }
  void set_open_sections(std::map<std::string, bool> open) { open_sections_ = std::move(open); }
  bool subsection(const char* name, const char* label, bool open_at_first);
  bool button(const char* name, const char* label, std::string_view tooltip = {}, float width = 0);
  bool item(const std::string& name, const char* label, bool selected);
  bool choice(const char* name, const char* label, int& value, std::span<const std::string_view> choices,
              std::string_view tooltip);
  bool number(const char* name, const char* label, float& value, float lo, float hi, const char* format,
              float initial, std::string_view tooltip);
  /// True when Enter was pressed in it.
  bool text(const char* name, const char* hint, std::string& value, float width);
  /// The same of a path that is asked for: while `wanted`, the field takes the keyboard, with the file's stem
  /// selected; then that is done.
  bool asked_path(const char* name, const char* hint, std::string& value, float width, bool& wanted);
  /// A label and a text that is only read.
  void readout(const char* label, std::string_view value, std::string_view tooltip = {});

  /// One row of a field table with the widget that suits its type; true when the value changed. The value
  /// stays within its row for any text.
  bool field(const std::string& name, const FieldInfo& row, void* value, const FieldContext& context);

  /// Writes down where the last ImGui item is.
  void record(std::string name);
  /// The same for what is drawn without a widget.
  void record(std::string name, vec2 lo, vec2 hi);
  /// The tooltip of the last item, if the mouse is on it and no hand is at work: it would cover what is
  /// typed.
  void tooltip(std::string_view text);

  /// Where in the last frame the field was that is typed into; nothing if none is.
  std::optional<WidgetRecord> typed_field() const { return typed_field_; }
  /// Why what was typed did not count, once for each time; empty if there is nothing to say.
  std::string take_refusal() { return std::exchange(refusal_, {}); }
  /// Until when, on ImGui's clock, the field that refused it is marked.
  double marked_until() const { return marked_until_; }

private:
  struct NumberStyle {
    bool integer = false;
    bool slider = false;
    bool logarithmic = false;
    double lo = 0, hi = 0; ///< of the slider; typed values may leave it, as far as the row allows
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
  bool choice_widget(const std::string& name, int& value, std::span<const std::string_view> choices);
  static NumberStyle style_of(const FieldInfo& row, double value, const FieldContext& context);

  float scale_ = 1;
  std::map<std::string, bool> open_sections_;
  std::vector<WidgetRecord> widgets_;
  // A number that is being typed counts when it is done: 1 and 19 are not values while 192 is typed.
  unsigned typing_ = 0; // ImGui's id of the field, 0: none
  bool typing_drawn_ = false;
  std::string typed_, typed_at_first_; // the text in it, and what it was before
  std::optional<WidgetRecord> typed_field_, typed_now_;
  std::string refusal_;
  unsigned refused_by_ = 0; // ImGui's id of a field
  double marked_until_ = 0;
};

/// The text of a field's tooltip: key, help, domain, what it restarts, how to edit.
std::string field_tooltip(const FieldInfo& row, const void* initial);

} // namespace candela
