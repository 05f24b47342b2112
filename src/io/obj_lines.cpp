#include "io/obj_lines.h"

#include "io/obj_line.h"
#include "io/text_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string shortened(std::string_view word) { return std::string(word.substr(0, 40)); }

} // namespace

ObjLines::ObjLines(std::string file, std::string& text, WarningList& warnings, ProgressPart& progress,
                   double share)
    : file_(std::move(file)), text_(text), warnings_(warnings), progress_(progress),
      share_of_byte_(share / static_cast<double>(text.size() + 1)) {
  if (text_.empty() || text_.back() != '\n') text_ += '\n';
  // Two searches for one character each are many times quicker than one for either.
  if (text_.find('\r') == std::string::npos && text_.find('\\') == std::string::npos) return;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\r') text_[i] = i + 1 < text_.size() && text_[i + 1] == '\n' ? ' ' : '\n';
    if (text_[i] != '\\') continue;
    // A backslash at the end of a line continues it.
    std::size_t end = text_.find_first_not_of(" \t\r", i + 1);
    if (end == std::string::npos || text_[end] != '\n' || end + 1 == text_.size()) continue;
    for (std::size_t k = i; k <= end; ++k) text_[k] = ' ';
    continued_.push_back(end);
  }
}

ObjLines::int_type ObjLines::underflow() {
  while (next_ < text_.size()) {
    progress_.reach(share_of_byte_ * static_cast<double>(next_));
    std::size_t begin = next_, end = text_.find('\n', begin); // the text ends in one
    next_ = end + 1;
    line_ += 1 + skipped_breaks_;
    for (skipped_breaks_ = 0; next_continued_ < continued_.size() && continued_[next_continued_] < next_;
         ++next_continued_)
      ++skipped_breaks_;
    std::string_view line = std::string_view(text_).substr(begin, end - begin);
    // A comment may follow numbers; names may have a '#' in them.
    auto first = line.find_first_not_of(" \t");
    if (auto comment = line.find('#'); comment != line.npos && (line[first] == 'v' || line[first] == 'f')) {
      line = line.substr(0, comment);
      text_[begin + comment] = '\n';
    }
    if (!accept(line)) continue;
    setg(text_.data() + begin, text_.data() + begin, text_.data() + begin + line.size() + 1);
    return traits_type::to_int_type(text_[begin]);
  }
  return traits_type::eof();
}

/// Where a word of the current line is; a continued line counts from its first part.
Location ObjLines::at(std::string_view word) const {
  auto column = static_cast<int>(word.data() - current_.data()) + 1;
  return {file_, line_, column};
}

/// Whether tinyobj should see the line.
bool ObjLines::accept(std::string_view line) {
  current_ = line;
  std::string_view rest = line;
  std::string_view key = next_word(rest);
  if (key.empty() || key.front() == '#') return false;
  if (key == "v") return check_reals(key, rest, 3), ++count_[position], true;
  if (key == "vn") return check_reals(key, rest, 3), ++count_[normal], true;
  if (key == "vt") return check_reals(key, rest, 1), ++count_[uv], true;
  if (key == "f") return check_face(key, rest), true;
  if (key == "usemtl")
    on_usemtl(trimmed(rest), at(key));
  else if (key == "mtllib")
    on_mtllib(trimmed(rest), at(key));
  else if (key != "o" && key != "g" && key != "s")
    warnings_.add(at(key), fmt::format("'{}' is ignored", shortened(key)));
  return false;
}

void ObjLines::check_reals(std::string_view key, std::string_view words, int at_least) {
  int count = 0;
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    RealWord state = check_real(word);
    if (state == RealWord::no_number)
      throw input_error(at(word), key, fmt::format("'{}' is no number", shortened(word)),
                        "give decimal numbers");
    if (state == RealWord::not_finite)
      throw input_error(at(word), key, fmt::format("'{}' is not a finite number", shortened(word)),
                        "give a finite number");
    ++count;
  }
  if (count < at_least)
    throw input_error({file_, line_, static_cast<int>(current_.find_last_not_of(" \t")) + 2}, key,
                      fmt::format("{} of {} numbers", count, at_least), "give all of them");
  if (key == "v" && count >= 6) warnings_.add({file_, line_, 1}, "vertex colours are ignored");
}

void ObjLines::check_face(std::string_view key, std::string_view words) {
  constexpr int kMaxCorners = 4096; // ear clipping takes quadratic time
  int corners = 0;
  for (std::string_view word = next_word(words); !word.empty(); word = next_word(words)) {
    check_corner(word);
    if (++corners > kMaxCorners)
      throw limit_error(at(word), "f", fmt::format("a polygon of more than {} corners", kMaxCorners),
                        "split it in the modelling program");
  }
  if (corners < 3) warnings_.add(at(key), "faces with fewer than three corners are dropped");
}

/// v, v/vt, v//vn or v/vt/vn.
void ObjLines::check_corner(std::string_view word) {
  std::string_view rest = word;
  for (Kind kind : {position, uv, normal}) {
    std::size_t slash = std::min(rest.find('/'), rest.size());
    bool may_be_empty = kind == uv && slash < rest.size();
    if (slash > 0 || !may_be_empty) check_index(kind, rest.substr(0, slash), word);
    if (slash == rest.size()) return;
    rest.remove_prefix(slash + 1);
  }
  throw input_error(at(word), "f", fmt::format("'{}' has too many parts", shortened(word)), "write v/vt/vn");
}

void ObjLines::check_index(Kind kind, std::string_view digits, std::string_view word) {
  std::string_view magnitude = digits;
  if (!magnitude.empty() && (magnitude.front() == '-' || magnitude.front() == '+'))
    magnitude.remove_prefix(1);
  if (magnitude.empty() || !std::ranges::all_of(magnitude, is_digit))
    throw input_error(at(word), "f", fmt::format("'{}' is no corner", shortened(word)),
                      "write v, v/vt, v//vn or v/vt/vn with integers");
  constexpr std::size_t kMostDigits = 9; // what fits an int for certain; the file's cap holds fewer vertices
  int index = 0;
  if (magnitude.size() <= kMostDigits)
    std::from_chars(magnitude.data(), magnitude.data() + magnitude.size(), index);
  bool negative = digits.front() == '-';
  ForwardIndex it{kind, negative ? -index : index, at(word)};
  if (index == 0 || (negative && index > count_[kind])) throw bad_index(it, magnitude.size() > kMostDigits);
  if (!negative && index > count_[kind]) forward_.push_back(std::move(it));
}

Error ObjLines::bad_index(const ForwardIndex& it, bool too_long) const {
  static constexpr std::string_view kNames[] = {"v", "vt", "vn"};
  std::string cause = too_long ? "an index is far out of range"
                               : fmt::format("index {} is out of range: there are {} {} lines{}", it.index,
                                             count_[it.kind], kNames[it.kind], it.index < 0 ? " so far" : "");
  return input_error(it.where, "f", cause,
                     "indices count from 1, or from -1 backwards; export the file again");
}

void ObjLines::check_forward_indices() const {
  for (const ForwardIndex& it : forward_)
    if (it.index > count_[it.kind]) throw bad_index(it, false);
}

} // namespace candela
