#include "io/obj/mtl_parser.h"

#include "io/files/text_file.h"
#include "io/obj/obj_line.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace candela {

namespace {

/// tinyobj parses the values, but reads invalid numbers as 0, accepts incomplete statements, fills in
/// defaults and has no locations. So each statement is checked here first, and tinyobj gets only valid ones.
class MtlParser {
public:
  MtlParser(const std::string& file, WarningList& warnings) : file_(file), warnings_(warnings) {}

  void line(std::string_view text, int number) {
    std::string_view rest = text;
    key_ = next_word(rest);
    if (key_.empty() || key_.front() == '#') return;
    where_ = {file_, number, static_cast<int>(key_.data() - text.data()) + 1};
    if (key_ == "newmtl") return begin(trimmed(rest));
    constexpr std::string_view kKnown[] = {"Kd", "Ks",    "Ke",     "Tf",     "Kt",     "Ns",    "Ni",    "d",
                                           "Tr", "illum", "map_Kd", "map_Ks", "map_Ke", "map_d", "map_Ns"};
    if (std::ranges::find(kKnown, key_) == std::end(kKnown)) {
      // A path tracer has no ambient term, so Ka is not needed.
      if (key_ != "Ka" && key_ != "map_Ka")
        warnings_.add(where_, fmt::format("'{}' is ignored", shown(key_)));
    } else if (materials.empty()) {
      ignore("it stands before the first newmtl");
    } else if (key_.starts_with("map_")) {
      map(rest);
    } else if (key_.front() == 'K' || key_ == "Tf") {
      color(rest);
    } else {
      number_statement(rest);
    }
  }

  std::vector<MtlStatements> materials;

  /// Called after the last line.
  void take_values() {
    std::vector<tinyobj::material_t> read;
    std::map<std::string, int> index;
    std::string ignored_warnings, ignored_errors; // all statements have been checked
    std::istringstream text(fitting_);
    tinyobj::LoadMtl(&index, &read, &text, &ignored_warnings, &ignored_errors);
    for (std::size_t i = 0; i < std::min(read.size(), materials.size()); ++i) {
      const tinyobj::material_t& from = read[i];
      MtlStatements& m = materials[i];
      auto take = [](std::optional<vec3>& said, const tinyobj::real_t(&c)[3]) {
        if (said) said = vec3(c[0], c[1], c[2]);
      };
      take(m.kd, from.diffuse);
      take(m.ks, from.specular);
      take(m.ke, from.emission);
      take(m.tf, from.transmittance);
      if (m.ns) m.ns = from.shininess;
      if (m.ni) m.ni = from.ior;
      if (m.d) m.d = from.dissolve;
      if (m.illum) m.illum = from.illum;
    }
  }

private:
  static std::string shown(std::string_view word) { return utf8_name(shortened(word)); }

  void ignore(std::string_view why) {
    warnings_.add(where_, fmt::format("'{}' is ignored: {}", shown(key_), why));
  }

  void begin(std::string_view name) {
    if (name.empty()) warnings_.add(where_, "newmtl without a name");
    materials.emplace_back();
    materials.back().name = name;
    materials.back().where = where_;
    fitting_ += fmt::format("newmtl {}\n", materials.size()); // a name without special characters
  }

  bool real(std::string_view word, float& value) {
    double read = 0;
    switch (parse_real(word, read)) {
    case RealWord::good: value = static_cast<float>(read); return true;
    case RealWord::no_number:
      ignore(word.empty() ? "a number is missing" : fmt::format("'{}' is no number", shown(word)));
      return false;
    case RealWord::not_finite: ignore(fmt::format("'{}' is not a finite number", shown(word))); return false;
    }
    return false;
  }

  void color(std::string_view rest) {
    std::string_view after = rest;
    const std::string_view first = next_word(after);
    if (first == "spectral" || first == "xyz")
      return ignore(fmt::format("colours are read as r g b, not {}", first));
    vec3 c(0);
    rest = after;
    if (!real(first, c.x)) return;
    c.y = c.z = c.x; // "Kd 0.5" means a grey (MTL specification)
    if (std::string_view more = trimmed(rest); !more.empty() && more.front() != '#') {
      for (float* value : {&c.y, &c.z})
        if (!real(next_word(rest), *value)) return;
    }
    MtlStatements& m = materials.back();
    (key_ == "Kd" ? m.kd : key_ == "Ks" ? m.ks : key_ == "Ke" ? m.ke : m.tf) = c;
    fitting_ += fmt::format("{} {} {} {}\n", key_, c.x, c.y, c.z);
  }

  void number_statement(std::string_view rest) {
    if (key_ == "d") {
      std::string_view after = rest;
      if (next_word(after) == "-halo") rest = after;
    }
    float value = 0;
    if (!real(next_word(rest), value)) return;
    MtlStatements& m = materials.back();
    std::string_view said = key_;
    if (key_ == "illum") {
      if (!(value >= 0 && value <= 10 && value == std::floor(value)))
        return ignore(fmt::format("there is no illumination model {}", value));
      m.illum = static_cast<int>(value);
    } else if (key_ == "d") {
      m.d = value, d_said_ = materials.size();
    } else if (key_ == "Tr") {
      if (d_said_ == materials.size()) return; // d overrides Tr
      value = 1 - value, said = "d";
      m.d = value;
    } else {
      (key_ == "Ns" ? m.ns : m.ni) = value;
    }
    fitting_ += fmt::format("{} {}\n", said, value);
  }

  void map(std::string_view rest) {
    const MapStatement statement = read_map_statement(rest);
    for (std::string_view option : statement.ignored)
      warnings_.add(where_, fmt::format("{}: the option {} is ignored", key_, option));
    if (statement.file.empty()) return ignore("it names no file");
    MtlStatements& m = materials.back();
    (key_ == "map_Kd"   ? m.map_kd
     : key_ == "map_Ks" ? m.map_ks
     : key_ == "map_Ke" ? m.map_ke
     : key_ == "map_Ns" ? m.map_ns
                        : m.map_d) = {std::string(statement.file), statement.scale, statement.offset, where_};
  }

  const std::string& file_;
  WarningList& warnings_;
  Location where_; ///< of the statement at hand
  std::string_view key_;
  std::size_t d_said_ = 0; ///< the number of the last material with d
  std::string fitting_;    ///< the valid statements
};

} // namespace

std::vector<MtlStatements> parse_mtl(TextLines& lines, const std::string& file, WarningList& warnings) {
  MtlParser parser(file, warnings);
  while (lines.next()) parser.line(lines.line(), lines.number());
  parser.take_values();
  return std::move(parser.materials);
}

} // namespace candela
