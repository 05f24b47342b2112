#pragma once
// The scalable typeface of window and figures, and its glyphs as coverage for figures.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace candela {

/// The best of the typefaces of Debian's font packages with tabular digits (so that running numbers stand
/// still) that is installed; empty if none is.
std::filesystem::path find_typeface();

/// Of the typefaces that have the letters of other scripts, those that are installed, the best first: Noto's
/// and others for Chinese, Japanese and Korean, DejaVu for the rest.
std::vector<std::filesystem::path> find_fallback_typefaces();

/// The code points of a UTF-8 text; a byte that begins none is U+FFFD.
std::vector<char32_t> code_points(std::string_view text);

/// A TrueType file. Const, so that several threads may draw with one.
class Typeface {
public:
  /// An Error with ExitCode::display if the file cannot be read or is no font.
  explicit Typeface(const std::filesystem::path& file);
  ~Typeface();
  Typeface(Typeface&&) noexcept;

  /// That of find_typeface(); an Error with ExitCode::display that names the package to install if there is
  /// none.
  static Typeface installed();

  bool has(char32_t code_point) const;

  /// Pixels from the pen's start to its end, for UTF-8 text of a size (ascent plus descent, pixels).
  float text_width(std::string_view text, float size) const;
  /// Pixels from the top of a line to its base line.
  float ascent(float size) const;

  struct Glyph {
    int x = 0, y = 0; ///< of the bitmap's top left pixel
    int width = 0, height = 0;
    std::vector<std::uint8_t> coverage; ///< 0 .. 255, row by row
  };
  /// The glyphs of a text whose line begins at (x, top), placed to a fraction of a pixel along the line.
  std::vector<Glyph> glyphs(std::string_view text, float size, float x, float top) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace candela
