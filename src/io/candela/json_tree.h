#pragma once
// JSON as a tree in which every token has its location, for error messages.

#include "core/error.h"
#include "core/progress.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace candela {

enum class JsonType : std::uint8_t { null, boolean, number, string, array, object };

class JsonTree;

/// One value of a JsonTree, which must outlive it. Cheap to copy.
class JsonValue {
public:
  JsonValue(const JsonTree& tree, std::uint32_t node) : tree_(&tree), node_(node) {}

  JsonType type() const;
  Location where() const;         ///< of its first character
  std::size_t offset() const;     ///< the same, in bytes from the start of the file
  std::string_view token() const; ///< as in the file; for arrays and objects only the bracket
  bool boolean() const { return token() == "true"; }
  const std::string& string() const; ///< unescaped; of strings only
  std::uint32_t size() const;        ///< elements of an array, members of an object

  /// Forward iteration over the elements of an array.
  class Iterator {
  public:
    Iterator(const JsonTree& tree, std::uint32_t node) : tree_(&tree), node_(node) {}
    JsonValue operator*() const { return {*tree_, node_}; }
    Iterator& operator++();
    bool operator==(const Iterator&) const = default;

  private:
    const JsonTree* tree_;
    std::uint32_t node_;
  };
  Iterator begin() const { return {*tree_, node_ + 1}; }
  Iterator end() const;

  struct Member;
  std::vector<Member> members() const; ///< of an object, in the order of the file

private:
  const JsonTree* tree_;
  std::uint32_t node_;
};

struct JsonValue::Member {
  JsonValue key; ///< a string
  JsonValue value;
};

/// The parsed file. Nodes are stored in document order in one array, 16 bytes each, because meshes have
/// millions of numbers. Numbers are kept as text, to be parsed in the precision of their user.
class JsonTree {
public:
  /// Parses RFC 8259 JSON; comments (// and /* */) count as space. Throws input_error for syntax errors and
  /// duplicate keys, limit_error for more than 64 levels or 2^25 values. Parsing is the part [0, share] of
  /// `progress`, which may be null, and throws Cancelled when that is cancelled.
  JsonTree(std::string file, std::string text, ProgressPart* progress = nullptr, double share = 1);

  JsonValue root() const { return {*this, 0}; }
  const std::string& file() const { return file_; }
  std::size_t size() const { return text_.size(); } ///< bytes

private:
  friend class JsonValue;
  friend class JsonTreeBuilder;
  struct Node {
    std::uint32_t offset; ///< of the token in text_
    std::uint32_t end;    ///< one past the last node of this subtree
    std::uint32_t value;  ///< string: index into strings_; array and object: number of children
    JsonType type;
  };
  std::string file_;
  std::string text_;
  std::vector<Node> nodes_;
  std::vector<std::string> strings_;
};

/// A JSON string literal with its quotes; bytes that are not UTF-8 become U+FFFD.
std::string json_quoted(std::string_view text);

} // namespace candela
