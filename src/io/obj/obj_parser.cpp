#include "io/obj/obj_parser.h"

#include "core/color.h"
#include "io/files/text_file.h"
#include "io/obj/obj_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::string_view kBrokenFace = "faces with a corner that is nowhere are dropped";

/// Some programs write decimal commas, depending on the locale.
RealWord parse_real_or_decimal_comma(std::string_view word, double& value, bool& comma) {
  RealWord state = parse_real(word, value);
  const auto at = word.find(',');
  if (state != RealWord::no_number || at == word.npos || word.find('.') != word.npos) return state;
  std::string pointed(word);
  pointed[at] = '.';
  state = parse_real(pointed, value);
  comma |= state == RealWord::good;
  return state;
}

} // namespace

Error bad_obj_index(const Location& where, std::string_view kind, int index, std::size_t count, bool so_far) {
  return input_error(where, "f",
                     fmt::format("index {} is out of range: there are {} {} lines{}", index, count, kind,
                                 so_far ? " so far" : ""),
                     "indices count from 1, or from -1 backwards; export the file again");
}

Location ObjParser::at(std::string_view word) const {
  return {file_, number_, static_cast<int>(word.data() - line_.data()) + 1};
}

void ObjParser::lose(const Location& where, std::string_view warning, const Error& cause) {
  warnings_.add(where, warning);
  if (!contents.first_loss) contents.first_loss = cause;
}

void ObjParser::line(std::string_view text, int number) {
  constexpr std::size_t kLongestLine = std::size_t{16} << 20;
  line_ = text, number_ = number;
  if (text.size() > kLongestLine)
    throw limit_error({file_, number, 1}, "OBJ", fmt::format("a line of more than {} bytes", kLongestLine),
                      "export the file again");
  std::string_view rest = text;
  std::string_view key = next_word(rest);
  if (key.empty() || key.front() == '#') return;
  if (key.front() == 'v' || key.front() == 'f') { // a comment may follow numbers; names may contain a '#'
    rest = rest.substr(0, rest.find('#'));
    if (key == "v") return vertex(rest);
    double n[3] = {0, 0, 0};
    if (key == "vn") {
      if (!reals(key, rest, 3, n)) warnings_.add(at(key), "normals that are no numbers: flat there");
      return contents.normals.push_back(vec3(n[0], n[1], n[2]));
    }
    if (key == "vt") {
      if (!reals(key, rest, 1, n)) warnings_.add(at(key), "texture coordinates that are no numbers: 0 there");
      return contents.uvs.push_back(vec2(n[0], n[1]));
    }
    if (key == "f" || key == "fo") return face(key, rest); // fo: what f was called once
  }
  if (key == "usemtl")
    material_ = trimmed(rest), slot_.reset();
  else if (key == "mtllib")
    on_mtllib(trimmed(rest), at(key));
  else if (key != "o" && key != "g" && key != "s")
    warnings_.add(at(key), fmt::format("'{}' is ignored", utf8_name(shortened(key))));
}

/// Parses the first numbers of `words`; zeros, and false, if one of the first `at_least` is invalid.
template <std::size_t N>
bool ObjParser::reals(std::string_view key, std::string_view words, std::size_t at_least, double (&out)[N]) {
  bool comma = false;
  for (std::size_t i = 0; i < N; ++i) {
    std::string_view word = next_word(words);
    RealWord state = word.empty() ? RealWord::no_number : parse_real_or_decimal_comma(word, out[i], comma);
    if (state == RealWord::good) continue;
    if (i >= at_least && word.empty()) break;
    std::ranges::fill(out, 0.0);
    if (contents.first_loss || key != "v") return false;
    const auto end = static_cast<int>(line_.find_last_not_of(" \t")) + 2;
    contents.first_loss =
        word.empty() ? input_error({file_, number_, end}, key, fmt::format("{} of {} numbers", i, at_least),
                                   "give all of them")
        : state == RealWord::no_number
            ? input_error(at(word), key, fmt::format("'{}' is no number", utf8_name(shortened(word))),
                          "give decimal numbers")
            : input_error(at(word), key, fmt::format("'{}' is not a finite number", shortened(word)),
                          "give a finite number");
    return false;
  }
  if (comma) warnings_.add({file_, number_, 1}, "decimal commas are read as points");
  return true;
}

void ObjParser::vertex(std::string_view words) {
  double v[3];
  if (reals("v", words, 3, v)) {
    contents.positions.push_back({v[0], v[1], v[2]});
    for (int i = 0; i < 3; ++i) next_word(words);
    color(words);
  } else {
    warnings_.add({file_, number_, 1},
                  "vertices that are no numbers are dropped, with the faces that use them");
    contents.positions.push_back(glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
  }
}

/// Of the last position. Programs that write colours there (MeshLab, ZBrush, Blender) write them as screens
/// show them. A fourth number alone is the weight of a rational curve's point.
void ObjParser::color(std::string_view words) {
  vec3 linear;
  for (int c = 0; c < 3; ++c) {
    const std::string_view word = next_word(words);
    if (word.empty()) return;
    double value = 1;
    bool comma = false;
    if (parse_real_or_decimal_comma(word, value, comma) != RealWord::good)
      warnings_.add(at(word), "vertex colours that are no numbers: white there");
    else if (!(value >= 0 && value <= 1))
      warnings_.add(at(word), "vertex colours outside of [0, 1] are clamped");
    linear[c] = linear_from_srgb(static_cast<float>(std::clamp(value, 0.0, 1.0)));
  }
  while (contents.colors.size() + 1 < contents.positions.size()) contents.colors.push_back(vec3(1));
  contents.colors.push_back(linear);
}

void ObjParser::face(std::string_view key, std::string_view words) {
  constexpr int kMaxCorners = 4096; // ear clipping takes quadratic time
  const std::size_t first = contents.corners.size();
  int count = 0;
  std::optional<Error> broken;
  Location broken_at;
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    ObjCorner c;
    if (auto problem = corner(word, c); problem && !broken) broken = std::move(problem), broken_at = at(word);
    contents.corners.push_back(c);
    if (++count > kMaxCorners)
      throw limit_error(at(word), "f", fmt::format("a polygon of more than {} corners", kMaxCorners),
                        "split it in the modelling program");
  }
  if (broken) {
    lose(broken_at, kBrokenFace, *broken);
  } else if (count < 3) {
    warnings_.add(at(key), "faces with fewer than three corners are dropped");
  } else {
    contents.faces.push_back({static_cast<std::uint32_t>(first), count, current_slot(), number_});
    return;
  }
  contents.corners.truncate(first);
}

/// Parses v, v/vt, v//vn or v/vt/vn; parts after the first may be empty. Returns the error if its vertex is
/// invalid.
std::optional<Error> ObjParser::corner(std::string_view word, ObjCorner& out) const {
  std::string_view rest = word;
  int* const parts[] = {&out.v, &out.vt, &out.vn};
  for (Kind kind : {position, uv, normal}) {
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    if (slash > 0 || kind == position)
      if (auto problem = index(kind, rest.substr(0, slash), word, *parts[kind])) return problem;
    if (slash == rest.size()) return std::nullopt;
    rest.remove_prefix(slash + 1);
  }
  return input_error(at(word), "f", fmt::format("'{}' has too many parts", utf8_name(shortened(word))),
                     "write v/vt/vn");
}

/// Returns an error for words that are not indices, and for invalid positions; other attributes are optional.
std::optional<Error> ObjParser::index(Kind kind, std::string_view digits, std::string_view word,
                                      int& out) const {
  std::string_view magnitude = digits;
  if (!magnitude.empty() && (magnitude.front() == '-' || magnitude.front() == '+'))
    magnitude.remove_prefix(1);
  if (magnitude.empty() || !std::ranges::all_of(magnitude, is_digit))
    return input_error(at(word), "f", fmt::format("'{}' is no corner", utf8_name(shortened(word))),
                       "write v, v/vt, v//vn or v/vt/vn with integers");
  const std::size_t counts[] = {contents.positions.size(), contents.uvs.size(), contents.normals.size()};
  const auto count = static_cast<int>(counts[kind]);
  constexpr std::size_t kMostDigits = 9; // always fits an int; the file's limit allows fewer vertices
  int value = 0;
  const bool negative = digits.front() == '-', huge = magnitude.size() > kMostDigits;
  if (!huge) std::from_chars(magnitude.data(), magnitude.data() + magnitude.size(), value);
  out = value == 0 || (negative && value > count) ? ObjCorner::kMissing
        : negative                                ? count - value
                                                  : value - 1;
  if (out != ObjCorner::kMissing || kind != position) return std::nullopt;
  if (huge)
    return input_error(at(word), "f", "an index is far out of range",
                       "indices count from 1, or from -1 backwards; export the file again");
  return bad_obj_index(at(word), "v", negative ? -value : value, counts[kind], negative);
}

std::uint32_t ObjParser::current_slot() {
  if (!slot_) {
    auto [known, is_new] =
        slots_.try_emplace(utf8_name(material_), static_cast<std::uint32_t>(contents.slot_names.size()));
    if (is_new) contents.slot_names.push_back(known->first), contents.slot_materials.push_back(material_);
    slot_ = known->second;
  }
  return *slot_;
}

} // namespace candela
