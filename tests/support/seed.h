#pragma once
// Statistical tests use a fresh seed in each run, so that they do not depend on one seed; failures print it.

#include <cstdint>
#include <string>

namespace candela::test {

/// A new seed per run (the same within one process), or the one in the environment's CANDELA_TEST_SEED.
std::uint64_t fresh_seed();

/// "replay with CANDELA_TEST_SEED=…", for SCOPED_TRACE.
std::string seed_note();

} // namespace candela::test
