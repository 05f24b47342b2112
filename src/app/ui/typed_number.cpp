#include "app/ui/typed_number.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace candela {

namespace {

constexpr int kFloatDigits = 7;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Removes the leading digits and returns their number.
std::size_t take_digits(std::string_view& text) {
  std::size_t count = 0;
  while (count < text.size() && is_digit(text[count])) ++count;
  text.remove_prefix(count);
  return count;
}

void take_sign(std::string_view& text) {
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
}

} // namespace

std::optional<double> typed_number(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);

  std::string_view rest = text;
  take_sign(rest);
  std::size_t digits = take_digits(rest);
  if (!rest.empty() && (rest.front() == '.' || rest.front() == ',')) {
    rest.remove_prefix(1);
    digits += take_digits(rest);
  }
  if (digits == 0) return std::nullopt;
  if (!rest.empty() && (rest.front() == 'e' || rest.front() == 'E')) {
    rest.remove_prefix(1);
    take_sign(rest);
    if (take_digits(rest) == 0) return std::nullopt;
  }
  if (!rest.empty()) return std::nullopt;

  std::string plain(text);
  if (const auto comma = plain.find(','); comma != std::string::npos) plain[comma] = '.';
  const char* begin = plain.data() + (plain.front() == '+' ? 1 : 0); // from_chars does not accept a plus sign
  double value = 0;
  const auto read = std::from_chars(begin, plain.data() + plain.size(), value);
  if (read.ec != std::errc() || read.ptr != plain.data() + plain.size()) return std::nullopt;
  return value;
}

std::string plain_number_format(double value, int digits) {
  const double size = std::abs(value);
  if (std::isfinite(size) && size < std::pow(10, kFloatDigits))
    while (digits < kFloatDigits && size >= std::pow(10, digits) - 0.5) ++digits;
  return fmt::format("%.{}g", digits);
}

std::string plain_number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, plain_number_format(value, digits).c_str(), value);
  return text;
}

std::string unit_of(std::string_view number, std::string_view plural) {
  const bool one = number == "1" || number == "-1" || number == "+1";
  if (one && plural.ends_with('s')) plural.remove_suffix(1);
  return std::string(plural);
}

std::string scene_units(float length) {
  const std::string number = plain_number(static_cast<double>(length), 4);
  return fmt::format("{} {}", number, unit_of(number, "scene units"));
}

std::string counted(long long count, std::string_view singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

} // namespace candela
