#include "io/ies/ies_words.h"

#include "io/files/text_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace candela {

namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\f' || c == '\v' || is_line_end(c);
}
constexpr const char* kRemedy = "give a whole file of IESNA LM-63";

} // namespace

void IesWords::step() {
  const char c = text_[next_++];
  const bool pair = c == '\r' && next_ < text_.size() && text_[next_] == '\n'; // whose LF ends the line
  if (is_line_end(c) && !pair) ++next_line_, line_start_ = next_;
}

std::string_view IesWords::line() {
  mark();
  const std::size_t begin = next_;
  while (next_ < text_.size() && !is_line_end(text_[next_])) ++next_;
  const std::string_view found = text_.substr(begin, next_ - begin);
  const int line = next_line_;
  while (next_ < text_.size() && next_line_ == line) step();
  return trimmed(found);
}

void IesWords::skip_blanks() {
  while (next_ < text_.size() && is_separator(text_[next_])) step();
  mark();
}

bool IesWords::more() {
  skip_blanks();
  return next_ < text_.size();
}

std::string_view IesWords::word(std::string_view element) {
  if (!more()) throw input_error(where(), element, "the file ends here", kRemedy);
  const std::size_t begin = next_;
  while (next_ < text_.size() && !is_separator(text_[next_])) ++next_;
  return text_.substr(begin, next_ - begin);
}

double IesWords::number(std::string_view element) {
  std::string_view w = word(element);
  const std::string shown = utf8_name(w.substr(0, 40));
  if (w.starts_with('+')) w.remove_prefix(1);
  double value = 0; // from_chars leaves it below the range of a double
  const auto [end, status] = std::from_chars(w.data(), w.data() + w.size(), value);
  if (status == std::errc::invalid_argument || end != w.data() + w.size() || w.starts_with('+'))
    throw input_error(where(), element, fmt::format("'{}' is no number", shown), "give a number");
  const bool tiny = status == std::errc::result_out_of_range &&
                    (w.find("e-") != std::string_view::npos || w.find("E-") != std::string_view::npos);
  if ((status == std::errc::result_out_of_range && !tiny) ||
      !(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw input_error(where(), element, fmt::format("'{}' is not finite", shown), "give a finite number");
  return value;
}

int IesWords::count(std::string_view element, int least, int most) {
  const double value = number(element);
  if (value != std::floor(value) || value < least)
    throw input_error(where(), element, fmt::format("{} is no count from {}", value, least),
                      fmt::format("give an integer from {} to {}", least, most));
  if (value > most)
    throw limit_error(where(), element, fmt::format("{:.0f} are more than the {} that are read", value, most),
                      "give a coarser measurement");
  return static_cast<int>(value);
}

int IesWords::choice(std::string_view element, int most) {
  const double value = number(element);
  for (int i = 1; i <= most; ++i)
    if (value == i) return i;
  throw input_error(where(), element, fmt::format("{} is unknown", value),
                    fmt::format("give an integer from 1 to {}", most));
}

void IesWords::expect(std::size_t numbers, std::string_view element) {
  // The shortest is one digit and what ends it.
  if ((text_.size() - next_) / 2 + 1 < numbers)
    throw input_error(where(), element,
                      fmt::format("{} numbers are due, and the file is too short for them", numbers),
                      kRemedy);
}

} // namespace candela
