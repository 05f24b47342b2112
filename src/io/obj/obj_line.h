#pragma once
// The words of a line of an OBJ or MTL file.

#include "io/files/text_lines.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace candela {

/// Removes the first word from `rest` and returns it; empty at the end of the line.
inline std::string_view next_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

/// A word, shortened for messages.
inline std::string shortened(std::string_view word) { return std::string(word.substr(0, 40)); }

enum class RealWord { good, no_number, not_finite };

/// Parses a number within the range of float; "nan" and "inf" are not finite, too small numbers are 0.
/// `value` is changed only on success.
inline RealWord parse_real(std::string_view word, double& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '+') return RealWord::no_number;
  double read = 0; // from_chars leaves 0 below the range of a double
  auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), read);
  if (status == std::errc::invalid_argument || end != word.data() + word.size()) return RealWord::no_number;
  if (status == std::errc::result_out_of_range && word.find("e-") == std::string_view::npos &&
      word.find("E-") == std::string_view::npos) // it tells not in which direction
    return RealWord::not_finite;
  if (!(std::abs(read) <= static_cast<double>(std::numeric_limits<float>::max())))
    return RealWord::not_finite;
  value = read;
  return RealWord::good;
}

inline RealWord check_real(std::string_view word) {
  double value = 0;
  return parse_real(word, value);
}

} // namespace candela
