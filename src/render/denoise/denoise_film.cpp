#include "render/denoise/denoise_film.h"

#ifdef CANDELA_OIDN
#include "render/denoise/oidn_denoiser.h"
#endif

namespace candela {

namespace {

/// Most samples of features per pixel: more hardly improve the result, even with lens blur.
constexpr int kFeatureSamples = 32;

} // namespace

NoisyImage noisy_image(const Film& film) {
  NoisyImage image{{film.half_image(0), film.half_image(1)}, film.variance_image()};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      if (film.count(x, y) == 1) {
        const vec3 value = image.half[0].at(x, y);
        image.half[1].at(x, y) = value;
        image.variance.at(x, y) = value * value;
      }
  return image;
}

std::optional<Image> denoise_render(NoisyImage color, int spp, const RenderScene& scene,
                                    const Document& document, FeatureFilm& features,
                                    const DenoiseOptions& options) {
  static const std::atomic<bool> kNeverStop{false};
  const std::atomic<bool>& stop = options.stop ? *options.stop : kNeverStop;
  DenoiseInput input;
  input.color = std::move(color);
  const auto wanted = static_cast<std::uint32_t>(std::clamp(spp, 2, kFeatureSamples));
  if (!render_features(scene, document, wanted, features, stop, options.threads)) return std::nullopt;
  features.resolve(input.albedo, input.normal, input.position);
#ifdef CANDELA_OIDN
  return oidn_denoise(input, options);
#else
  return denoise(input, options);
#endif
}

std::string_view denoiser_name() {
#ifdef CANDELA_OIDN
  return oidn_name();
#else
  return "NFOR";
#endif
}

} // namespace candela
