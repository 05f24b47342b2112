#pragma once
// The features that guide the denoiser: per pixel, the first surface that is not specular, seen along the
// same camera rays as the image. It is gathered independently of the render, which has no cost for it.

#include "render/denoise/denoiser.h"
#include "render/world/render_scene.h"

namespace candela {

class FeatureFilm {
public:
  FeatureFilm() = default;
  /// Of a window of the frame that begins at `origin`, as the Film's.
  FeatureFilm(int width, int height, ivec2 origin = ivec2(0));

  /// Samples a pixel so far.
  std::uint32_t spp() const { return spp_; }

  /// Means over the even and the odd samples, as the denoiser takes them; needs two samples a pixel.
  void resolve(NoisyImage& albedo, NoisyImage& normal, NoisyImage& position) const;

private:
  friend bool render_features(const RenderScene&, const Document&, std::uint32_t, FeatureFilm&,
                              const std::atomic<bool>&, int);
  static constexpr std::size_t kChannels = 9; ///< albedo, normal, position
  struct Pixel {                              ///< floats will do: guides are taken of few samples
    float sum[2][kChannels] = {};
    float sum_of_squares[kChannels] = {};
  };

  int width_ = 0, height_ = 0;
  ivec2 origin_{0};
  std::uint32_t spp_ = 0;
  std::vector<Pixel> pixels_;
};

/// Adds samples until the film, which is of the document's frame, has `spp` a pixel: of the (pixel, sample)
/// camera rays that render_pass() traces, through mirrors and smooth glass the way that the image's paths go.
/// The same for any number of threads. Polls `stop` between pixels: false, and a film of no use, where it was
/// set.
bool render_features(const RenderScene& scene, const Document& document, std::uint32_t spp, FeatureFilm& film,
                     const std::atomic<bool>& stop, int threads = 0);

} // namespace candela
