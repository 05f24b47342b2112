#pragma once
// Published lenses. Radii, thicknesses and indices (at the d line, 587.6 nm) are facts of the sources that
// each names. Clear diameters are those of W. J. Smith and Genesee Optics Software, "Modern Lens Design: A
// Resource Manual", McGraw-Hill 1992, whose designs are scaled to a focal length of about 100 mm. Kolb,
// Mitchell and Hanrahan 1995 ("A Realistic Camera Model for Computer Graphics") rendered with them, and
// pbrt distributes them as its lens files.

#include "render/camera/lens_interface.h"

namespace candela {

/// The patent's indices and place of the stop; it is printed for a focal length of 1, with a back focus of
/// 0.71436.
inline constexpr LensInterface kDoubleGaussTable[] = {
    {58.950f, 7.520f, 1.67125f, 50.4f},  //
    {169.660f, 0.240f, 1, 50.4f},        //
    {38.550f, 8.050f, 1.67125f, 46.0f},  //
    {81.540f, 6.550f, 1.69842f, 46.0f},  //
    {25.500f, 10.932f, 1, 36.0f},        //
    {0, 9.482f, 1, 34.2f},               // stop
    {-28.990f, 2.360f, 1.60266f, 34.0f}, //
    {81.540f, 12.130f, 1.65953f, 40.0f}, //
    {-40.770f, 0.380f, 1, 40.0f},        //
    {874.130f, 6.440f, 1.71740f, 40.0f}, //
    {-79.460f, 0, 1, 40.0f},             //
};

inline constexpr LensInterface kWideAngleTable[] = {
    {163.579f, 5.529f, 1.540f, 107.8f},  //
    {53.169f, 45.435f, 1, 81.8f},        //
    {59.487f, 23.301f, 1.772f, 56.2f},   //
    {-102.877f, 8.042f, 1.617f, 44.6f},  //
    {322.991f, 3.720f, 1, 41.6f},        //
    {0, 10.353f, 1, 39.8f},              // stop
    {-43.572f, 11.057f, 1.617f, 37.2f},  //
    {-51.312f, 0.523f, 1, 41.6f},        //
    {-758.075f, 14.073f, 1.713f, 48.4f}, //
    {-34.505f, 6.031f, 1.805f, 52.0f},   //
    {-76.210f, 18.094f, 1, 55.8f},       //
    {-35.013f, 5.529f, 1.617f, 61.0f},   //
    {-54.424f, 0, 1, 81.8f},             //
};

inline constexpr LensInterface kTelephotoTable[] = {
    {21.851f, 5.008f, 1.529f, 19.0f},  //
    {-34.546f, 1.502f, 1.599f, 17.8f}, //
    {108.705f, 1.127f, 1, 16.6f},      //
    {0, 26.965f, 1, 16.2f},            // stop
    {-12.852f, 1.502f, 1.613f, 12.6f}, //
    {19.813f, 5.008f, 1.603f, 13.4f},  //
    {-20.378f, 0, 1, 14.8f},           //
};

inline constexpr LensInterface kFisheyeTable[] = {
    {302.249f, 8.335f, 1.620f, 303.4f},  //
    {113.931f, 74.136f, 1, 206.8f},      //
    {752.019f, 10.654f, 1.639f, 178.0f}, //
    {83.349f, 111.549f, 1, 134.2f},      //
    {95.882f, 20.054f, 1.654f, 90.2f},   //
    {438.677f, 53.895f, 1, 81.4f},       //
    {0, 14.163f, 1, 60.8f},              // stop
    {294.541f, 21.934f, 1.517f, 59.6f},  //
    {-52.265f, 9.714f, 1.805f, 58.4f},   //
    {-142.884f, 0.627f, 1, 59.6f},       //
    {-223.726f, 9.400f, 1.673f, 59.6f},  //
    {-150.404f, 0, 1, 65.2f},            //
};

/// The focal lengths that they get by default suit a film of 35 mm across its diagonal.
inline constexpr LensPrescription kLenses[] = {
    {"double_gauss", "Double Gauss 50 mm f/2",
     "A. W. Tronnier, US patent 2,673,491 (1954); clear diameters: Smith 1992, p. 312", 100, 50,
     kDoubleGaussTable},
    {"wide_angle", "Wide angle 22 mm f/2.7, 38 degrees of half field", "Nakamura; Smith 1992, p. 360", 100,
     22, kWideAngleTable},
    {"telephoto", "Telephoto 250 mm f/5.6, super-achromat", "Sigler; Smith 1992, p. 175", 100, 250,
     kTelephotoTable},
    {"fisheye", "Fisheye 16 mm f/4, 155.9 degrees of field", "Muller; Smith 1992, p. 164", 100, 16,
     kFisheyeTable},
};

/// The lens of that key, or null.
constexpr const LensPrescription* find_lens(std::string_view key) {
  for (const LensPrescription& lens : kLenses)
    if (lens.key == key) return &lens;
  return nullptr;
}

} // namespace candela
