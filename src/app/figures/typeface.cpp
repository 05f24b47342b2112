#include "app/figures/typeface.h"

#include "app/platform/data_file.h"
#include "core/error.h"

#include <fmt/format.h>
#include <stb_truetype.h>

#include <array>
#include <cmath>
#include <string>
#include <system_error>

namespace candela {

namespace {

// fonts-roboto-unhinted and fonts-dejavu-core have tabular digits; fonts-inter has them only as an OpenType
// feature, which neither ImGui nor stb_truetype can switch on.
constexpr std::array kTypefaces = {
    "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/roboto/Roboto-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
};

// Of the packages fonts-noto-cjk, fonts-droid-fallback, fonts-wqy-microhei, fonts-wqy-zenhei, fonts-nanum,
// fonts-vlgothic, fonts-dejavu-core and fonts-unifont.
constexpr std::array kFallbacks = {
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-zenhei.ttc",
    "/usr/share/fonts/truetype/nanum/NanumGothic.ttf",
    "/usr/share/fonts/truetype/vlgothic/VL-Gothic-Regular.ttf",
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/opentype/unifont/unifont.otf",
};

/// Removes the first code point from a UTF-8 text; an invalid byte is U+FFFD.
int next_code_point(std::string_view& text) {
  auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  unsigned code = length == 1 ? first : first & (0x7fu >> length);
  bool valid = length > 0;
  for (std::size_t i = 1; i < length; ++i) {
    valid &= (byte(i) & 0xc0) == 0x80;
    code = code << 6 | (byte(i) & 0x3f);
  }
  text.remove_prefix(valid ? length : 1);
  return valid ? static_cast<int>(code) : 0xfffd;
}

} // namespace

std::filesystem::path find_typeface() {
  for (const char* file : kTypefaces) {
    std::error_code failed;
    if (std::filesystem::is_regular_file(file, failed)) return file;
  }
  return {};
}

std::vector<std::filesystem::path> find_fallback_typefaces() {
  std::vector<std::filesystem::path> found;
  for (const char* file : kFallbacks) {
    std::error_code failed;
    if (std::filesystem::is_regular_file(file, failed)) found.emplace_back(file);
  }
  return found;
}

std::vector<char32_t> code_points(std::string_view text) {
  std::vector<char32_t> out;
  while (!text.empty()) out.push_back(static_cast<char32_t>(next_code_point(text)));
  return out;
}

struct Typeface::Data {
  std::string file;
  stbtt_fontinfo info{};
  float ascent = 0; ///< of a line one pixel high
};

Typeface::Typeface(const std::filesystem::path& file) : data_(std::make_unique<Data>()) {
  data_->file = read_text_file(file);
  const auto* bytes = reinterpret_cast<const unsigned char*>(data_->file.data());
  const int offset = data_->file.size() < 12 ? -1 : stbtt_GetFontOffsetForIndex(bytes, 0);
  if (offset < 0 || stbtt_InitFont(&data_->info, bytes, offset) == 0)
    throw Error(ExitCode::display,
                fmt::format("{}: font: it is no TrueType file: install its package again", file.string()));
  int ascent = 0, descent = 0, gap = 0;
  stbtt_GetFontVMetrics(&data_->info, &ascent, &descent, &gap);
  data_->ascent = static_cast<float>(ascent) / static_cast<float>(ascent - descent);
}

Typeface::~Typeface() = default;
Typeface::Typeface(Typeface&&) noexcept = default;

Typeface Typeface::installed() {
  const std::filesystem::path file = find_typeface();
  if (file.empty())
    throw Error(ExitCode::display,
                "font: no scalable typeface is installed: install the package fonts-roboto-unhinted");
  return Typeface(file);
}

bool Typeface::has(char32_t code_point) const {
  return stbtt_FindGlyphIndex(&data_->info, static_cast<int>(code_point)) != 0;
}

float Typeface::ascent(float size) const { return data_->ascent * size; }

float Typeface::text_width(std::string_view text, float size) const {
  const float scale = stbtt_ScaleForPixelHeight(&data_->info, size);
  float width = 0;
  int previous = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(&data_->info, next_code_point(text));
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(&data_->info, glyph, &advance, &bearing);
    if (previous != 0) advance += stbtt_GetGlyphKernAdvance(&data_->info, previous, glyph);
    width += scale * static_cast<float>(advance);
    previous = glyph;
  }
  return width;
}

std::vector<Typeface::Glyph> Typeface::glyphs(std::string_view text, float size, float x, float top) const {
  const stbtt_fontinfo* info = &data_->info;
  const float scale = stbtt_ScaleForPixelHeight(info, size);
  const int base_line = static_cast<int>(std::lround(top + ascent(size)));
  std::vector<Glyph> out;
  int previous = 0;
  while (!text.empty()) {
    const int glyph = stbtt_FindGlyphIndex(info, next_code_point(text));
    if (previous != 0) x += scale * static_cast<float>(stbtt_GetGlyphKernAdvance(info, previous, glyph));
    const float whole = std::floor(x);
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(info, glyph, scale, scale, x - whole, 0, &x0, &y0, &x1, &y1);
    if (x1 > x0 && y1 > y0) {
      Glyph g{static_cast<int>(whole) + x0, base_line + y0, x1 - x0, y1 - y0, {}};
      g.coverage.resize(static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height));
      stbtt_MakeGlyphBitmapSubpixel(info, g.coverage.data(), g.width, g.height, g.width, scale, scale,
                                    x - whole, 0, glyph);
      out.push_back(std::move(g));
    }
    int advance = 0, bearing = 0;
    stbtt_GetGlyphHMetrics(info, glyph, &advance, &bearing);
    x += scale * static_cast<float>(advance);
    previous = glyph;
  }
  return out;
}

} // namespace candela
