#include "app/console/denoised_picture.h"

#include "app/platform/streams.h"
#include "render/denoise/denoise_film.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

namespace candela {

std::optional<DenoisedPicture> denoised_picture(const Document& document, const OfflineResult& result,
                                                const PassOptions& pass) {
  if (!document.settings.display.denoise || document.settings.view != View::radiance) return std::nullopt;
  if (result.spp < 2) {
    say("candela: warning: denoising takes two samples a pixel: the picture is as rendered\n");
    return std::nullopt;
  }
  const auto start = std::chrono::steady_clock::now();
  FeatureFilm features(result.film.width(), result.film.height(), result.film.origin());
  auto image = denoise_render(noisy_image(result.film), result.spp, *result.scene, document, features,
                              {pass.threads, nullptr});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return DenoisedPicture{std::move(*image), seconds.count()};
}

} // namespace candela
