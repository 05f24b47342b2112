#include "support/seed.h"

#include <cstdlib>
#include <random>

namespace candela::test {

std::uint64_t fresh_seed() {
  static const std::uint64_t seed = [] {
    if (const char* text = std::getenv("CANDELA_TEST_SEED"))
      return static_cast<std::uint64_t>(std::strtoull(text, nullptr, 0));
    std::random_device device;
    return (static_cast<std::uint64_t>(device()) << 32) | device();
  }();
  return seed;
}

std::string seed_note() { return "replay with CANDELA_TEST_SEED=" + std::to_string(fresh_seed()); }

} // namespace candela::test
