#pragma once
// The words of a line of an OBJ or MTL file.

#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace candela {

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Cuts the first word off `rest` and returns it; empty at the end of the line.
inline std::string_view next_word(std::string_view& rest) {
  std::size_t begin = 0;
  while (begin < rest.size() && is_blank(rest[begin])) ++begin;
  std::size_t end = begin;
  while (end < rest.size() && !is_blank(rest[end])) ++end;
  std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

enum class RealWord { good, no_number, not_finite };

/// Whether a word is a number that a float can hold. "nan" and "inf" are not finite; too small is 0.
inline RealWord check_real(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  if (word.empty() || word.front() == '+') return RealWord::no_number;
  double value = 0;
  auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status == std::errc::invalid_argument || end != word.data() + word.size()) return RealWord::no_number;
  if (status == std::errc::result_out_of_range) // it tells not in which direction
    return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos
               ? RealWord::good
               : RealWord::not_finite;
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()) ? RealWord::good
                                                                                   : RealWord::not_finite;
}

} // namespace candela
