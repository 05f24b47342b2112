#pragma once
// Intel's Open Image Denoise in the place of denoise(), where the program is built with it. Only then is its
// source compiled.

#include "render/denoise/denoiser.h"

#include <string_view>

namespace candela {

/// "OIDN 2.3.1".
std::string_view oidn_name();

/// As denoise(), from the means of the halves of colour, albedo and normal: Afra, "Intel Open Image Denoise"
/// (openimagedenoise.org), filter RT with HDR. Runs on the CPU, whose results differ less from machine to
/// machine than GPUs' do; the library promises the same bits for no two of its versions or kinds of CPU.
/// Throws Error with what the library complains of, std::bad_alloc where its memory does not suffice.
std::optional<Image> oidn_denoise(const DenoiseInput& input, const DenoiseOptions& options = {});

} // namespace candela
