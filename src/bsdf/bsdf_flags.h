#pragma once
// Capabilities of a scattering model, known before a direction is sampled.

#include <cstdint>

namespace candela {

/// The sides to which a model scatters, and its kinds of lobes.
enum class BsdfFlags : std::uint8_t {
  none = 0,
  reflection = 1,   ///< to the side of wo
  transmission = 2, ///< to the other side
  diffuse = 4,      ///< Lambertian lobes
  glossy = 8,       ///< other lobes with a density
  delta = 16,       ///< single directions
  mixed = 32,       ///< several models, among which BsdfU::lobe chooses, of whatever lobes
};

constexpr BsdfFlags operator|(BsdfFlags a, BsdfFlags b) {
  return static_cast<BsdfFlags>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr BsdfFlags& operator|=(BsdfFlags& a, BsdfFlags b) { return a = a | b; }
/// Whether a has any of b.
constexpr bool has_any(BsdfFlags a, BsdfFlags b) {
  return (static_cast<unsigned>(a) & static_cast<unsigned>(b)) != 0;
}

/// Lambertian reflection or transmission, and nothing else.
constexpr bool is_diffuse(BsdfFlags f) { return !has_any(f, BsdfFlags::glossy | BsdfFlags::delta); }
/// Whether sampling looks at BsdfU::lobe.
constexpr bool chooses_lobe(BsdfFlags f) { return !is_diffuse(f) || has_any(f, BsdfFlags::mixed); }
/// Whether light from a lamp behind the surface may be scattered by a lobe that has a density.
constexpr bool transmits_with_density(BsdfFlags f) {
  return has_any(f, BsdfFlags::transmission) && has_any(f, BsdfFlags::diffuse | BsdfFlags::glossy);
}

/// The quantity that a path transports (Veach 1997, section 5.2): refraction scales radiance by 1 / eta^2,
/// but not importance.
enum class TransportMode : std::uint8_t {
  radiance,   ///< paths from the camera
  importance, ///< paths from lights
};

} // namespace candela
