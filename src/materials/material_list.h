#pragma once
// The list of materials. A new one is a file of this folder, with its closure if that is no closure of bsdf/,
// and its name here; files, panels, settings, the lab and the tables of the documents follow from its rows.

#include "materials/dielectric_material.h"
#include "materials/diffuse_material.h"
#include "materials/ggx_material.h"
#include "materials/mirror_material.h"
#include "materials/phong_material.h"

namespace candela {

using MaterialModel =
    std::variant<DiffuseMaterial, PhongMaterial, GgxMaterial, MirrorMaterial, DielectricMaterial>;

} // namespace candela
