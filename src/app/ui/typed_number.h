#pragma once
// Parsing of typed numbers, and formatting for display.

#include <optional>
#include <string>
#include <string_view>

namespace candela {

/// Parses digits with at most one decimal point or comma (1,5 is 1.5), a sign, an exponent, and surrounding
/// blanks. Nothing for other texts: sums, names, hexadecimals, inf, and texts with several points or commas,
/// which are ambiguous (1,234.5).
std::optional<double> typed_number(std::string_view text);

/// At least so many significant digits, without an exponent if the integer part can be written out: 123456,
/// not 1.23e+05. Floats have about seven significant digits.
std::string plain_number(double value, int digits);
/// The same as a printf() format for this value, with which a widget shows and rounds it.
std::string plain_number_format(double value, int digits);

/// The unit in the grammatical number of `number`: "1 stop", "2 stops".
std::string unit_of(std::string_view number, std::string_view plural);

/// "1 scene unit", "2.5 scene units".
std::string scene_units(float length);

/// "1 warning", "3 warnings".
std::string counted(long long count, std::string_view singular);

} // namespace candela
