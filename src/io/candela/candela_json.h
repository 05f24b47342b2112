#pragma once
// The Candela scene format, version 1: JSON, comments allowed.
//
//   {
//     "candela": 1,
//     "description": "free text, for people",
//     "camera": {"position": [0, 1, 4], "target": [0, 1, 0], "up": [0, 1, 0], "vertical_fov": 40,
//                "aperture_radius": 0, "focus_distance": 0},
//     "materials": [
//       {"name": "red", "type": "diffuse", "diffuse": [0.63, 0.065, 0.05]},
//       {"name": "wood", "diffuse": {"texture": "wood.png", "uv_scale": [2, 2]}},
//       {"name": "lamp", "diffuse": 0, "emission": [17, 12, 4]}
//     ],
//     "lights": [{"name": "sky", "type": "constant", "color": [0.5, 0.6, 1], "scale": 2}],
//     "meshes": {
//       "bunny": {"file": "meshes/bunny.obj"},
//       "kite": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]]}
//     },
//     "instances": [
//       {"name": "ball", "shape": "sphere", "radius": 0.5, "material": "red"},
//       {"shape": "mesh", "mesh": "bunny", "materials": {"fur": "red"}},
//       {"file": "meshes/tree.obj"},
//       {"shape": "rectangle", "material": "lamp",
//        "transform": [{"scale": 0.3}, {"rotate": [1, 0, 0, 90]}, {"translate": [0, 1.9, 0]}]}
//     ],
//     "settings": {"path": {"max_depth": 8}, "film": {"width": 640, "height": 480}}
//   }
//
// camera, settings: the rows of settings_table(), nested at the dots of their keys. materials, lights: the
// rows of material_fields() of the type and of light_fields(). Angles are degrees; a colour may be one
// number, a grey. All members except "candela" are optional and have defaults.
//
// An environment light has a panorama: "file", or "files" (six faces of a cube: +x, -x, +y, -y, +z, -z), or
// inline "image": {"name", "width", "height", "pixels": [3 width height numbers]}; without one it is
// constant. For its "mapping" see lights/environment_map.h. A projector and a point light have a picture in
// the same way, and a point or spot light a "profile": a photometric file, or its values inline
// (io/candela/json_profile.h). Lights and materials may name a "group", which is switched and scaled in
// "light_groups": [{"name", "on": true, "scale": 1}].
//
// Files are named relative to the scene's folder. A number or colour of a material may be a texture, which
// gives factor * texel + offset: {"texture": …, "factor": 1, "offset": 0, "channel", "filter", "wrap",
// "color_space", "mapping": "uv" or "triplanar", "blend", "uv_scale": [1, 1], "uv_rotation": 0,
// "uv_offset": [0, 0]}. The texture is a picture file,
// or the name or index of an entry of "textures": a list of {"file", "name"}, pictures inline ({"name",
// "width", "height", "channels": 1, 3 or 4, and "srgb": [bytes], "uint16": […] or "float": […]}), or other
// kinds by their "type" ({"type": "checker", "name", "even", "odd", "squares"}). A picture keeps the
// precision of its file; 8 and 16 bits are decoded according to color_space. Older files say
// "diffuse_texture" (a file or an index), "diffuse_uv_scale" and "diffuse_uv_offset" beside "diffuse", the
// factor.
//
// A mesh is a file, or inline: "positions", "triangles" (indices from 0), and perhaps "normals" (unit, or
// zero: flat), "uvs", "vertex_colors" (all per vertex), "face_colors" (per triangle; colours are linear),
// "material_slots" (per triangle, into "slots"), "slots" (names, one of "" if left out), "source" (the file
// it once came from, never opened). "name" is the mesh's name if it is not its key.
//
// A mesh deforms with "positions_end" (and "normals_end"), the vertices at time 1; that of a file with
// "file_end", another file of the same triangles. An instance moves by its "motion", the rows of
// motion_fields(); the camera by those of its rows that are called motion_... Its shutter_open and
// shutter_close are the times in [0, 1] that the picture sees.
//
// "shape" is one of shape_names() in scene/scene_desc.h, with the values of shape_fields(): sphere (with
// "radius", about the origin), rectangle ([-1, 1]^2 in the xy plane), disc (of radius 1 there), plane (all of
// it; these face +z), cube ([-1, 1]^3), cylinder and cone ("radius", "height", "caps"; along z from 0), torus
// ("radius", "minor_radius"; about z), curves ("form", "thickness"). It may be left out beside "mesh" and
// "file". "material" names a material (or is its index) for all slots of a mesh, "materials" one for each
// slot by the slot's name, or a list in the order of the slots. Slots of an OBJ file left without one get
// that of its MTL, imported as "mesh/slot"; all others a grey.
//
// Curves are strands from root to tip: a "file" (io/curves/curves_file.h), or inline "strands", a list of
// control points [[x, y, z], ...] for each, in the "basis" "bspline" (uniform, 4 points or more) or "bezier"
// (4, 7, 10 ... points), and their diameters: "width", a number or [root, tip], linear along the strand, or
// "widths", a list for each strand with one for each control point, in the same basis; "source" as of meshes.
//
// "transform" (world from object) is a matrix of 16 numbers, row-major, or a list of steps applied in the
// order in which they are listed: {"translate": [x, y, z]}, {"rotate": [axis x, y, z, degrees]}, {"scale": s
// or [x, y, z]}, {"matrix": [16 numbers]}, {"look_at": {"origin", "target", "up"}}, which turns +z to the
// target.

#include "io/builder/scene_builder.h"
#include "scene/document.h"

#include <string>

namespace candela {

/// Reads a scene; `policy` restricts the files that it may name. Every error has the line and column of the
/// offending token.
Document read_candela_json(const FoundFile& file, const PathPolicy& policy, WarningList& warnings);

/// The same from a text in the file `shown` (a picture), relative to whose folder files are named.
Document parse_candela_json(std::string text, const std::string& shown, const PathPolicy& policy,
                            WarningList& warnings);

/// The document in the format above, without default values. Numbers read back to the same bits. Mesh files
/// inside the tree of `folder` are written by reference, relative to it, other meshes inline (a scene may not
/// name files outside its tree). Pictures are written by reference, and inline only if they have no file.
/// Throws output_error for a document with a document_problem.
std::string candela_json(const Document& document, const std::string& folder);

/// Writes the same to a file, atomically. output_error if it cannot be written.
void write_candela_json(const Document& document, const std::string& path);

} // namespace candela
