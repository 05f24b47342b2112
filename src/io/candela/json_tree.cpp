#include "io/candela/json_tree.h"

#include "io/files/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unordered_set>

namespace candela {

namespace {

bool is_number_char(char c) {
  return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E';
}

/// One past the token that starts at `start`, which the parser has accepted.
std::size_t token_end(std::string_view text, std::size_t start) {
  std::size_t i = start;
  char c = text[start];
  if (c == '"') {
    for (++i; i < text.size() && text[i] != '"'; ++i)
      if (text[i] == '\\') ++i;
    return std::min(i + 1, text.size());
  }
  if (is_number_char(c)) {
    while (i < text.size() && is_number_char(text[i])) ++i;
    return i;
  }
  while (i < text.size() && text[i] >= 'a' && text[i] <= 'z') ++i; // true, false, null
  return std::max(i, start + 1);                                   // brackets
}

/// Skips white space and comments.
std::size_t skip_space(std::string_view text, std::size_t i) {
  while (i < text.size()) {
    if (text[i] == ' ' || text[i] == '\t' || text[i] == '\n' || text[i] == '\r') {
      ++i;
    } else if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.substr(i, 2) == "/*") {
      auto close = text.find("*/", i + 2);
      if (close == std::string_view::npos) return i;
      i = close + 2;
    } else {
      break;
    }
  }
  return i;
}

std::string_view after_last(std::string_view text, std::string_view mark) {
  auto found = text.rfind(mark);
  return found == std::string_view::npos ? text : text.substr(found + mark.size());
}

/// Iterates over the characters for the parser and checks for cancellation, even within strings or comments
/// of hundreds of megabytes.
class WatchedCharacters {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  WatchedCharacters(const char* at, const ProgressPart* progress) : at_(at), progress_(progress) {}
  const char& operator*() const { return *at_; }
  WatchedCharacters& operator++() {
    ++at_;
    if (progress_ && (reinterpret_cast<std::uintptr_t>(at_) & (kStride - 1)) == 0) progress_->check();
    return *this;
  }
  WatchedCharacters operator++(int) {
    WatchedCharacters before = *this;
    ++*this;
    return before;
  }
  bool operator==(const WatchedCharacters& other) const { return at_ == other.at_; }

private:
  static constexpr std::uintptr_t kStride = 4096; ///< a power of two
  const char* at_;
  const ProgressPart* progress_;
};

constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxNodes = std::size_t{1} << 25;

} // namespace

/// The receiver of nlohmann's SAX events. They have no locations but come in order: each token begins at the
/// first character after the previous token that is neither space nor a separator.
class JsonTreeBuilder {
public:
  JsonTreeBuilder(JsonTree& tree, ProgressPart* progress, double share)
      : tree_(tree), text_(tree.text_), progress_(progress),
        share_of_byte_(share / static_cast<double>(text_.size() + 1)) {}

  // The interface that nlohmann::json::sax_parse requires.
  bool null() { return leaf(JsonType::null); }
  bool boolean(bool) { return leaf(JsonType::boolean); }
  bool number_integer(std::int64_t) { return leaf(JsonType::number); }
  bool number_unsigned(std::uint64_t) { return leaf(JsonType::number); }
  bool number_float(double, const std::string&) { return leaf(JsonType::number); }
  bool string(std::string& value) {
    add(JsonType::string).value = static_cast<std::uint32_t>(tree_.strings_.size());
    tree_.strings_.push_back(std::move(value));
    return true;
  }
  bool binary(nlohmann::json::binary_t&) { return false; } // not in JSON text
  bool start_object(std::size_t) { return open(JsonType::object); }
  bool start_array(std::size_t) { return open(JsonType::array); }
  bool key(std::string& value) {
    if (!keys_.back().insert(value).second)
      throw input_error(place(next_token()), fmt::format("key '{}'", value),
                        "it is here a second time in the same object", "keep one of them");
    ++tree_.nodes_[open_.back()].value;
    string(value);
    return true;
  }
  bool end_object() {
    keys_.pop_back();
    return close();
  }
  bool end_array() { return close(); }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& problem) {
    std::size_t start = skip_space(text_, cursor_);
    // One separator may stand before the offending token, unless the parser stopped at the separator itself.
    if (start < text_.size() && (text_[start] == ',' || text_[start] == ':')) {
      std::size_t token = skip_space(text_, start + 1);
      if (token < position) start = token;
    }
    // "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while … - <cause>"
    std::string_view cause = problem.what();
    if (auto colon = cause.find(": "); colon != std::string_view::npos) cause.remove_prefix(colon + 2);
    if (problem.id == 406) cause = "the number is too large";
    constexpr std::size_t kLongestCause = 300;
    throw input_error(place(start), "JSON", after_last(cause, " - ").substr(0, kLongestCause),
                      "correct the syntax here");
  }

private:
  Location place(std::size_t offset) const { return locate(tree_.file_, text_, offset); }

  std::size_t next_token() const {
    std::size_t i = skip_space(text_, cursor_);
    while (i < text_.size() && (text_[i] == ',' || text_[i] == ':')) i = skip_space(text_, i + 1);
    return i;
  }

  JsonTree::Node& add(JsonType type) {
    std::size_t start = next_token();
    if (tree_.nodes_.size() >= kMaxNodes)
      throw limit_error(place(start), "JSON", fmt::format("more than {} values", kMaxNodes),
                        "keep large meshes in OBJ files");
    // Elements of arrays are counted here, members of objects with their keys.
    if (!open_.empty() && tree_.nodes_[open_.back()].type == JsonType::array)
      ++tree_.nodes_[open_.back()].value;
    cursor_ = token_end(text_, start);
    if (progress_) progress_->reach(share_of_byte_ * static_cast<double>(cursor_));
    auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.push_back({static_cast<std::uint32_t>(start), index + 1, 0, type});
    return tree_.nodes_.back();
  }

  bool leaf(JsonType type) {
    add(type);
    return true;
  }

  bool open(JsonType type) {
    if (open_.size() >= kMaxDepth)
      throw limit_error(place(next_token()), "JSON", fmt::format("more than {} levels of nesting", kMaxDepth),
                        "flatten it");
    auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
    add(type);
    open_.push_back(index);
    if (type == JsonType::object) keys_.emplace_back();
    return true;
  }

  bool close() {
    cursor_ = next_token() + 1;
    tree_.nodes_[open_.back()].end = static_cast<std::uint32_t>(tree_.nodes_.size());
    open_.pop_back();
    return true;
  }

  JsonTree& tree_;
  std::string_view text_;
  ProgressPart* progress_;
  double share_of_byte_;
  std::size_t cursor_ = 0; ///< one past the last token
  std::vector<std::uint32_t> open_;
  std::vector<std::unordered_set<std::string>> keys_; ///< of each open object
};

JsonTree::JsonTree(std::string file, std::string text, ProgressPart* progress, double share)
    : file_(std::move(file)), text_(std::move(text)) {
  JsonTreeBuilder builder(*this, progress, share);
  const char* begin = text_.data();
  nlohmann::json::sax_parse(WatchedCharacters(begin, progress),
                            WatchedCharacters(begin + text_.size(), progress), &builder,
                            nlohmann::json::input_format_t::json,
                            /*strict=*/true, /*ignore_comments=*/true);
}

JsonType JsonValue::type() const { return tree_->nodes_[node_].type; }
std::size_t JsonValue::offset() const { return tree_->nodes_[node_].offset; }
Location JsonValue::where() const { return locate(tree_->file_, tree_->text_, offset()); }
std::string_view JsonValue::token() const {
  std::size_t start = tree_->nodes_[node_].offset;
  return std::string_view(tree_->text_).substr(start, token_end(tree_->text_, start) - start);
}
const std::string& JsonValue::string() const { return tree_->strings_[tree_->nodes_[node_].value]; }
std::uint32_t JsonValue::size() const { return tree_->nodes_[node_].value; }
JsonValue::Iterator JsonValue::end() const { return {*tree_, tree_->nodes_[node_].end}; }
JsonValue::Iterator& JsonValue::Iterator::operator++() {
  node_ = tree_->nodes_[node_].end;
  return *this;
}

std::vector<JsonValue::Member> JsonValue::members() const {
  std::vector<Member> out;
  out.reserve(size());
  // The nodes of an object alternate between keys and values.
  for (Iterator it = begin(); it != end();) {
    JsonValue key = *it;
    ++it;
    out.push_back({key, *it});
    ++it;
  }
  return out;
}

std::string json_quoted(std::string_view text) {
  return nlohmann::json(std::string(text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace candela
