#pragma once
// Complex indices of refraction of metals, measured.

#include "core/spectrum.h"

#include <array>
#include <string_view>

namespace candela {

struct Metal {
  std::string_view name; ///< chemical symbol
  Spectrum eta, k;       ///< n = eta + i k, linear Rec. 709
};

/// Spectra integrated against the CIE 1931 observer and taken to linear Rec. 709, as Mitsuba does. Ag, Al,
/// Au, Cr, Cu, W: Palik 1985-1998, "Handbook of Optical Constants of Solids", and others, by the spectra that
/// Mitsuba has of them. Fe, Ni, Ti: Johnson & Christy 1974, "Optical Constants of Transition Metals". Pt:
/// Rakić, Djurišić, Elazar & Majewski 1998, "Optical Properties of Metallic Films for Vertical-Cavity
/// Optoelectronic Devices", Brendel-Bormann fit.
inline constexpr std::array kMetals{
    Metal{"Ag", {0.155276f, 0.116728f, 0.138388f}, {4.82835f, 3.12222f, 2.1469f}},
    Metal{"Al", {1.6575f, 0.880405f, 0.521244f}, {9.22381f, 6.2695f, 4.837f}},
    Metal{"Au", {0.143036f, 0.375307f, 1.44205f}, {3.983f, 2.38556f, 1.60336f}},
    Metal{"Cr", {4.36967f, 2.91651f, 1.6549f}, {5.20655f, 4.23131f, 3.7547f}},
    Metal{"Cu", {0.201005f, 0.92375f, 1.10222f}, {3.91326f, 2.45305f, 2.14209f}},
    Metal{"Fe", {2.92126f, 2.91372f, 2.54207f}, {3.07306f, 2.93383f, 2.74647f}},
    Metal{"Ni", {2.02019f, 1.89897f, 1.72229f}, {4.16838f, 3.56038f, 2.88201f}},
    Metal{"Pt", {2.34217f, 2.06367f, 1.81993f}, {4.22862f, 3.67108f, 3.08006f}},
    Metal{"Ti", {2.73412f, 2.50439f, 2.23348f}, {3.82405f, 3.39339f, 3.00631f}},
    Metal{"W", {4.37082f, 3.30025f, 2.99841f}, {3.50064f, 2.60487f, 2.27323f}},
};

} // namespace candela
