#pragma once
// A sequence that grows without moving its elements.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace candela {

/// Elements lie in blocks. A std::vector that grows copies all that it has, which takes long enough, for
/// hundreds of millions, to delay the cancellation of a reader.
template <class T>
class BlockVector {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return blocks_[i >> kShift][i & kMask]; }
  const T& operator[](std::size_t i) const { return blocks_[i >> kShift][i & kMask]; }

  void push_back(const T& value) {
    if (size_ >> kShift == blocks_.size())
      blocks_.push_back(std::make_unique_for_overwrite<T[]>(std::size_t{1} << kShift));
    (*this)[size_++] = value;
  }
  /// Keeps the first `size` elements.
  void truncate(std::size_t size) { size_ = size; }

private:
  static constexpr int kShift = 14;
  static constexpr std::size_t kMask = (std::size_t{1} << kShift) - 1;
  std::vector<std::unique_ptr<T[]>> blocks_;
  std::size_t size_ = 0;
};

} // namespace candela
