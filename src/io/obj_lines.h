#pragma once
// The lines of an OBJ file, checked, on their way to tinyobjloader.

#include "io/path_policy.h"
#include "io/warning_list.h"

#include <functional>
#include <streambuf>
#include <string>
#include <vector>

namespace candela {

/// Feeds tinyobj one line at a time. tinyobj takes what is no number for 0, overflows on long indices, does
/// not check their range and knows no places; so v, vt, vn and f lines are checked here before it sees them,
/// usemtl and mtllib are handled here (tinyobj loads only the first file of a mtllib and splits names at
/// spaces), and no other line reaches it.
class ObjLines final : public std::streambuf {
public:
  /// `text` must outlive this; line ends and continued lines are made uniform in it. The lines are the part
  /// [0, share] of `progress`.
  ObjLines(std::string file, std::string& text, WarningList& warnings, ProgressPart& progress, double share);

  std::function<void(std::string_view names, const Location&)> on_mtllib;
  std::function<void(std::string_view name, const Location&)> on_usemtl;

  /// The line that tinyobj is working on.
  int line() const { return line_; }
  const std::string& file() const { return file_; }

  /// Throws for the first index that ran ahead and whose vertex never came.
  void check_forward_indices() const;

protected:
  int_type underflow() override;

private:
  enum Kind { position, uv, normal, kKinds };
  struct ForwardIndex {
    Kind kind;
    int index;
    Location where;
  };

  bool accept(std::string_view line);
  void check_reals(std::string_view key, std::string_view words, int at_least);
  void check_face(std::string_view key, std::string_view words);
  void check_corner(std::string_view word);
  void check_index(Kind kind, std::string_view digits, std::string_view word);
  Location at(std::string_view word) const;
  Error bad_index(const ForwardIndex& index, bool final) const;

  std::string file_;
  std::string& text_;
  WarningList& warnings_;
  ProgressPart& progress_;
  double share_of_byte_;
  std::string_view current_;           ///< the line being checked
  std::size_t next_ = 0;               ///< where the next line starts
  int line_ = 0;                       ///< its number, from 1
  std::vector<std::size_t> continued_; ///< where a line break was taken out of text_
  std::size_t next_continued_ = 0;
  int skipped_breaks_ = 0; ///< that the current line contained
  int count_[kKinds] = {0, 0, 0};
  std::vector<ForwardIndex> forward_;
};

} // namespace candela
