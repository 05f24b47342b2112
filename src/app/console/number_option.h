#pragma once
// Options with a number in a range; their errors read like those of settings.

#include "core/fields.h"

#include <CLI/CLI.hpp>

#include <concepts>
#include <optional>
#include <string>

namespace candela {

/// Reads `text` as a value of the row; a usage error with the row's key if it does not fit.
template <class T>
T number_from_text(const FieldInfo& row, const std::string& text) {
  std::conditional_t<std::integral<T>, int, float> value{};
  field_from_text(row, &value, text);
  return static_cast<T>(value);
}

/// Adds an option with the range of `row`; name and help are the option's own.
template <class T>
CLI::Option* add_number(CLI::App& command, const std::string& name, T& target, FieldInfo row,
                        const std::string& help) {
  constexpr bool kIntegral = std::integral<T> || std::same_as<T, std::optional<int>>;
  row.type = kIntegral ? FieldType::integer : FieldType::real;
  return command
      .add_option_function<std::string>(
          name,
          [&target, row, name](const std::string& text) {
            FieldInfo named = row;
            named.key = name;
            if constexpr (std::is_arithmetic_v<T>)
              target = number_from_text<T>(named, text);
            else
              target = number_from_text<typename T::value_type>(named, text);
          },
          help)
      ->type_name(kIntegral ? "INTEGER" : "NUMBER");
}

/// A row for a range.
inline FieldInfo range(double minimum, double maximum, std::string_view unit = "") {
  return {"", FieldType::real, minimum, maximum, unit, ""};
}

} // namespace candela
