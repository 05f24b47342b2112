#pragma once
// Materials of Wavefront MTL files.

#include "io/path_policy.h"
#include "io/warning_list.h"
#include "scene/scene_desc.h"

#include <map>
#include <string>

namespace candela {

/// How an MTL file is meant where its specification leaves room or is not followed.
enum class MtlDialect {
  standard, ///< Tf of a dielectric is what a body lets through, so each of the two crossings of its surface
            ///< takes the square root; Ke shines from both sides, as MTL knows none
  cs123,    ///< as the pictures of the CS123 path tracing assignment have it: Tf is Beer-Lambert's sigma_a in
            ///< 1/unit (its clear glass ball says "Tf 0.1 0.1 0.1"), and Ke shines from the front alone (its
            ///< lamp below the ceiling does not light the ceiling)
};

/// A material whose texture is not loaded yet.
struct MtlMaterial {
  Material material;
  std::optional<FoundFile> diffuse_texture;
  Location texture_where; ///< where the MTL names it
};

using MtlLibrary = std::map<std::string, MtlMaterial, std::less<>>;

/// Adds the materials of an MTL file to `library`; a name that it has already keeps its first meaning.
///
/// illum 3, 5, 8: mirror(Ks, Kd); 4, 6, 7, 9: dielectric(Ni, Tf), whose Kd, Ks and d mean nothing; any other
/// or none: phong(Kd, Ks, Ns) if Ks is not black, else diffuse(Kd). d (or 1 - Tr) is the opacity. Where Kd +
/// Ks exceeds 1, Kd is reduced to 1 - Ks: a surface cannot reflect more than it gets. Ke is emission. map_Kd
/// multiplies Kd, and Kd is 1 where it is missing. Values out of range are clamped. All such corrections and
/// all statements that are ignored are counted warnings; what is no number is an input_error with its place.
void read_mtl(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings,
              MtlLibrary& library);

/// Reduces `diffuse` where diffuse + specular exceeds 1; whether it did (by more than rounding).
bool conserve_energy(vec3& diffuse, vec3 specular);

} // namespace candela
