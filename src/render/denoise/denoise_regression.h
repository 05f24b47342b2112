#pragma once
// The denoiser's regression: weighted least squares, a tile at a time.

#include "render/denoise/denoise_tile.h"

namespace candela::denoising {

/// Albedo, normal, position.
inline constexpr int kFeatures = 9;
/// Radius of the window that is searched for similar pixels: 19x19 pixels.
inline constexpr int kWindow = 9;

/// For each pixel i of a tile the model colour(j) = a_i + b_i . (feature(j) - feature(i)) that fits its
/// window's pixels j best, weighted by the similarity of the patches about i and j; and the prediction of
/// every such model for each of its pixels (Bitterli et al. 2016, section 3 and, "collaborative
/// filtering", 3.2: a pixel is estimated by all models, not only by the one that is centred on it).
class TileRegression {
public:
  /// Adds to `out`, four channels: weighted sums of the predictions of `color`, and the weights. The weights
  /// of the models come from `guide`, which should be independent of `color`. Reaches kWindow pixels beyond
  /// the tile at `origin`.
  void run(const Planes& guide, const Planes& guide_variance, const Planes& color, const Planes& features,
           ivec2 origin, Planes& out);

private:
  static constexpr int kSide = 2 * kWindow + 1;
  static constexpr int kHeight = kTileHeight + 2 * kWindow, kWidth = kTileWidth + 2 * kWindow;
  static constexpr int kTerms = kFeatures + 1; ///< the constant first
  using Local = float[kHeight][kWidth];
  using Row = float[kTileWidth];

  struct Offset {
    int dx, dy;
  };
  static Offset offset(int index) { return {index % kSide - kWindow, index / kSide - kWindow}; }

  static void load(const Planes& from, int channel, ivec2 origin, Local& to);
  void accumulate(int y);
  void solve();
  void predict(int y);

  PatchDistances<kWindow, DistanceUnit::both> distances_;
  float weights_[kSide * kSide][kTileHeight][kTileWidth];
  Local color_[3], features_[kFeatures];
  Local out_[4];
  // Of the row of pixels that is being fitted.
  Row matrix_[kTerms * (kTerms + 1) / 2]; ///< lower triangle, row by row: weighted products of the terms
  Row solution_[3][kTerms];               ///< first products of terms and colours, then coefficients
};

} // namespace candela::denoising
