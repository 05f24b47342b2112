#pragma once
// The CS123 scene file format (XML), as used by Brown's CSCI 1230 and 2240.

#include "io/builder/scene_builder.h"
#include "scene/document.h"

namespace candela {

/// Reads a CS123 scene. Where the format's description is ambiguous:
///
/// - globaldata's coefficients (kd, ks, kt; ambient light does not exist here) scale the materials that the
///   XML itself gives, not those of OBJ files, and are 1 where they are missing.
/// - Without cameradata: position (5, 5, 5) looking at the origin, 45 degrees. heightangle is the full
///   vertical angle.
/// - Transformations compose in the order listed, so that the last one is applied first. `<matrix>` has four
///   `<row a b c d/>`, or 16 numbers as text, row-major.
/// - A tree outside of a transblock with a name other than root is a master object; "master" objects and
///   named trees without content inside of a transblock are instances of it.
/// - A mesh's MTL wins where it has a material for a face; the object's own is for the rest. (In the
///   assignment's scenes the objects' attributes contradict the MTL and the pictures follow the MTL.)
/// - An object's own material is dielectric if `transparent` is not black, else mirror if `reflective` is
///   not, else phong if `specular` is not, else diffuse.
/// - MTL files are of MtlDialect::cs123.
/// - Lights are those of io/cs123/cs123_light.h.
/// - Primitives fill the cube of side 1 about the origin: a sphere has radius 0.5; cylinder and cone reach
///   from y = -0.5 to y = 0.5, with caps; a torus lies about the y axis, its tube of radius 0.125 about a
///   circle of radius 0.375.
///
/// Ignored elements are counted in `warnings`. Errors are located at the element or attribute. limit_error
/// above 64 levels, a million instances or four million transblocks (nested master objects grow
/// exponentially).
Document read_cs123(const FoundFile& file, const PathPolicy& policy, WarningList& warnings);

} // namespace candela
