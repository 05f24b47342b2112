#include "imaging/tone_map.h"

#include "core/color.h"

#include <array>
#include <bit>
#include <cassert>
#include <cstring>

namespace candela {

namespace {

// sRGB by table -----------------------------------------------------------------------------------------
//
// The 255 floats at which the rounded code changes lie at least 2^-7 of their octave apart, so that a bucket
// of floats that share sign, exponent and 7 bits of mantissa holds at most one of them. A bucket's entry is
//   (code at its start) * 2^16 + 2^16 - t,
// where t is the place of the change in the bucket, from 0 to 2^16 (none): adding a float's low 16 bits
// carries into the code exactly from t on. (The idea of a table over the upper bits is Giesen's, "Linear to
// sRGB", 2012; his interpolates and is off by one at times.)

constexpr float kSmallest = 0x1p-13f; // its code is 0
constexpr std::uint32_t kFirstBucket = std::bit_cast<std::uint32_t>(kSmallest) >> 16;
constexpr std::uint32_t kBuckets = (std::bit_cast<std::uint32_t>(1.0f) >> 16) - kFirstBucket;

/// The smallest float whose rounded code is at least `code`.
float code_threshold(int code) {
  double s = (code - 0.5) / 255.0;
  double x = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  float rounded = static_cast<float>(x);
  return static_cast<double>(rounded) >= x ? rounded : std::nextafter(rounded, kInfinity);
}

std::array<std::uint32_t, kBuckets> make_srgb_table() {
  std::array<std::uint32_t, kBuckets> table{};
  int code = 0;
  std::uint32_t next = std::bit_cast<std::uint32_t>(code_threshold(1));
  for (std::uint32_t i = 0; i < kBuckets; ++i) {
    std::uint32_t begin = (kFirstBucket + i) << 16;
    bool changes = code < 255 && next - begin < 0x10000;
    table[i] = (static_cast<std::uint32_t>(code) << 16) + (changes ? 0x10000 - (next - begin) : 0);
    if (changes && ++code < 255) next = std::bit_cast<std::uint32_t>(code_threshold(code + 1));
  }
  assert(code == 255);
  return table;
}

const std::array<std::uint32_t, kBuckets> kSrgbTable = make_srgb_table();

/// Clamps to a table's range; NaN to its start.
inline float clip(float x, float smallest) {
  x = x > smallest ? x : smallest;
  return x < kOneMinusEpsilon ? x : kOneMinusEpsilon;
}

/// The code of a clipped value.
inline std::uint8_t encode(float x, const std::uint32_t* table) {
  std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  return static_cast<std::uint8_t>((table[(bits >> 16) - kFirstBucket] + (bits & 0xffff)) >> 16);
}

// sRGB with a dither ------------------------------------------------------------------------------------
//
// Here the place between two codes is asked for, in 4096ths of a code: by lines over the same buckets, which
// leave the curve by less than 1/2000 of a code. An entry is
//   (value at the bucket's start) * 2^12 + its rise over the bucket, which is below 0.54 codes.

constexpr int kFraction = 12;                 ///< bits
constexpr float kSmallestDithered = 0x1p-21f; // 1/600 of a code
constexpr std::uint32_t kFirstDithered = std::bit_cast<std::uint32_t>(kSmallestDithered) >> 16;
constexpr std::uint32_t kDitheredBuckets = (std::bit_cast<std::uint32_t>(1.0f) >> 16) - kFirstDithered;

std::array<std::uint32_t, kDitheredBuckets> make_dithered_table() {
  auto value_at = [](std::uint32_t bucket) {
    const auto x = static_cast<double>(std::bit_cast<float>((kFirstDithered + bucket) << 16));
    const double s = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<std::uint32_t>(255 * s * (1 << kFraction) + 0.5);
  };
  std::array<std::uint32_t, kDitheredBuckets> table{};
  for (std::uint32_t i = 0; i < kDitheredBuckets; ++i) {
    const std::uint32_t rise = value_at(i + 1) - value_at(i);
    assert(rise < 1 << kFraction);
    table[i] = (value_at(i) << kFraction) + rise;
  }
  return table;
}

const std::array<std::uint32_t, kDitheredBuckets> kDitheredTable = make_dithered_table();

/// In 4096ths of a code, of a clipped value.
inline std::uint32_t fine_code(float x, const std::uint32_t* table) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x), entry = table[(bits >> 16) - kFirstDithered];
  return (entry >> kFraction) + (((entry & 0xfff) * (bits & 0xffff)) >> 16);
}

// The dither is the fraction of x a + y b, a lattice of low discrepancy (Roberts, "The unreasonable
// effectiveness of quasirandom sequences", 2018, R2), times 2^32: every few pixels in any direction hold all
// roundings, so it has none of white noise's clumps.
constexpr std::uint32_t kDitherX = 0xc13fa9a9u, kDitherY = 0x91e10da6u;

// Curves ------------------------------------------------------------------------------------------------

/// Far above every white point, far below where the curves' squares overflow.
constexpr float kLargest = 1e15f;

inline float exposed(float x, float factor) {
  x *= factor;
  x = x > 0 ? x : 0; // NaN too
  return x < kLargest ? x : kLargest;
}

inline vec3 reinhard(vec3 color, float inverse_white_squared) {
  float l = luminance(color);
  return color * ((1 + l * inverse_white_squared) / (1 + l));
}

constexpr float hable(float x) {
  constexpr float a = 0.15f, b = 0.50f, c = 0.10f, d = 0.20f, e = 0.02f, f = 0.30f;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}
constexpr float kHableScale = 1 / hable(11.2f);

inline float filmic(float x) { return hable(2 * x) * kHableScale; }

/// Hill's fit. The matrices take linear Rec. 709 to ACES AP1 with the RRT's desaturation, and back.
inline vec3 aces(vec3 c) {
  const vec3 v(0.59719f * c.x + 0.35458f * c.y + 0.04823f * c.z,
               0.07600f * c.x + 0.90834f * c.y + 0.01566f * c.z,
               0.02840f * c.x + 0.13383f * c.y + 0.83777f * c.z);
  auto curve = [](float x) {
    return (x * (x + 0.0245786f) - 0.000090537f) / (x * (0.983729f * x + 0.4329510f) + 0.238081f);
  };
  const vec3 w(curve(v.x), curve(v.y), curve(v.z));
  return {1.60475f * w.x - 0.53108f * w.y - 0.07367f * w.z, -0.10208f * w.x + 1.10813f * w.y - 0.00605f * w.z,
          -0.00327f * w.x - 0.07276f * w.y + 1.07602f * w.z};
}

/// Values derived from the settings once per picture.
struct Curve {
  explicit Curve(const DisplaySettings& display)
      : kind(display.tone_map), dither(display.dither), factor(std::exp2(display.exposure)),
        inverse_white_squared(kind == ToneMap::reinhard ? 1 / sqr(display.white_point) : 0) {}
  ToneMap kind;
  bool dither;
  float factor;
  float inverse_white_squared; ///< 0 without a white point
};

template <class Map>
void map_colors(float* linear, std::size_t count, Map map) {
  for (std::size_t i = 0; i < count; i += 3) {
    const vec3 color = map(vec3(linear[i], linear[i + 1], linear[i + 2]));
    linear[i] = color.x, linear[i + 1] = color.y, linear[i + 2] = color.z;
  }
}

/// Works in blocks: first the curve, then the encoding to bytes; simple loops that the compiler vectorises.
constexpr std::size_t kBlock = 256;

/// The difference of the dither between two pixels of a row, for the three channels.
constexpr std::array<std::uint32_t, 3 * kBlock> make_dither_steps() {
  std::array<std::uint32_t, 3 * kBlock> steps{};
  for (std::uint32_t i = 0; i < 3 * kBlock; ++i) steps[i] = i / 3 * kDitherX;
  return steps;
}
constexpr std::array<std::uint32_t, 3 * kBlock> kDitherSteps = make_dither_steps();

/// Codes of clipped values of one row; `first` is the dither of their first pixel. With `restrict`, the
/// compiler knows that the bytes do not alias the table, and vectorises the look-ups.
void encode_dithered(const float* __restrict linear, std::size_t count, std::uint32_t first,
                     std::uint8_t* __restrict code) {
  const std::uint32_t* __restrict table = kDitheredTable.data();
  for (std::size_t i = 0; i < count; ++i) {
    // 256 values at the centres of equal parts of (0, 1): 8 from the ends, more than the error of the table.
    const std::uint32_t u = ((first + kDitherSteps[i]) >> 20 & 0xff0) | 8;
    code[i] = static_cast<std::uint8_t>((fine_code(linear[i], table) + u) >> kFraction);
  }
}

struct Block {
  std::array<float, 3 * kBlock> linear;
  std::array<std::uint8_t, 3 * kBlock + 1> code; // one more to read the last pixel as four bytes
};

/// `at` is the place of the block's first pixel in the picture.
void map_block(const vec3* in, std::size_t at, std::size_t pixels, const PictureRows& rows,
               const Curve& curve, Block& block) {
  static_assert(sizeof(vec3) == 3 * sizeof(float));
  std::size_t count = 3 * pixels;
  float* linear = block.linear.data();
  std::memcpy(linear, in, count * sizeof(float));
  for (std::size_t i = 0; i < count; ++i) linear[i] = exposed(linear[i], curve.factor);
  if (curve.kind == ToneMap::reinhard || curve.kind == ToneMap::reinhard_simple)
    map_colors(linear, count, [&](vec3 color) { return reinhard(color, curve.inverse_white_squared); });
  else if (curve.kind == ToneMap::aces)
    map_colors(linear, count, [](vec3 color) { return aces(color); });
  else if (curve.kind == ToneMap::filmic)
    for (std::size_t i = 0; i < count; ++i) linear[i] = filmic(linear[i]);
  // A separate loop: combined with the look-up, g++ would generate mispredicted branches.
  const float smallest = curve.dither ? kSmallestDithered : kSmallest;
  for (std::size_t i = 0; i < count; ++i) linear[i] = clip(linear[i], smallest);
  if (!curve.dither) {
    const std::uint32_t* table = kSrgbTable.data();
    for (std::size_t i = 0; i < count; ++i) block.code[i] = encode(linear[i], table);
    return;
  }
  const auto width = static_cast<std::size_t>(rows.width);
  for (std::size_t done = 0; done < pixels;) { // row by row
    const std::size_t x = (at + done) % width, y = (at + done) / width;
    const std::size_t here = std::min(pixels - done, width - x);
    const std::uint32_t first =
        kDitherX * (static_cast<std::uint32_t>(rows.origin.x) + static_cast<std::uint32_t>(x)) +
        kDitherY * (static_cast<std::uint32_t>(rows.origin.y) + static_cast<std::uint32_t>(y));
    encode_dithered(linear + 3 * done, 3 * here, first, block.code.data() + 3 * done);
    done += here;
  }
}

template <class Store>
void map_blocks(std::span<const vec3> linear, const PictureRows& rows, const DisplaySettings& display,
                Store store) {
  assert(rows.width > 0);
  Curve curve(display);
  Block block;
  block.code.back() = 0;
  for (std::size_t at = 0; at < linear.size(); at += kBlock) {
    std::size_t pixels = std::min(kBlock, linear.size() - at);
    map_block(linear.data() + at, at, pixels, rows, curve, block);
    store(at, pixels, block.code.data());
  }
}

} // namespace

vec3 tone_mapped(vec3 linear, const DisplaySettings& display) {
  Curve curve(display);
  vec3 color(exposed(linear.x, curve.factor), exposed(linear.y, curve.factor),
             exposed(linear.z, curve.factor));
  switch (curve.kind) {
  case ToneMap::reinhard:
  case ToneMap::reinhard_simple: return reinhard(color, curve.inverse_white_squared);
  case ToneMap::filmic: return {filmic(color.x), filmic(color.y), filmic(color.z)};
  case ToneMap::aces: return aces(color);
  case ToneMap::srgb: break;
  }
  return color;
}

float white_level(const DisplaySettings& display) {
  DisplaySettings unexposed = display;
  unexposed.exposure = 0;
  auto is_white = [&](float stops) {
    return srgb8_from_linear(tone_mapped(vec3(std::exp2(stops)), unexposed).y) == 255;
  };
  float lo = -30, hi = 30; // stops; every curve rises
  if (!is_white(hi)) return kInfinity;
  for (int i = 0; i < 40; ++i) (is_white(0.5f * (lo + hi)) ? hi : lo) = 0.5f * (lo + hi);
  return std::exp2(hi - display.exposure);
}

std::uint8_t srgb8_from_linear(float x) { return encode(clip(x, kSmallest), kSrgbTable.data()); }

void tone_map_rgb8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                   std::span<std::uint8_t> rgb) {
  assert(rgb.size() >= 3 * linear.size());
  map_blocks(linear, rows, display, [&](std::size_t at, std::size_t pixels, const std::uint8_t* code) {
    std::memcpy(rgb.data() + 3 * at, code, 3 * pixels);
  });
}

void tone_map_rgba8(std::span<const vec3> linear, PictureRows rows, const DisplaySettings& display,
                    std::span<std::uint8_t> rgba) {
  assert(rgba.size() >= 4 * linear.size());
  map_blocks(linear, rows, display, [&](std::size_t at, std::size_t pixels, const std::uint8_t* code) {
    for (std::size_t i = 0; i < pixels; ++i) { // little-endian: the fourth byte is the uppermost
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, code + 3 * i, 4);
      pixel |= 0xff000000u;
      std::memcpy(rgba.data() + 4 * (at + i), &pixel, 4);
    }
  });
}

} // namespace candela
