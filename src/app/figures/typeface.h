#pragma once
// The scalable typeface of window and figures, and coverage bitmaps of its glyphs.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace candela {

/// The preferred installed typeface of Debian's font packages with tabular digits (changing numbers do not
/// jitter); empty if none is installed.
std::filesystem::path find_typeface();

/// The installed typefaces for other scripts in order of preference: Noto and others for Chinese, Japanese
/// and Korean, DejaVu for the rest.
std::vector<std::filesystem::path> find_fallback_typefaces();

/// The code points of a UTF-8 text; invalid bytes are U+FFFD.
std::vector<char32_t> code_points(std::string_view text);

/// A TrueType file. Const, so that several threads may draw with one.
class Typeface {
public:
  /// An Error with ExitCode::display if the file cannot be read or is no font.
  explicit Typeface(const std::filesystem::path& file);
  ~Typeface();
  Typeface(Typeface&&) noexcept;

  /// The typeface of find_typeface(); if there is none, an Error with ExitCode::display that names the
  /// package to install.
  static Typeface installed();

  bool has(char32_t code_point) const;

  /// The advance width in pixels of UTF-8 text of a size (ascent plus descent, pixels).
  float text_width(std::string_view text, float size) const;
  /// Pixels from the top of a line to its baseline.
  float ascent(float size) const;

  struct Glyph {
    int x = 0, y = 0; ///< of the bitmap's top left pixel
    int width = 0, height = 0;
    std::vector<std::uint8_t> coverage; ///< 0 .. 255, row by row
  };
  /// The glyphs of a text whose line begins at (x, top), with subpixel positions along the line.
  std::vector<Glyph> glyphs(std::string_view text, float size, float x, float top) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace candela
