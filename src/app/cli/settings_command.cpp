#include "app/cli/settings_command.h"

#include "app/platform/streams.h"
#include "scene/document.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace candela {

namespace {

using nlohmann::ordered_json;

/// What an edit of the setting restarts.
std::string_view restarts(Invalidates invalidates) {
  switch (invalidates) {
  case Invalidates::nothing: return "nothing";
  case Invalidates::display: return "the display";
  case Invalidates::image: return "the image";
  case Invalidates::scene: return "the scene";
  }
  return "";
}

std::string_view type_name(FieldType type) {
  switch (type) {
  case FieldType::boolean: return "boolean";
  case FieldType::integer: return "integer";
  case FieldType::real: return "real";
  case FieldType::angle: return "angle";
  case FieldType::choice: return "choice";
  case FieldType::point: return "point";
  case FieldType::color: return "color";
  case FieldType::material: return "material";
  }
  return "";
}

/// The value as JSON; the text of numbers and booleans is JSON already.
ordered_json value_json(const Field<Document>& row, const Document& document) {
  std::string text = field_text(row, document);
  if (row.type == FieldType::choice) return text;
  if (row.type == FieldType::point || row.type == FieldType::color) {
    std::ranges::replace(text, ' ', ',');
    text = "[" + text + "]";
  }
  return ordered_json::parse(text);
}

/// null: no bound.
ordered_json bound_json(const FieldInfo& row, double bound) {
  if (!std::isfinite(bound)) return nullptr;
  if (row.type == FieldType::integer) return static_cast<std::int64_t>(bound);
  return bound;
}

} // namespace

std::string markdown_cell(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return out;
}

std::string settings_text() {
  const Document defaults;
  std::size_t key_width = 0, default_width = 0, restarts_width = 0;
  for (const auto& row : settings_table()) {
    key_width = std::max(key_width, row.key.size());
    default_width = std::max(default_width, field_text(row, defaults).size());
    restarts_width = std::max(restarts_width, restarts(row.invalidates).size());
  }
  std::string out = fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", "KEY", key_width, "DEFAULT", default_width,
                                "RESTARTS", restarts_width, "MEANING");
  std::size_t meaning_at = key_width + default_width + restarts_width + 6;
  for (const auto& row : settings_table())
    out += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n{:{}}{}\n", row.key, key_width, field_text(row, defaults),
                       default_width, restarts(row.invalidates), restarts_width, row.help, "", meaning_at,
                       field_domain(row));
  return out;
}

std::string settings_json() {
  const Document defaults;
  ordered_json out = ordered_json::array();
  for (const auto& row : settings_table()) {
    ordered_json entry = {{"key", row.key}, {"type", type_name(row.type)}};
    if (row.type == FieldType::choice) {
      entry["choices"] = row.choices;
    } else if (row.type != FieldType::boolean) {
      entry["minimum"] = bound_json(row, row.minimum);
      entry["maximum"] = bound_json(row, row.maximum);
    }
    std::string_view unit = row.type == FieldType::angle ? "degrees" : row.unit;
    if (!unit.empty()) entry["unit"] = unit;
    entry["default"] = value_json(row, defaults);
    entry["help"] = row.help;
    entry["restarts"] = restarts(row.invalidates);
    out.push_back(std::move(entry));
  }
  return out.dump(2) + "\n";
}

std::string settings_markdown() {
  const Document defaults;
  std::string out = "| key | values | default | meaning | restarts |\n|---|---|---|---|---|\n";
  for (const auto& row : settings_table())
    out += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", row.key, markdown_cell(field_domain(row)),
                       field_text(row, defaults), markdown_cell(row.help), restarts(row.invalidates));
  return out;
}

int run_settings(bool json, bool markdown) {
  print_result(json ? settings_json() : markdown ? settings_markdown() : settings_text());
  return 0;
}

} // namespace candela
