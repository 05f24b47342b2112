#pragma once
// Materials of Wavefront MTL files.

#include "io/path_policy.h"
#include "io/warning_list.h"
#include "scene/scene_desc.h"

#include <map>
#include <string>

namespace candela {

/// What "Tf" of a dielectric means.
enum class TfMeaning {
  filter,     ///< as the MTL specification has it: what a body lets through; each of the two crossings of its
              ///< surface takes the square root
  absorption, ///< Beer-Lambert's sigma_a in 1/unit, as in the CS123 ray tracing assignment, whose clear glass
              ///< ball says "Tf 0.1 0.1 0.1"
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
/// Ks exceeds 1, Kd is reduced to 1 - Ks: a surface cannot reflect more than it gets. Ke is emission, from
/// both sides, as MTL knows none. map_Kd multiplies Kd, and Kd is 1 where it is missing. Values out of range
/// are clamped. All such corrections and all statements that are ignored are counted warnings; what is no
/// number is an input_error with its place.
void read_mtl(const FoundFile& file, const PathPolicy& policy, TfMeaning tf, WarningList& warnings,
              MtlLibrary& library);

/// Reduces `diffuse` where diffuse + specular exceeds 1; whether it did (by more than rounding).
bool conserve_energy(vec3& diffuse, vec3 specular);

} // namespace candela
