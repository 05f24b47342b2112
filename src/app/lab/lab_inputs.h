#pragma once
// What the lessons are given, from the settings' and the materials' own tables: shared by the command and the
// panel.

#include "lab/source.h"
#include "materials/bsdf.h"
#include "scene/document.h"

#include <vector>

namespace candela {

/// Rows of the settings table that choose the sampler.
std::vector<const Field<Document>*> sampler_rows();
SampleSource sample_source(const SamplerSettings& settings);

/// The material that the lesson `brdf` begins with, which shows something of every type.
MaterialChoice lab_material();
/// Rows that say how a material scatters at its surface: its type and its parameters.
std::span<const Field<MaterialChoice>> scattering_rows();
/// Whether a material of the type looks at the row.
bool scattering_uses(int type, std::string_view key);
Bsdf lab_bsdf(const MaterialChoice& material);

} // namespace candela
