#pragma once
// What a film point sees the scene through: bounds on the plane of the last interface's vertex, so that few
// samples are spent on rays that the lens stops (pbrt, "Realistic Cameras", the exit pupil's bounds).

#include "render/camera/lens_surface.h"

#include <array>
#include <span>

namespace candela {

/// On the plane z = 0, for film points on the +x axis: its centre is on that axis, too. Semi-axes of 0: no
/// ray gets through.
struct PupilEllipse {
  float center = 0;
  vec2 semi_axes{0};
};

struct PupilQuery {
  float film_distance;
  float film_radius; ///< the farthest film point
  float pupil_z;     ///< of the paraxial exit pupil; may be infinite
};

/// Ellipses that hold the way of every ray that passes the surfaces (which are listed from the film to the
/// scene), for film points at radii of 0 to film_radius.
class ExitPupils {
public:
  ExitPupils() = default;
  ExitPupils(std::span<const LensSurface<float>> surfaces, const PupilQuery& query);

  PupilEllipse at(float radius) const {
    const float x = radius * per_radius_;
    if (!(x <= kIntervals * 1.0001f)) return {};
    const int i = std::min(static_cast<int>(x), kIntervals - 1);
    return intervals_[static_cast<std::size_t>(i)].at(x - static_cast<float>(i));
  }

private:
  static constexpr int kIntervals = 24;
  struct Interval { ///< linear between its ends
    PupilEllipse begin, end;
    PupilEllipse at(float f) const {
      return {begin.center + f * (end.center - begin.center),
              begin.semi_axes + f * (end.semi_axes - begin.semi_axes)};
    }
  };
  std::array<Interval, kIntervals> intervals_{};
  float per_radius_ = 0;
};

} // namespace candela
