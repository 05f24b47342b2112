#include "io/obj/mtl_reader.h"

#include "io/files/text_file.h"
#include "io/obj/mtl_parser.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::size_t kMaxMtlBytes = std::size_t{64} << 20;
/// Of the time that a file takes, that of its lines.
constexpr double kLinesShare = 0.5;

/// Conversion of one material, with the corrections that it needs.
class Converter {
public:
  Converter(const MtlStatements& said, MtlDialect dialect, WarningList& warnings)
      : said_(said), dialect_(dialect), warnings_(warnings) {}

  Material convert() {
    Material out;
    out.name = utf8_name(said_.name);
    out.diffuse = diffuse();
    out.emission = clamped("emission", "Ke", said_.ke.value_or(vec3(0)));
    out.two_sided_emission = !is_black(out.emission) && dialect_ == MtlDialect::standard;
    const vec3 specular = clamped("specular", "Ks", said_.ks.value_or(vec3(0)));
    const int illum = said_.illum.value_or(2);
    switch (illum) {
    case 3:
    case 5:
    case 8:
      out.type = MaterialType::mirror;
      out.specular = specular;
      if (!said_.kd && !said_.map_kd) out.diffuse = default_material(out.type).diffuse;
      break;
    case 4:
    case 6:
    case 7:
    case 9: convert_dielectric(out); return out;
    default:
      if (is_black(specular) || (illum < 2 && dialect_ == MtlDialect::standard)) break;
      out.type = MaterialType::phong;
      out.specular = specular * highlight(out.diffuse);
      out.exponent = clamped("exponent", "Ns", vec3(said_.ns.value_or(1))).x;
    }
    out.opacity = clamped("opacity", "d", vec3(said_.d.value_or(1))).x;
    if (conserve_energy(out.diffuse, out.specular))
      warnings_.add(said_.where, out.specular == specular
                                     ? "Kd + Ks is above 1: the diffuse part is reduced to 1 - Ks"
                                     : "Kd leaves no room for the highlight: it is a little reduced");
    if (said_.tf && *said_.tf != vec3(1)) warnings_.add(said_.where, "Tf of an opaque material is ignored");
    return out;
  }

private:
  vec3 diffuse() {
    if (!said_.kd) return said_.map_kd ? vec3(1) : Material{}.diffuse;
    const vec3 kd = clamped("diffuse", "Kd", *said_.kd);
    if (!said_.map_kd || !is_black(kd)) return kd;
    warnings_.add(said_.where, "Kd is black beside map_Kd: it is taken for 1");
    return vec3(1);
  }

  /// What Ks is to be multiplied with.
  float highlight(vec3 kd) const {
    return dialect_ == MtlDialect::cs123 || is_black(kd) ? 1.0f : kPlasticSpecular;
  }

  void convert_dielectric(Material& out) {
    out.type = MaterialType::dielectric;
    out.diffuse = Material{}.diffuse;
    if (said_.ni)
      out.ior = clamped("ior", "Ni", vec3(*said_.ni)).x;
    else
      warnings_.add(said_.where, fmt::format("glass without Ni: {} is taken", out.ior));
    if (!said_.tf || *said_.tf == vec3(1)) return; // what exporters write for clear
    const vec3 tf = *said_.tf;
    if (dialect_ == MtlDialect::cs123)
      out.absorption = clamped("absorption", "Tf", tf);
    else
      out.transmittance = glm::sqrt(clamped("transmittance", "Tf", tf));
    warnings_.add(said_.where,
                  fmt::format("material '{}': Tf {} {} {} is read as {}", out.name.substr(0, 60), tf.x, tf.y,
                              tf.z,
                              dialect_ == MtlDialect::cs123
                                  ? "absorption per unit of length"
                                  : "transmittance of the whole body, the root of it at each surface"));
  }

  /// The value within the range of the material's row.
  vec3 clamped(std::string_view row_key, std::string_view key, vec3 value) {
    auto row = std::ranges::find(material_fields(), row_key, &FieldInfo::key);
    vec3 inside = glm::clamp(value, static_cast<float>(row->minimum), static_cast<float>(row->maximum));
    if (inside != value)
      warnings_.add(said_.where,
                    fmt::format("{} is out of range: clamped to [{}, {}]", key, row->minimum, row->maximum));
    return inside;
  }

  const MtlStatements& said_;
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
  std::string text;
  try {
    text = read_text_file(file.canonical, "material library", kMaxMtlBytes, &warnings);
  } catch (const Error& problem) {
    if (problem.code() != ExitCode::bad_input) throw;
    return warnings.add({file.shown}, fmt::format("the material library is left out: {}", problem.what()));
  }
  ProgressPart progress = warnings.part(file.canonical, text.size());
  TextLines lines(text, progress, kLinesShare);
  const std::vector<MtlStatements> materials = parse_mtl(lines, file.shown, warnings);
  const std::string folder = folder_of(file.shown);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    progress.reach(kLinesShare +
                   (1 - kLinesShare) * static_cast<double>(i) / static_cast<double>(materials.size()));
    const MtlStatements& said = materials[i];
    if (library.contains(said.name)) {
      warnings.add(said.where, "a material of this name is there already: the first one counts");
      continue;
    }
    MtlMaterial out{Converter(said, dialect, warnings).convert(), std::nullopt, said.where};
    if (said.map_kd && material_uses(out.material.type, "diffuse")) {
      const auto& map = *said.map_kd;
      out.texture_where = map.where;
      out.material.diffuse_uv = {map.scale, map.offset};
      out.diffuse_texture = policy.find_exported(map.file, folder, map.where, "map_Kd", warnings);
      if (!out.diffuse_texture)
        warnings.add(map.where, fmt::format("the texture '{}' is missing: no texture",
                                            utf8_name(map.file.substr(0, 200))));
    }
    library.emplace(said.name, std::move(out));
  }
}

} // namespace candela
