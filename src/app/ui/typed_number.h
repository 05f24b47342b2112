#pragma once
// Numbers as people type them, and as they read them.

#include <optional>
#include <string>
#include <string_view>

namespace candela {

/// The number that was typed: digits with at most one decimal point or comma (1,5 is 1.5), a sign, an
/// exponent; blanks around it. Nothing for all else: sums, names, hexadecimals, inf, and texts with a point
/// and a comma or with two of either, of which nobody but the author knows which one is the decimal mark
/// (1,234.5).
std::optional<double> typed_number(std::string_view text);

/// At least so many significant digits, and no exponent where the whole part can be written out: 123456 and
/// not 1.23e+05. Floats have no more than seven digits to tell.
std::string plain_number(double value, int digits);
/// The same as a format of printf() for this value, in which a widget shows and rounds it.
std::string plain_number_format(double value, int digits);

/// A unit as it follows a number that reads `number`: "1 stop", "2 stops".
std::string unit_of(std::string_view number, std::string_view plural);

/// "1 scene unit", "2.5 scene units".
std::string scene_units(float length);

/// "1 warning", "3 warnings".
std::string counted(long long count, std::string_view singular);

} // namespace candela
