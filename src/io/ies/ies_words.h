#pragma once
// The words of a photometric file: its head goes by lines, the rest by numbers.

#include "core/error.h"

#include <string>
#include <string_view>

namespace candela {

/// Walks through the text. Lines end in LF, CR LF or CR; words end at blanks, commas and lines.
class IesWords {
public:
  IesWords(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool at_end() const { return next_ >= text_.size(); }
  /// The next line, without blanks at both ends.
  std::string_view line();
  /// Where the last line or word begins.
  Location where() const { return {file_, line_, column_}; }
  /// Whether another word comes.
  bool more();
  /// The next word as a number that a float can hold; `element` is what it should be.
  double number(std::string_view element);
  /// The next word as an integer in [least, most]. Throws limit_error above.
  int count(std::string_view element, int least, int most);
  /// The next word as one of the numbers from 1 to `most`.
  int choice(std::string_view element, int most);
  /// Throws unless the rest of the text is long enough for so many numbers.
  void expect(std::size_t numbers, std::string_view element);

private:
  void skip_blanks();
  void mark() { line_ = next_line_, column_ = static_cast<int>(next_ - line_start_) + 1; }
  void step();
  std::string_view word(std::string_view element);

  std::string_view text_;
  std::string file_;
  std::size_t next_ = 0, line_start_ = 0;
  int next_line_ = 1;
  int line_ = 1, column_ = 1;
};

} // namespace candela
