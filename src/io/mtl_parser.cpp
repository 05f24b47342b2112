#include "io/mtl_parser.h"

#include "io/obj_line.h"
#include "io/text_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

class MtlParser {
public:
  MtlParser(const std::string& file, WarningList& warnings) : file_(file), warnings_(warnings) {}

  void line(std::string_view text, int number) {
    std::string_view rest = text;
    key_ = next_word(rest);
    if (key_.empty() || key_.front() == '#') return;
    where_ = {file_, number, static_cast<int>(key_.data() - text.data()) + 1};
    if (key_ == "newmtl") return begin(trimmed(rest));
    constexpr std::string_view kKnown[] = {"Kd", "Ks", "Ke", "Tf",    "Kt",    "Ns",
                                           "Ni", "d",  "Tr", "illum", "map_Kd"};
    if (std::ranges::find(kKnown, key_) == std::end(kKnown)) {
      // A path tracer has no ambient term, so Ka misses nothing.
      if (key_ != "Ka" && key_ != "map_Ka")
        warnings_.add(where_, fmt::format("'{}' is ignored", shown(key_)));
    } else if (materials.empty()) {
      ignore("it stands before the first newmtl");
    } else if (key_ == "map_Kd") {
      map(rest);
    } else if (key_.front() == 'K' || key_ == "Tf") {
      color(rest);
    } else {
      number_statement(rest);
    }
  }

  std::vector<MtlStatements> materials;

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
  }

  void number_statement(std::string_view rest) {
    if (key_ == "d") {
      std::string_view after = rest;
      if (next_word(after) == "-halo") rest = after;
    }
    float value = 0;
    if (!real(next_word(rest), value)) return;
    MtlStatements& m = materials.back();
    if (key_ == "illum") {
      if (!(value >= 0 && value <= 10 && value == std::floor(value)))
        return ignore(fmt::format("there is no illumination model {}", value));
      m.illum = static_cast<int>(value);
    } else if (key_ == "d") {
      m.d = value, d_said_ = materials.size();
    } else if (key_ == "Tr") {
      if (d_said_ != materials.size()) m.d = 1 - value; // where both stand, d counts
    } else {
      (key_ == "Ns" ? m.ns : m.ni) = value;
    }
  }

  void map(std::string_view rest) {
    const MapStatement statement = read_map_statement(rest);
    for (std::string_view option : statement.ignored)
      warnings_.add(where_, fmt::format("map_Kd: the option {} is ignored", option));
    if (statement.file.empty()) return ignore("it names no file");
    materials.back().map_kd = {std::string(statement.file), statement.scale, statement.offset, where_};
  }

  const std::string& file_;
  WarningList& warnings_;
  Location where_; ///< of the statement at hand
  std::string_view key_;
  std::size_t d_said_ = 0; ///< the number of the material that said d
};

} // namespace

std::vector<MtlStatements> parse_mtl(TextLines& lines, const std::string& file, WarningList& warnings) {
  MtlParser parser(file, warnings);
  while (lines.next()) parser.line(lines.line(), lines.number());
  return std::move(parser.materials);
}

} // namespace candela
