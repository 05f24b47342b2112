#include "render/denoise/denoise_regression.h"

#include <cstring>

namespace candela::denoising {

namespace {

/// Tolerated dissimilarity of patches that are fitted together: smaller values keep more noise, larger ones
/// blur more. The papers' sharper choice.
constexpr float kColorK = 0.5f;
/// A little of the identity is added to the normal equations: relative to a term's own sum of squares, and
/// absolute, as a variance that features have by rounding. A term that the others explain but for
/// kDependent of its sum of squares is left out: nothing can be said of it.
constexpr float kRidge = 1e-3f, kRidgeVariance = 1e-8f, kDependent = 1e-4f;

constexpr int at(int a, int b) { return a * (a + 1) / 2 + b; }

} // namespace

void TileRegression::load(const Planes& from, int channel, ivec2 origin, Local& to) {
  for (int y = 0; y < kHeight; ++y) {
    const float* row = from.row(channel, std::clamp(origin.y + y - kWindow, 0, from.height - 1));
    for (int x = 0; x < kWidth; ++x) to[y][x] = row[std::clamp(origin.x + x - kWindow, 0, from.width - 1)];
  }
}

void TileRegression::run(const Planes& guide, const Planes& guide_variance, const Planes& color,
                         const Planes& features, ivec2 origin, Planes& out) {
  const int width = features.width, height = features.height;
  distances_.load(guide, guide_variance, origin);
  for (int o = 0; o < kSide * kSide; ++o) {
    auto [dx, dy] = offset(o);
    distances_.weights(dx, dy, kColorK, weights_[o]);
    for (int y = 0; y < kTileHeight; ++y) { // no model of, and none from, what is not in the image
      const bool inside = origin.y + y < height && origin.y + y + dy >= 0 && origin.y + y + dy < height;
      const int first = inside ? std::max(0, -(origin.x + dx)) : kTileWidth;
      const int last = std::min(kTileWidth, width - origin.x - std::max(dx, 0));
      for (int x = 0; x < std::min(first, kTileWidth); ++x) weights_[o][y][x] = 0;
      for (int x = std::max(last, 0); x < kTileWidth; ++x) weights_[o][y][x] = 0;
    }
  }
  for (int c = 0; c < 3; ++c) load(color, c, origin, color_[c]);
  for (int f = 0; f < kFeatures; ++f) load(features, f, origin, features_[f]);
  std::memset(out_, 0, sizeof(out_));
  for (int y = 0; y < kTileHeight; ++y) {
    accumulate(y);
    solve();
    predict(y);
  }
  for (int c = 0; c < 4; ++c)
    for (int y = std::max(0, kWindow - origin.y); y < std::min(kHeight, height + kWindow - origin.y); ++y) {
      float* to = out.row(c, origin.y + y - kWindow);
      for (int x = std::max(0, kWindow - origin.x); x < std::min(kWidth, width + kWindow - origin.x); ++x)
        to[origin.x + x - kWindow] += out_[c][y][x];
    }
}

/// The normal equations: sums over the window of weight x term x term and of weight x term x colour.
void TileRegression::accumulate(int y) {
  std::memset(matrix_, 0, sizeof(matrix_));
  std::memset(solution_, 0, sizeof(solution_));
  Row term[kTerms], weighted;
  for (float& one : term[0]) one = 1;
  for (int o = 0; o < kSide * kSide; ++o) {
    auto [dx, dy] = offset(o);
    const float* weight = weights_[o][y];
    for (int f = 0; f < kFeatures; ++f) {
      const float* p = &features_[f][y + kWindow][kWindow];
      const float* q = &features_[f][y + kWindow + dy][kWindow + dx];
      for (int x = 0; x < kTileWidth; ++x) term[f + 1][x] = q[x] - p[x];
    }
    for (int a = 0; a < kTerms; ++a) {
      for (int x = 0; x < kTileWidth; ++x) weighted[x] = weight[x] * term[a][x];
      for (int b = 0; b <= a; ++b)
        for (int x = 0; x < kTileWidth; ++x) matrix_[at(a, b)][x] += weighted[x] * term[b][x];
      for (int c = 0; c < 3; ++c) {
        const float* q = &color_[c][y + kWindow + dy][kWindow + dx];
        for (int x = 0; x < kTileWidth; ++x) solution_[c][a][x] += weighted[x] * q[x];
      }
    }
  }
}

/// By a Cholesky decomposition that skips dependent terms, which get the coefficient 0.
void TileRegression::solve() {
  Row smallest[kTerms] = {};
  for (int a = 1; a < kTerms; ++a)
    for (int x = 0; x < kTileWidth; ++x) {
      float& diagonal = matrix_[at(a, a)][x];
      smallest[a][x] = kDependent * diagonal;
      diagonal += kRidge * diagonal + kRidgeVariance * matrix_[at(0, 0)][x];
    }
  for (int a = 0; a < kTerms; ++a) {
    float* diagonal = matrix_[at(a, a)];
    for (int b = 0; b < a; ++b) {
      float* entry = matrix_[at(a, b)];
      for (int k = 0; k < b; ++k)
        for (int x = 0; x < kTileWidth; ++x) entry[x] -= matrix_[at(a, k)][x] * matrix_[at(b, k)][x];
      for (int x = 0; x < kTileWidth; ++x) entry[x] *= matrix_[at(b, b)][x];
      for (int x = 0; x < kTileWidth; ++x) diagonal[x] -= entry[x] * entry[x];
    }
    for (int x = 0; x < kTileWidth; ++x) // the inverse, for that is how it is used
      diagonal[x] = diagonal[x] > smallest[a][x] ? 1 / std::sqrt(diagonal[x]) : 0;
  }
  for (auto& solution : solution_) {
    for (int a = 0; a < kTerms; ++a) {
      for (int k = 0; k < a; ++k)
        for (int x = 0; x < kTileWidth; ++x) solution[a][x] -= matrix_[at(a, k)][x] * solution[k][x];
      for (int x = 0; x < kTileWidth; ++x) solution[a][x] *= matrix_[at(a, a)][x];
    }
    for (int a = kTerms - 1; a >= 0; --a) {
      for (int k = a + 1; k < kTerms; ++k)
        for (int x = 0; x < kTileWidth; ++x) solution[a][x] -= matrix_[at(k, a)][x] * solution[k][x];
      for (int x = 0; x < kTileWidth; ++x) solution[a][x] *= matrix_[at(a, a)][x];
    }
  }
}

void TileRegression::predict(int y) {
  for (int o = 0; o < kSide * kSide; ++o) {
    auto [dx, dy] = offset(o);
    const float* weight = weights_[o][y];
    Row prediction[3];
    for (int c = 0; c < 3; ++c)
      for (int x = 0; x < kTileWidth; ++x) prediction[c][x] = solution_[c][0][x];
    for (int f = 0; f < kFeatures; ++f) {
      const float* p = &features_[f][y + kWindow][kWindow];
      const float* q = &features_[f][y + kWindow + dy][kWindow + dx];
      for (int c = 0; c < 3; ++c)
        for (int x = 0; x < kTileWidth; ++x) prediction[c][x] += (q[x] - p[x]) * solution_[c][f + 1][x];
    }
    for (int c = 0; c < 3; ++c) {
      float* to = &out_[c][y + kWindow + dy][kWindow + dx];
      for (int x = 0; x < kTileWidth; ++x) to[x] += weight[x] * prediction[c][x];
    }
    float* to = &out_[3][y + kWindow + dy][kWindow + dx];
    for (int x = 0; x < kTileWidth; ++x) to[x] += weight[x];
  }
}

} // namespace candela::denoising
