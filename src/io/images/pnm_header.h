#pragma once
// The headers of PPM, PGM and PFM files.

#include "io/images/image_codec.h"

#include <string_view>

namespace candela {

class PnmHeader {
public:
  /// Starts behind the two letters of the signature, which the caller has checked.
  PnmHeader(ByteView bytes, const Location& where) : bytes_(bytes), where_(where), at_(2) {}

  /// The next number; an input error with its name if it is missing or out of range.
  std::int64_t integer(std::string_view name);
  float real(std::string_view name);
  /// Skips the one white space character behind the header.
  void end();
  /// The bytes after the header.
  ByteView rest() const { return bytes_.subspan(at_); }

private:
  std::string_view word(std::string_view name);

  ByteView bytes_;
  const Location& where_;
  std::size_t at_;
};

} // namespace candela
