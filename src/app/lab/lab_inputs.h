#pragma once
// What the lessons are given, from the settings' and the materials' own tables: shared by the command and the
// panel.

#include "lab/source.h"
#include "scene/document.h"

#include <vector>

namespace candela {

/// Rows of the settings table that choose the sampler.
std::vector<const Field<Document>*> sampler_rows();
SampleSource sample_source(const SamplerSettings& settings);

/// The material that the lesson `brdf` begins with, which shows something of every type.
Material lab_material();
/// Rows that say how a material scatters at its surface.
std::vector<const Field<Material>*> scattering_rows();
bool scattering_uses(MaterialType type, std::string_view key);

} // namespace candela
