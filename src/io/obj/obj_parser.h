#pragma once
// The statements of an OBJ file, one after the other.

#include "core/block_vector.h"
#include "core/math.h"
#include "io/files/warning_list.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

/// One corner of a polygon: indices from 0. They may refer to later vertices, or beyond the last.
struct ObjCorner {
  int v = kNone, vt = kNone, vn = kNone;
  static constexpr int kNone = -1;
  static constexpr int kMissing = -2; ///< given, but invalid
  bool operator==(const ObjCorner&) const = default;
};

struct ObjFace {
  std::uint32_t first; ///< in ObjContents::corners, whose size the file's limit bounds
  int count;
  std::uint32_t slot;
  int line;
};

struct ObjContents {
  BlockVector<glm::dvec3> positions; ///< NaN if invalid in the file
  BlockVector<vec3> colors;  ///< of the positions, linear; empty, or shorter: white where there is none
  BlockVector<vec3> normals; ///< zero there
  BlockVector<vec2> uvs;     ///< zero there
  BlockVector<ObjCorner> corners;
  BlockVector<ObjFace> faces;
  std::vector<std::string> slot_names;     ///< in UTF-8
  std::vector<std::string> slot_materials; ///< the same as spelled in the file
  std::optional<Error> first_loss;         ///< the error of the first lost vertex or face
};

/// Parses the statements. Invalid ones only affect their own vertex, attribute or face, and are counted in
/// the warnings. Names of materials and libraries may contain spaces.
class ObjParser {
public:
  explicit ObjParser(std::string file, WarningList& warnings) : file_(std::move(file)), warnings_(warnings) {}

  std::function<void(std::string_view names, const Location&)> on_mtllib;

  /// A line without its end. Throws limit_error for a polygon of too many corners.
  void line(std::string_view text, int number);
  ObjContents contents;

private:
  enum Kind { position, uv, normal };

  template <std::size_t N>
  bool reals(std::string_view key, std::string_view words, std::size_t at_least, double (&out)[N]);
  void vertex(std::string_view words);
  void color(std::string_view words);
  void face(std::string_view key, std::string_view words);
  std::optional<Error> corner(std::string_view word, ObjCorner& out) const;
  std::optional<Error> index(Kind kind, std::string_view digits, std::string_view word, int& out) const;
  std::uint32_t current_slot();
  Location at(std::string_view word) const;
  void lose(const Location& where, std::string_view warning, const Error& cause);

  std::string file_;
  WarningList& warnings_;
  std::string_view line_;
  int number_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> slots_;
  std::string material_; ///< name of the current material, as in the file
  std::optional<std::uint32_t> slot_;
};

/// "index 7 is out of range: there are 3 v lines".
Error bad_obj_index(const Location& where, std::string_view kind, int index, std::size_t count, bool so_far);

} // namespace candela
