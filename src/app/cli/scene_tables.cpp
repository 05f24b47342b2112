#include "app/cli/scene_tables.h"

#include "app/cli/settings_command.h"
#include "io/candela/candela_json.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// A scene with one object, of which the file gives only the type.
SceneDesc scene_with(std::string_view list, std::string_view type) {
  WarningList warnings;
  const std::string text =
      fmt::format(R"({{"candela": 1, "{}": [{{"name": "x", "type": "{}"}}]}})", list, type);
  return parse_candela_json(text, "README.md", PathPolicy(".", false), warnings).scene;
}

/// The most common default, then the types with other defaults.
std::string default_cell(const std::vector<std::string_view>& types, const std::vector<std::string>& values) {
  std::string usual;
  std::ptrdiff_t most = 0;
  for (const std::string& value : values)
    if (auto count = std::ranges::count(values, value); count > most) most = count, usual = value;
  std::string out = fmt::format("`{}`", usual);
  for (std::size_t i = 0; i < types.size(); ++i)
    if (values[i] != usual) out += fmt::format(", {}: `{}`", types[i], values[i]);
  return out;
}

/// A line for each key, and for each meaning of a key that types use differently, in the order of the types'
/// rows; keys of all types come last. `defaults` holds a default object of each type, `rows_of(object)` its
/// rows; `domain(row)` describes the allowed values.
template <class T, class RowsOf, class Domain>
std::string typed_table(const FieldInfo& type_row, const std::vector<T>& defaults, RowsOf rows_of,
                        Domain domain) {
  using Row = std::remove_cvref_t<decltype(rows_of(defaults.front()).front())>;
  auto is_same = [](const FieldInfo& a, const FieldInfo& b) {
    return a.key == b.key && a.help == b.help && field_domain(a) == field_domain(b);
  };
  std::vector<const Row*> lines;
  for (const T& thing : defaults)
    for (const Row& row : rows_of(thing))
      if (std::ranges::none_of(lines, [&](const Row* line) { return is_same(*line, row); }))
        lines.push_back(&row);
  std::string of_types, of_all;
  for (const Row* line : lines) {
    std::vector<std::string_view> of;
    std::vector<std::string> values;
    for (std::size_t type = 0; type < defaults.size(); ++type)
      for (const Row& row : rows_of(defaults[type]))
        if (is_same(*line, row))
          of.push_back(type_row.choices[type]), values.push_back(field_text(row, defaults[type]));
    const bool all = of.size() == defaults.size();
    (all ? of_all : of_types) +=
        fmt::format("| `{}` | {} | {} | {} | {} |\n", line->key,
                    all ? "all" : markdown_cell(fmt::format("{}", fmt::join(of, ", "))), domain(*line),
                    default_cell(of, values), markdown_cell(line->help));
  }
  return fmt::format("| key | of | values | default | meaning |\n|---|---|---|---|---|\n"
                     "| `{}` | all | {} | `{}` | {} |\n{}{}",
                     type_row.key, markdown_cell(field_domain(type_row)), type_row.choices.front(),
                     markdown_cell(type_row.help), of_types, of_all);
}

} // namespace

std::string materials_markdown() {
  std::vector<Material> defaults;
  for (std::string_view type : material_type_names())
    defaults.push_back(scene_with("materials", type).materials.front());
  return typed_table(
      material_type_field(), defaults, [](const Material& material) { return material_fields(material); },
      [](const MaterialField& row) {
        return markdown_cell(field_domain(row)) + (row.parameter != nullptr ? ", or a texture" : "");
      });
}

std::string lights_markdown() {
  std::vector<LightDesc> defaults;
  for (std::string_view type : light_type_names())
    defaults.push_back(scene_with("lights", type).lights.front());
  return typed_table(
      light_type_field(), defaults, [](const LightDesc& light) { return light_fields(light); },
      [](const FieldInfo& row) { return markdown_cell(field_domain(row)); });
}

std::string media_markdown() {
  std::vector<MediumDesc> defaults;
  for (std::string_view type : medium_type_field().choices)
    defaults.push_back(scene_with("media", type).media.front());
  return typed_table(
      medium_type_field(), defaults, [](const MediumDesc& medium) { return medium_fields(medium); },
      [](const FieldInfo& row) { return markdown_cell(field_domain(row)); });
}

std::string phases_markdown() {
  std::vector<PhaseDesc> defaults;
  for (std::size_t type = 0; type < phase_type_field().choices.size(); ++type)
    defaults.push_back(default_phase(static_cast<int>(type)));
  return typed_table(
      phase_type_field(), defaults, [](const PhaseDesc& phase) { return phase_fields(phase); },
      [](const FieldInfo& row) { return markdown_cell(field_domain(row)); });
}

std::string shapes_markdown() {
  std::string out = "| shape | key | values | default | meaning |\n|---|---|---|---|---|\n";
  for (std::string_view name : shape_names()) {
    const auto shape = shape_of_name(name);
    if (!shape) continue;
    for (const auto& row : shape_fields(*shape))
      out += fmt::format("| {} | `{}` | {} | `{}` | {} |\n", name, row.key, markdown_cell(field_domain(row)),
                         field_text(row, *shape), markdown_cell(row.help));
  }
  return out;
}

std::string motion_markdown() {
  std::string out = "| key | values | default | meaning |\n|---|---|---|---|\n";
  for (const auto& row : motion_fields())
    out += fmt::format("| `{}` | {} | `{}` | {} |\n", row.key, markdown_cell(field_domain(row)),
                       field_text(row, Motion()), markdown_cell(row.help));
  return out;
}

} // namespace candela
