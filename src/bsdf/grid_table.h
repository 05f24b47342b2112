#pragma once
// Functions that are dear to compute, on a grid.

#include "core/math.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace candela {

/// Values of a function over the unit cube [0, 1]^N at the points of a regular grid, its faces included;
/// multilinear between them.
template <std::size_t N>
class GridTable {
public:
  using Point = std::array<float, N>;

  /// f(Point) at size[0] x size[1] x ... points, at least 2 along each axis; on all processors at once.
  template <class F>
  GridTable(std::array<std::size_t, N> size, F f) : size_(size) {
    std::size_t count = 1;
    for (std::size_t n : size) count *= n;
    values_.resize(count);
    std::atomic<std::size_t> next = 0;
    auto work = [&] {
      for (std::size_t i; (i = next++) < count;) {
        Point at;
        for (std::size_t axis = 0, rest = i; axis < N; rest /= size[axis++])
          at[axis] = static_cast<float>(rest % size[axis]) / static_cast<float>(size[axis] - 1);
        values_[i] = f(at);
      }
    };
    std::vector<std::jthread> threads;
    for (unsigned n = 1; n < std::thread::hardware_concurrency(); ++n) threads.emplace_back(work);
    work();
  }

  /// Outside of the cube: of its nearest point.
  float operator()(Point at) const {
    std::array<std::size_t, N> step;
    Point share;
    std::size_t base = 0, stride = 1;
    for (std::size_t axis = 0; axis < N; ++axis) {
      const float x = std::clamp(at[axis], 0.0f, 1.0f) * static_cast<float>(size_[axis] - 1);
      const std::size_t cell = std::min(static_cast<std::size_t>(x), size_[axis] - 2);
      share[axis] = x - static_cast<float>(cell);
      base += cell * stride;
      step[axis] = stride;
      stride *= size_[axis];
    }
    float sum = 0;
    for (std::size_t corner = 0; corner < (std::size_t{1} << N); ++corner) {
      float weight = 1;
      std::size_t index = base;
      for (std::size_t axis = 0; axis < N; ++axis) {
        const bool upper = (corner >> axis & 1) != 0;
        weight *= upper ? share[axis] : 1 - share[axis];
        index += upper ? step[axis] : 0;
      }
      sum += weight * values_[index];
    }
    return sum;
  }

private:
  std::array<std::size_t, N> size_;
  std::vector<float> values_;
};

} // namespace candela
