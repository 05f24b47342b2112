#include "io/obj/mtl_reader.h"

#include "io/files/text_file.h"
#include "io/obj/mtl_parser.h"
#include "materials/material_choice.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr std::size_t kMaxMtlBytes = std::size_t{64} << 20;
/// Share of the reading time that parsing lines takes.
constexpr double kMtlLinesShare = 0.5;

/// A row of any material type.
FieldInfo material_row(std::string_view key) {
  for (const FieldInfo& row : common_material_fields())
    if (row.key == key) return row;
  return *std::ranges::find(material_choice_fields(), key, &FieldInfo::key);
}

/// Conversion of one material, with corrections.
class Converter {
public:
  Converter(const MtlStatements& said, MtlDialect dialect, WarningList& warnings)
      : said_(said), dialect_(dialect), warnings_(warnings) {}

  Material convert() {
    Material out;
    out.name = utf8_name(said_.name);
    out.emission = reflected_or_sent("emission", "Ke", said_.ke, said_.map_ke, vec3(0));
    out.two_sided_emission = !is_black(out.emission.value) && dialect_ == MtlDialect::standard;
    vec3 diffuse =
        reflected_or_sent("diffuse", "Kd", said_.kd, said_.map_kd, DiffuseMaterial().diffuse.value);
    const vec3 ks = reflected_or_sent("specular", "Ks", said_.ks, said_.map_ks, vec3(0));
    vec3 specular(0);
    const int illum = said_.illum.value_or(2);
    switch (illum) {
    case 3:
    case 5:
    case 8:
      specular = ks;
      if (!said_.kd && !said_.map_kd) diffuse = MirrorMaterial().diffuse.value;
      conserve(diffuse, specular, ks);
      out.model = MirrorMaterial{specular, diffuse};
      break;
    case 4:
    case 6:
    case 7:
    case 9: out.model = dielectric(out.name); return out;
    default:
      if (is_black(ks) || (illum < 2 && dialect_ == MtlDialect::standard)) {
        out.model = DiffuseMaterial{diffuse};
        break;
      }
      specular = ks * highlight(diffuse);
      conserve(diffuse, specular, ks);
      out.model = PhongMaterial{diffuse, specular, exponent()};
    }
    out.opacity = clamped("opacity", "d", vec3(said_.d.value_or(1))).x;
    if (said_.tf && *said_.tf != vec3(1)) warnings_.add(said_.where, "Tf of an opaque material is ignored");
    return out;
  }

private:
  /// The value of a statement, which a map may multiply.
  vec3 reflected_or_sent(std::string_view row, std::string_view key, const std::optional<vec3>& said,
                         const std::optional<MtlStatements::Map>& map, vec3 standard) {
    if (!said) return map ? vec3(1) : standard;
    const vec3 value = clamped(row, key, *said);
    if (!map || !is_black(value)) return value;
    warnings_.add(said_.where,
                  fmt::format("{0} is black although there is a map_{0}: it is taken for 1", key));
    return vec3(1);
  }

  float exponent() {
    const float value = clamped("exponent", "Ns", vec3(said_.ns.value_or(1))).x;
    if (!said_.map_ns || value > 0) return value;
    warnings_.add(said_.where, "Ns is 0 beside map_Ns: it is taken for 1");
    return 1;
  }

  /// With maps the sum varies over the surface, so the diffuse part is reduced at lookup.
  void conserve(vec3& diffuse, vec3 specular, vec3 ks) {
    if (said_.map_ks || !conserve_energy(diffuse, specular)) return;
    warnings_.add(said_.where, specular == ks
                                   ? "Kd + Ks is above 1: the diffuse part is reduced to 1 - Ks"
                                   : "Kd leaves no room for the highlight: it is a little reduced");
  }

  /// The factor of Ks.
  float highlight(vec3 kd) const {
    return dialect_ == MtlDialect::cs123 || is_black(kd) ? 1.0f : kPlasticSpecular;
  }

  DielectricMaterial dielectric(const std::string& name) {
    DielectricMaterial out;
    if (said_.ni)
      out.ior = clamped("ior", "Ni", vec3(*said_.ni)).x;
    else
      warnings_.add(said_.where, fmt::format("glass without Ni: {} is taken", out.ior.value));
    if (!said_.tf || *said_.tf == vec3(1)) return out; // exporters write this for clear glass
    const vec3 tf = *said_.tf;
    if (dialect_ == MtlDialect::cs123)
      out.absorption = clamped("absorption", "Tf", tf);
    else
      out.transmittance = glm::sqrt(clamped("transmittance", "Tf", tf));
    warnings_.add(said_.where,
                  fmt::format("material '{}': Tf {} {} {} is read as {}", name.substr(0, 60), tf.x, tf.y,
                              tf.z,
                              dialect_ == MtlDialect::cs123
                                  ? "absorption per unit of length"
                                  : "transmittance of the whole body, the root of it at each surface"));
    return out;
  }

  /// Clamps the value to the range of the material's row.
  vec3 clamped(std::string_view row_key, std::string_view key, vec3 value) {
    const FieldInfo row = material_row(row_key);
    vec3 inside = glm::clamp(value, static_cast<float>(row.minimum), static_cast<float>(row.maximum));
    if (inside != value)
      warnings_.add(said_.where,
                    fmt::format("{} is out of range: clamped to [{}, {}]", key, row.minimum, row.maximum));
    return inside;
  }

  const MtlStatements& said_;
  MtlDialect dialect_;
  WarningList& warnings_;
};

} // namespace

bool conserve_energy(vec3& diffuse, vec3 specular) {
  vec3 most = glm::max(vec3(1) - specular, vec3(0));
  // Sums like 0.3 + 0.7 may exceed 1 by rounding: corrected without a warning.
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
  TextLines lines(text, progress, kMtlLinesShare);
  const std::vector<MtlStatements> materials = parse_mtl(lines, file.shown, warnings);
  const std::string folder = folder_of(file.shown);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    progress.reach(kMtlLinesShare +
                   (1 - kMtlLinesShare) * static_cast<double>(i) / static_cast<double>(materials.size()));
    const MtlStatements& said = materials[i];
    if (library.contains(said.name)) {
      warnings.add(said.where, "a material of this name is there already: the first one counts");
      continue;
    }
    MtlMaterial out{Converter(said, dialect, warnings).convert(), {}, said.where};
    const bool is_glass = std::holds_alternative<DielectricMaterial>(out.material.model);
    auto map = [&](std::string_view key, std::string_view statement,
                   const std::optional<MtlStatements::Map>& named) {
      if (!named) return;
      const ParameterRef parameter = find_parameter(out.material, key);
      if (!parameter) return;
      auto found = policy.find_exported(named->file, folder, named->where, statement, warnings);
      if (!found) {
        warnings.add(named->where, fmt::format("the texture '{}' is missing: no texture",
                                               utf8_name(named->file.substr(0, 200))));
        return;
      }
      TextureUse use = parameter.standard_use();
      use.uv.scale = named->scale, use.uv.offset = named->offset;
      out.textures.push_back({std::string(key), std::move(*found), use, named->where});
    };
    map("diffuse", "map_Kd", said.map_kd);
    map("specular", "map_Ks", said.map_ks);
    map("emission", "map_Ke", said.map_ke);
    if (!is_glass) map("opacity", "map_d", said.map_d);
    if (said.map_ns && !find_parameter(out.material, "exponent"))
      warnings.add(said.map_ns->where, "'map_Ns' is ignored: the material has no highlight with an exponent");
    map("exponent", "map_Ns", said.map_ns);
    library.emplace(said.name, std::move(out));
  }
}

} // namespace candela
