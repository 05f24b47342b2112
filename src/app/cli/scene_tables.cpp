#include "app/cli/scene_tables.h"

#include "app/cli/settings_command.h"
#include "io/candela/candela_json.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// A scene with one thing of which the file says no more than its type.
SceneDesc scene_with(std::string_view list, std::string_view type) {
  WarningList warnings;
  const std::string text =
      fmt::format(R"({{"candela": 1, "{}": [{{"name": "x", "type": "{}"}}]}})", list, type);
  return parse_candela_json(text, "README.md", PathPolicy(".", false), warnings).scene;
}

std::string joined(const std::vector<std::string_view>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The value that most types begin with, then those that begin with another.
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

/// `made(type)` is the thing of that type, `uses(index of the type, key)` whether it looks at the value.
template <class T, class Made, class Uses>
std::string typed_table(std::span<const Field<T>> rows, Made made, Uses uses) {
  const auto all = rows.front().choices;
  std::vector<T> defaults;
  for (std::string_view type : all) defaults.push_back(made(type));
  std::string out = "| key | of | values | default | meaning |\n|---|---|---|---|---|\n";
  for (const auto& row : rows) {
    std::vector<std::string_view> types;
    std::vector<std::string> values;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (uses(static_cast<int>(i), row.key))
        types.push_back(all[i]), values.push_back(field_text(row, defaults[i]));
    const std::string value =
        &row == &rows.front() ? fmt::format("`{}`", field_text(row, T())) : default_cell(types, values);
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", row.key,
                       types.size() == all.size() ? "all" : markdown_cell(joined(types)),
                       markdown_cell(field_domain(row)), value, markdown_cell(row.help));
  }
  return out;
}

} // namespace

std::string materials_markdown() {
  const auto types = material_type_names();
  std::vector<Material> defaults;
  for (std::string_view type : types) defaults.push_back(scene_with("materials", type).materials.front());
  const FieldInfo& type_row = material_type_field();
  std::string out = "| key | of | values | default | meaning |\n|---|---|---|---|---|\n";
  out += fmt::format("| `{}` | all | {} | `{}` | {} |\n", type_row.key, markdown_cell(field_domain(type_row)),
                     material_type_name(Material()), markdown_cell(type_row.help));
  // A line for each key that means the same to its types, in the order in which the types name them; what all
  // have comes last.
  std::vector<const MaterialField*> lines;
  auto is_same = [](const FieldInfo& a, const FieldInfo& b) {
    return a.key == b.key && a.help == b.help && field_domain(a) == field_domain(b);
  };
  for (const Material& material : defaults)
    for (const MaterialField& row : material_fields(material))
      if (std::ranges::none_of(lines, [&](const auto* line) { return is_same(*line, row); }))
        lines.push_back(&row);
  auto is_common = [](const MaterialField* row) {
    return std::ranges::find(common_material_fields(), row->key, &FieldInfo::key) !=
           common_material_fields().end();
  };
  std::ranges::stable_partition(lines, [&](const auto* row) { return !is_common(row); });
  for (const MaterialField* line : lines) {
    std::vector<std::string_view> of;
    std::vector<std::string> values;
    for (const Material& material : defaults)
      for (const MaterialField& row : material_fields(material))
        if (is_same(*line, row))
          of.push_back(material_type_name(material)), values.push_back(field_text(row, material));
    out += fmt::format("| `{}` | {} | {}{} | {} | {} |\n", line->key,
                       of.size() == types.size() ? "all" : markdown_cell(joined(of)),
                       markdown_cell(field_domain(*line)), line->parameter != nullptr ? ", or a texture" : "",
                       default_cell(of, values), markdown_cell(line->help));
  }
  return out;
}

std::string lights_markdown() {
  return typed_table(
      light_fields(), [](std::string_view type) { return scene_with("lights", type).lights.front(); },
      [](int type, std::string_view key) { return light_uses(static_cast<LightType>(type), key); });
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

} // namespace candela
