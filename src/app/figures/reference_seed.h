#pragma once

namespace candela {

/// What changes a document's seed to that of its reference: otherwise the reference's error would be
/// correlated with that of the pictures that are compared with it.
inline constexpr int kReferenceSeed = 0x5eed;

} // namespace candela
