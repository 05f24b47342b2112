#include "io/files/text_lines.h"

#include <algorithm>
#include <cstring>

namespace candela {

namespace {

/// Bytes searched between two checks for cancellation.
constexpr std::size_t kPiece = std::size_t{16} << 20;

} // namespace

TextLines::TextLines(std::string& text, ProgressPart& progress, double share)
    : text_(text), progress_(progress), share_of_byte_(share / static_cast<double>(text.size() + 1)) {}

/// Position of the first `c` in [from, limit), or `limit`.
std::size_t TextLines::find(char c, std::size_t from, std::size_t limit) const {
  for (std::size_t begin = from; begin < limit; begin += kPiece) {
    progress_.check();
    const std::size_t length = std::min(kPiece, limit - begin);
    if (const void* found = std::memchr(text_.data() + begin, c, length))
      return static_cast<std::size_t>(static_cast<const char*>(found) - text_.data());
  }
  return limit;
}

std::size_t TextLines::end_of_line(std::size_t from) {
  // Two searches for one character each are much faster than one for either; the position of the next LF is
  // kept, since a file with CR line ends has none.
  if (!newline_known_ || newline_ < from) newline_ = find('\n', from, text_.size()), newline_known_ = true;
  return find('\r', from, newline_);
}

bool TextLines::next() {
  if (next_ >= text_.size()) return false;
  number_ += 1 + joined_;
  joined_ = 0;
  const std::size_t begin = next_;
  std::size_t end = begin, from = begin;
  for (;;) {
    reach(from);
    end = end_of_line(from);
    next_ = std::min(end + 1, text_.size());
    if (end < text_.size() && text_[end] == '\r' && next_ < text_.size() && text_[next_] == '\n') ++next_;
    std::size_t last = end;
    while (last > from && is_blank(text_[last - 1])) --last;
    const bool continued = last > from && text_[last - 1] == '\\' && next_ < text_.size();
    if (!continued) break;
    std::fill(text_.begin() + static_cast<std::ptrdiff_t>(last - 1),
              text_.begin() + static_cast<std::ptrdiff_t>(next_), ' ');
    ++joined_;
    from = next_;
  }
  line_ = std::string_view(text_).substr(begin, end - begin);
  return true;
}

} // namespace candela
