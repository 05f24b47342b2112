#pragma once
// From a film to its denoised image.

#include "render/denoise/denoiser.h"
#include "render/denoise/feature_film.h"
#include "render/film/film.h"

#include <string_view>

namespace candela {

/// The film's means in halves. A pixel of one sample has that in both, and a variance to match.
NoisyImage noisy_image(const Film& film);

/// Denoises an image of the document that has `spp` samples a pixel, at least two. `features` are gathered as
/// far as they improve the result; those of earlier calls for the same accumulation are kept. Nothing where
/// it was stopped.
std::optional<Image> denoise_render(NoisyImage color, int spp, const RenderScene& scene,
                                    const Document& document, FeatureFilm& features,
                                    const DenoiseOptions& options = {});

/// The method of denoise_render, for display beside its pictures: "OIDN 2.3.1" (oidn_denoiser.h)
/// where the program is built with that, else "NFOR", after the paper of denoise().
std::string_view denoiser_name();

} // namespace candela
