#pragma once
// Materials of Wavefront MTL files.

#include "io/files/path_policy.h"
#include "io/files/warning_list.h"
#include "scene/scene_desc.h"

#include <map>
#include <string>

namespace candela {

/// How an MTL file is meant where its specification leaves room or is not followed.
enum class MtlDialect {
  standard, ///< as exporters mean it: Ks beside a Kd is the highlight of a plastic (see read_mtl); Tf of a
            ///< dielectric is what a body lets through, so each of the two crossings of its surface takes the
            ///< square root; Ke shines from both sides, as MTL knows none
  cs123, ///< as the pictures of the CS123 path tracing assignment have it: Ks is the reflectance of the Phong
         ///< lobe; Tf is Beer-Lambert's sigma_a in 1/unit (its clear glass ball says "Tf 0.1 0.1 0.1"), but
         ///< all ones are clear glass, too; and Ke shines from the front alone (its lamp below the ceiling
         ///< does not light the ceiling)
};

/// A texture that is not loaded yet.
struct MtlTexture {
  std::string key; ///< of the material's parameter
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

/// Reflectance of the highlight that Ks = 1 means beside a Kd. Blender writes the "specular" of its
/// Principled BSDF as Ks, 0.5 by default, of which 0.08 is the reflectance at normal incidence: 4 %, that of
/// plastic and glass. The other exporters' Ks is the height of a highlight, which is no share of light at
/// all.
inline constexpr float kPlasticSpecular = 0.08f;

/// Adds the materials of an MTL file to `library`; a name that it has already keeps its first meaning.
///
/// illum 3, 5, 8: mirror(Ks, Kd); 4, 6, 7, 9: dielectric(Ni, Tf), whose Kd, Ks and d mean nothing; 0 and 1
/// without a highlight: diffuse(Kd); any other or none: diffuse(Kd) where Ks is black, else a Phong lobe of
/// the exponent Ns, whose reflectance is kPlasticSpecular * Ks where Kd (or map_Kd) has a colour, and Ks
/// where it has none (a metal). For cs123 all but mirror and dielectric are phong(Kd, Ks, Ns) where Ks is not
/// black. d (or 1 - Tr) is the opacity. Where diffuse and specular part exceed 1 together, the diffuse one is
/// reduced: a surface cannot reflect more than it gets. Ke is emission. map_Kd, map_Ks, map_Ke, map_d and
/// map_Ns multiply Kd, Ks, Ke, d and Ns, each of which is 1 where it is missing beside its map, or black.
/// Values out of range are clamped. All such corrections, how a coloured Tf was read, textures that are not
/// there and all statements that are ignored are counted warnings. Throws for a file that cannot be read, and
/// for textures outside the root.
void read_mtl(const FoundFile& file, const PathPolicy& policy, MtlDialect dialect, WarningList& warnings,
              MtlLibrary& library);

/// Reduces `diffuse` where diffuse + specular exceeds 1; whether it did (by more than rounding).
bool conserve_energy(vec3& diffuse, vec3 specular);

} // namespace candela
