#include "io/mtl_reader.h"

#include "io/obj_line.h"
#include "io/text_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <sstream>

namespace candela {

namespace {

constexpr std::size_t kMaxMtlBytes = std::size_t{64} << 20;

/// What a material says, as tinyobj fills unsaid values with defaults that hide whether they were said.
struct Said {
  Location where; ///< of the newmtl
  bool kd = false, ni = false, tf = false, texture = false;
  Location texture_where;
};

/// tinyobj takes what is no number for 0 without a word, reads past the meaning of short lines, and has no
/// idea of places. So each line is checked here first, and tinyobj gets only those that are known and good.
class MtlCheck {
public:
  MtlCheck(const std::string& file, WarningList& warnings) : file_(file), warnings_(warnings) {}

  void line(std::string_view text, int number) {
    std::string_view rest = text;
    std::string_view key = next_word(rest);
    where_ = {file_, number, static_cast<int>(key.data() - text.data()) + 1};
    line_ = text;
    if (key.empty() || key.front() == '#') return;
    if (key == "newmtl") {
      std::string_view name = trimmed(rest);
      if (name.empty()) throw input_error(where_, "newmtl", "it has no name", "write newmtl NAME");
      said.push_back({.where = where_, .texture_where = {}});
      clean += fmt::format("newmtl {}\n", name);
      return;
    }
    constexpr std::string_view kColors[] = {"Kd", "Ks", "Ke", "Tf", "Kt"};
    constexpr std::string_view kNumbers[] = {"Ns", "Ni", "d", "Tr", "illum"};
    bool color = std::ranges::find(kColors, key) != std::end(kColors);
    bool number_key = std::ranges::find(kNumbers, key) != std::end(kNumbers);
    if (!color && !number_key && key != "map_Kd") {
      // A path tracer has no ambient term, so Ka misses nothing.
      if (key != "Ka" && key != "map_Ka")
        warnings_.add(where_, fmt::format("'{}' is ignored", key.substr(0, 40)));
      return;
    }
    if (said.empty())
      throw input_error(where_, key, "it stands before the first material", "begin with newmtl NAME");
    if (color)
      read_color(key, rest);
    else if (number_key)
      read_number(key, rest);
    else
      read_texture(rest);
  }

  std::vector<Said> said; ///< one for each newmtl, in order
  std::string clean;      ///< for tinyobj

private:
  Location at(std::string_view word) const {
    return {where_.file, where_.line, static_cast<int>(word.data() - line_.data()) + 1};
  }

  std::string_view real(std::string_view key, std::string_view& rest) {
    std::string_view word = next_word(rest);
    if (word.empty()) word = line_.substr(line_.size());
    switch (check_real(word)) {
    case RealWord::good: return word;
    case RealWord::no_number:
      throw input_error(at(word), key, fmt::format("'{}' is no number", word.substr(0, 40)),
                        "give decimal numbers; colours as r g b");
    case RealWord::not_finite:
      throw input_error(at(word), key, fmt::format("'{}' is not a finite number", word.substr(0, 40)),
                        "give a finite number");
    }
    return word;
  }

  void read_color(std::string_view key, std::string_view rest) {
    std::string_view r = real(key, rest);
    std::string_view g = r, b = r; // "Kd 0.5" means a grey (MTL specification)
    if (!trimmed(rest).empty() && trimmed(rest).front() != '#') g = real(key, rest), b = real(key, rest);
    said.back().kd |= key == "Kd";
    said.back().tf |= key == "Tf" || key == "Kt";
    clean += fmt::format("{} {} {} {}\n", key, r, g, b);
  }

  void read_number(std::string_view key, std::string_view rest) {
    if (key == "d") {
      std::string_view after = rest;
      if (next_word(after) == "-halo") rest = after;
    }
    std::string_view value = real(key, rest);
    // tinyobj reads illum by atoi, whose overflow is undefined.
    if (key == "illum" &&
        (value.size() > 2 || value.find_first_not_of("0123456789") != std::string_view::npos))
      throw input_error(at(value), key, fmt::format("there is no model '{}'", value.substr(0, 40)),
                        "give a number from 0 to 10");
    said.back().ni |= key == "Ni";
    clean += fmt::format("{} {}\n", key, value);
  }

  void read_texture(std::string_view rest) {
    std::string_view words = trimmed(rest);
    if (words.empty()) throw input_error(where_, "map_Kd", "it names no file", "write map_Kd FILE");
    if (words.front() == '-') warnings_.add(where_, "options of map_Kd are ignored");
    said.back().texture = true;
    said.back().texture_where = where_;
    clean += fmt::format("map_Kd {}\n", words);
  }

  const std::string& file_;
  WarningList& warnings_;
  Location where_;
  std::string_view line_;
};

vec3 color_of(const tinyobj::real_t (&c)[3]) { return {c[0], c[1], c[2]}; }

/// Conversion of one material, with the corrections that it needs.
class Converter {
public:
  Converter(const Said& said, MtlDialect dialect, WarningList& warnings)
      : said_(said), dialect_(dialect), warnings_(warnings) {}

  Material convert(const tinyobj::material_t& m) {
    Material out;
    out.name = utf8_name(m.name);
    // tinyobj's default for a textured material without Kd is 0.6.
    out.diffuse = said_.kd ? clamped("diffuse", "Kd", color_of(m.diffuse))
                           : (said_.texture ? vec3(1) : Material{}.diffuse);
    vec3 specular = clamped("specular", "Ks", color_of(m.specular));
    out.emission = clamped("emission", "Ke", color_of(m.emission));
    out.two_sided_emission = !is_black(out.emission) && dialect_ == MtlDialect::standard;
    switch (m.illum) {
    case 3:
    case 5:
    case 8:
      out.type = MaterialType::mirror;
      out.specular = specular;
      break;
    case 4:
    case 6:
    case 7:
    case 9: convert_dielectric(m, out); return out;
    default:
      if (is_black(specular)) break;
      out.type = MaterialType::phong;
      out.specular = specular;
      out.exponent = clamped("exponent", "Ns", vec3(m.shininess)).x;
    }
    out.opacity = clamped("opacity", "d", vec3(m.dissolve)).x;
    if (conserve_energy(out.diffuse, out.specular))
      warnings_.add(said_.where, "Kd + Ks is above 1: the diffuse part is reduced to 1 - Ks");
    return out;
  }

private:
  void convert_dielectric(const tinyobj::material_t& m, Material& out) {
    out.type = MaterialType::dielectric;
    out.diffuse = Material{}.diffuse;
    if (said_.ni)
      out.ior = clamped("ior", "Ni", vec3(m.ior)).x;
    else
      warnings_.add(said_.where, fmt::format("glass without Ni: {} is taken", out.ior));
    if (!said_.tf) return;
    vec3 tf = color_of(m.transmittance);
    if (dialect_ == MtlDialect::cs123)
      out.absorption = clamped("absorption", "Tf", tf);
    else
      out.transmittance = glm::sqrt(clamped("transmittance", "Tf", tf));
  }

  /// The value within the range of the material's row.
  vec3 clamped(std::string_view row_key, std::string_view key, vec3 value) {
    if (!is_finite(value)) // tinyobj makes NaN of "0e999"
      throw input_error(said_.where, key, "the spelling of a number is too extreme",
                        "write it with fewer digits or a smaller exponent");
    auto row = std::ranges::find(material_fields(), row_key, &FieldInfo::key);
    vec3 inside = glm::clamp(value, static_cast<float>(row->minimum), static_cast<float>(row->maximum));
    if (inside != value)
      warnings_.add(said_.where,
                    fmt::format("{} is out of range: clamped to [{}, {}]", key, row->minimum, row->maximum));
    return inside;
  }

  const Said& said_;
  MtlDialect dialect_;
  WarningList& warnings_;
};

} // namespace

bool conserve_energy(vec3& diffuse, vec3 specular) {
  vec3 most = glm::max(vec3(1) - specular, vec3(0));
  // Sums like 0.3 + 0.7 may exceed 1 by a rounding: corrected, but not worth a warning.
  bool exceeds = glm::any(glm::greaterThan(diffuse, most + 1e-5f));
  diffuse = glm::min(diffuse, most);
  return exceeds;
}

void read_mtl(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings,
              MtlLibrary& library) {
  std::string text = read_text_file(file.canonical, "material library", kMaxMtlBytes);
  MtlCheck check(file.shown, warnings);
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    check.line(line, number);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }

  if (check.said.empty()) return;
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> index;
  std::string tinyobj_warnings, tinyobj_errors;
  std::istringstream clean(check.clean);
  tinyobj::LoadMtl(&index, &materials, &clean, &tinyobj_warnings, &tinyobj_errors);
  for (std::size_t i = 0; i < materials.size() && i < check.said.size(); ++i) {
    const Said& said = check.said[i];
    if (library.contains(materials[i].name)) {
      warnings.add(said.where, "a material of this name is there already: the first one counts");
      continue;
    }
    MtlMaterial out{Converter(said, dialect, warnings).convert(materials[i]), std::nullopt,
                    said.texture_where};
    const std::string& texture = materials[i].diffuse_texname;
    if (said.texture && material_uses(out.material.type, "diffuse")) {
      out.diffuse_texture = texture.empty()
                                ? std::nullopt
                                : policy.find(texture, folder_of(file.shown), said.texture_where, "map_Kd");
      if (!out.diffuse_texture)
        warnings.add(said.texture_where,
                     fmt::format("the texture '{}' is missing: no texture", texture.substr(0, 200)));
    }
    library.emplace(materials[i].name, std::move(out));
  }
}

} // namespace candela
