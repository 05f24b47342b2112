#pragma once
// The lines of an OBJ or MTL file.

#include "core/progress.h"

#include <string>
#include <string_view>

namespace candela {

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Lines end in LF, CR LF or CR. A backslash at the end continues a line; both are replaced by blanks, so
/// that columns are those of the file.
class TextLines {
public:
  /// `text` must outlive this; continued lines are joined in place. Reading the lines is the part [0, share]
  /// of `progress`.
  TextLines(std::string& text, ProgressPart& progress, double share);

  /// Advances to the next line; false at the end. Throws Cancelled.
  bool next();
  std::string_view line() const { return line_; } ///< without its end
  int number() const { return number_; }          ///< from 1; for a continued line that of the first

private:
  std::size_t end_of_line(std::size_t from);
  void reach(std::size_t offset) { progress_.reach(share_of_byte_ * static_cast<double>(offset)); }
  std::size_t find(char c, std::size_t from, std::size_t limit) const;

  std::string& text_;
  ProgressPart& progress_;
  double share_of_byte_;
  std::string_view line_;
  std::size_t next_ = 0;    ///< start of the next line
  std::size_t newline_ = 0; ///< position of the next LF; the text's size if there is none
  bool newline_known_ = false;
  int number_ = 0;
  int joined_ = 0; ///< line ends within the current line
};

} // namespace candela
