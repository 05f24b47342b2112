#pragma once
// Materials of Wavefront MTL files.

#include "io/files/path_policy.h"
#include "io/files/warning_list.h"
#include "scene/scene_desc.h"

#include <map>
#include <string>

namespace candela {

/// The interpretation of an MTL file where the specification is ambiguous or commonly violated.
///
/// - standard: as written by exporters. Ks together with a Kd is the highlight of a plastic (see read_mtl).
///   Tf of a dielectric is the transmittance of a body, so each of the two crossings of its surface takes
///   the square root. Ke emits from both sides, since MTL has no sides.
/// - cs123: as in the pictures of the CS123 path tracing assignment. Ks is the reflectance of the Phong lobe.
///   Tf is Beer-Lambert's sigma_a in 1/unit (the clear glass ball there has "Tf 0.1 0.1 0.1"), but all ones
///   are clear glass, too. Ke emits from the front only (the lamp there does not light the ceiling).
enum class MtlDialect { standard, cs123 };

/// A texture that has not been loaded yet.
struct MtlTexture {
  std::string key; ///< key of the material's parameter
  FoundFile file;
  TextureUse use;
  Location where; ///< where the MTL names it
};

struct MtlMaterial {
  Material material;
  std::vector<MtlTexture> textures;
  Location where;
};

using MtlLibrary = std::map<std::string, MtlMaterial, std::less<>>;

/// Reflectance of the highlight for Ks = 1 together with a Kd. Blender writes the "specular" of its
/// Principled BSDF as Ks, 0.5 by default, of which 0.08 is the reflectance at normal incidence: 4 %, that of
/// plastic and glass. Other exporters' Ks is the intensity of a highlight rather than a reflectance.
inline constexpr float kPlasticSpecular = 0.08f;

/// Adds the materials of an MTL file to `library`; for repeated names the first definition is kept.
///
/// illum 3, 5, 8: mirror(Ks, Kd); 4, 6, 7, 9: dielectric(Ni, Tf), whose Kd, Ks and d mean nothing; 0 and 1
/// without a highlight: diffuse(Kd); any other or none: diffuse(Kd) where Ks is black, else a Phong lobe of
/// the exponent Ns, whose reflectance is kPlasticSpecular * Ks where Kd (or map_Kd) has a colour, and Ks
/// where it has none (a metal). For cs123 all but mirror and dielectric are phong(Kd, Ks, Ns) where Ks is not
/// black. d (or 1 - Tr) is the opacity. Where diffuse and specular part exceed 1 together, the diffuse one is
/// reduced to conserve energy. Ke is emission. map_Kd, map_Ks, map_Ke, map_d and map_Ns multiply Kd, Ks, Ke,
/// d and Ns, each of which is 1 if it is missing or black although there is a map. Values out of range are
/// clamped. Corrections, the interpretation of a coloured Tf, missing textures and ignored statements are
/// counted warnings. Throws for a file that cannot be read, and for textures outside the root.
void read_mtl(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings,
              MtlLibrary& library);

/// Reduces `diffuse` where diffuse + specular exceeds 1; returns whether it did by more than rounding.
bool conserve_energy(vec3& diffuse, vec3 specular);

} // namespace candela
