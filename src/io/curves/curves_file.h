#pragma once
// Strands of hair in a binary file, for more of them than JSON should hold. All numbers are little-endian:
//
//   bytes   what
//   8       "CNDLCRVS"
//   4       version, 1
//   4       basis: 0 uniform cubic B-splines, 1 cubic Bezier curves
//   4       S, strands
//   4       P, control points of all strands
//   4       W, widths: 2 or P
//   4 S     control points of each strand: 4 or more of a B-spline, 4, 7, 10 … of Bezier curves; their sum is
//   P 12 P    x y z of the control points, strand by strand from root to tip, as floats 4 W     diameters as
//   floats: at the root and at the tip of every strand, or at each control point
//
// and nothing follows.

#include "io/files/warning_list.h"
#include "scene/curves.h"

#include <memory>
#include <string>

namespace candela {

/// Reads such a file. Throws input_error where it is not what the format says ("hair.curves: widths: cause:
/// remedy"), before anything is allocated for it, limit_error above 2 GB, and Cancelled.
std::shared_ptr<const Strands> read_curves_file(const std::string& path, WarningList& warnings);

/// Writes valid strands, atomically. output_error if it cannot be written.
void write_curves_file(const Strands& strands, const std::string& path);

} // namespace candela
