#pragma once
// Samples that were NaN or infinite: counted and located, in no sum.

#include "core/math.h"

#include <cstdint>
#include <vector>

namespace candela {

/// A sample whose radiance was NaN or infinite; it can be traced again from these numbers alone.
struct NonFiniteSample {
  uvec2 pixel{0};
  std::uint32_t sample = 0;
  int depth = 0; ///< path segment that made it so

  bool operator==(const NonFiniteSample&) const = default;
};

struct NonFiniteLog {
  static constexpr std::size_t kMaxRecords = 64;
  std::uint64_t count = 0;
  std::vector<NonFiniteSample> records; ///< the first kMaxRecords by pixel order of each pass

  void add(const NonFiniteSample& sample) {
    ++count;
    keep(sample);
  }
  NonFiniteLog& operator+=(const NonFiniteLog& later) {
    count += later.count;
    for (const NonFiniteSample& s : later.records) keep(s);
    return *this;
  }

  bool full() const { return records.size() >= kMaxRecords; }
  bool operator==(const NonFiniteLog&) const = default;

private:
  void keep(const NonFiniteSample& sample) {
    if (!full()) records.push_back(sample);
  }
};

} // namespace candela
