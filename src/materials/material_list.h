#pragma once
// The list of materials. A new one is a file of this folder, with its closure if that is no closure of bsdf/,
// and its name here; files, panels, settings, the lab and the tables of the documents follow from its rows.

#include "materials/blend_material.h"
#include "materials/blinn_material.h"
#include "materials/conductor_material.h"
#include "materials/cook_torrance_material.h"
#include "materials/dielectric_material.h"
#include "materials/diffuse_material.h"
#include "materials/ggx_material.h"
#include "materials/hair_material.h"
#include "materials/mirror_material.h"
#include "materials/null_material.h"
#include "materials/open_pbr_material.h"
#include "materials/oren_nayar_material.h"
#include "materials/phong_material.h"
#include "materials/plastic_material.h"
#include "materials/principled_material.h"
#include "materials/rough_dielectric_material.h"
#include "materials/sheen_material.h"
#include "materials/subsurface_material.h"
#include "materials/thin_dielectric_material.h"
#include "materials/two_sided_material.h"
#include "materials/ward_material.h"

namespace candela {

/// Those that are complete by themselves, so that one may stand for all surfaces (override.brdf).
using ScatteringModel =
    std::variant<DiffuseMaterial, PhongMaterial, GgxMaterial, MirrorMaterial, DielectricMaterial,
                 ConductorMaterial, PlasticMaterial, PrincipledMaterial, OpenPbrMaterial,
                 CookTorranceMaterial, OrenNayarMaterial, WardMaterial, RoughDielectricMaterial,
                 BlinnMaterial, SheenMaterial, ThinDielectricMaterial, HairMaterial, SubsurfaceMaterial>;

namespace detail {

template <class... More, class... Models>
std::variant<Models..., More...> with_more(const std::variant<Models...>&);

} // namespace detail

using MaterialModel =
    decltype(detail::with_more<BlendMaterial, TwoSidedMaterial, NullMaterial>(ScatteringModel()));

} // namespace candela
