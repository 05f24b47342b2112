#pragma once
// Inputs of the lessons, from the tables of settings and materials, for the command and the panel.

#include "lab/source.h"
#include "materials/bsdf.h"
#include "scene/document.h"

#include <vector>

namespace candela {

/// Rows of the settings table that choose the sampler.
std::vector<const Field<Document>*> sampler_rows();
SampleSource sample_source(const SamplerSettings& settings);

/// The initial material of the lesson `brdf`, with visible values for every type.
MaterialChoice lab_material();
/// Rows of a material's surface scattering: its type and its parameters.
std::span<const Field<MaterialChoice>> scattering_rows();
/// Whether materials of the type have the row.
bool scattering_uses(int type, std::string_view key);
Bsdf lab_bsdf(const MaterialChoice& material);

} // namespace candela
