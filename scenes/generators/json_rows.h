#pragma once
// Members of a mesh as the generators of scenes write them.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

/// `"key": [...]`, so many values a line, each as text(value) has it.
template <class Value, class Text>
std::string json_rows(std::string_view key, const std::vector<Value>& values, std::size_t a_line, Text text) {
  std::string out = fmt::format("      \"{}\": [", key);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += i % a_line == 0 ? ",\n        " : ", ";
    out += text(values[i]);
  }
  return out + "]";
}
