#include "lab/estimation.h"

#include <bit>

namespace candela {

std::uint64_t next_trace_count(std::uint64_t count) {
  std::uint64_t step = std::max<std::uint64_t>(1, std::bit_floor(count) / 4);
  return std::min(count + step, std::bit_ceil(count + 1));
}

} // namespace candela
