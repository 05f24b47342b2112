#pragma once
// Strands of hair, fur or grass as curves, in the space of their instance.

#include "core/bounds.h"
#include "core/math.h"

#include <memory>
#include <string>
#include <vector>

namespace candela {

/// What the control points of a strand mean.
enum class CurveBasis : int {
  bspline, ///< a uniform cubic B-spline: n >= 4 points make n - 3 segments, and it ends near the last but one
  bezier,  ///< cubic Bezier curves that share their ends: 3 n + 1 points make n segments
};
/// How a strand is rendered.
enum class CurveForm : int {
  round,  ///< a tube
  ribbon, ///< flat, and facing each ray that meets it
};

/// Bulk data of a scene: shared between copies of a Document, and immutable once in one.
struct Strands {
  std::string source; ///< the file it came from, for writing it back by reference; may be empty
  CurveBasis basis = CurveBasis::bspline;
  std::vector<vec3> points;          ///< of all strands, from root to tip
  std::vector<std::uint32_t> counts; ///< control points of each strand
  /// Diameters: those of the root and the tip of every strand, linear between them, or one for each control
  /// point, in the same basis.
  std::vector<float> widths{1, 1};
  bool operator==(const Strands&) const = default; ///< by value; compare pointers first where that is enough

  bool has_width_per_point() const { return widths.size() != 2; }
  std::size_t segment_count() const;
};

/// Segments of a strand of so many control points; 0 if no strand has so many.
std::size_t curve_segments(CurveBasis basis, std::size_t points);

/// "counts: …": what is wrong with them; empty if they are valid. All values are then finite, counts fit the
/// basis and the points, and no width is negative.
std::string strands_problem(const Strands& strands);

/// Of the control points, grown by the greatest radius; empty if there are none.
Bounds3 strand_bounds(const Strands& strands, float thickness);

/// One strand along z, from 0 to 1, that ends in a point.
std::shared_ptr<const Strands> single_strand();

/// Many strands as a shape.
struct CurvesShape {
  std::shared_ptr<const Strands> strands = single_strand(); ///< never null
  int form = static_cast<int>(CurveForm::round);
  float thickness = 1; ///< multiplies all widths
  bool operator==(const CurvesShape&) const = default;

  CurveForm curve_form() const { return static_cast<CurveForm>(form); }
};

} // namespace candela
