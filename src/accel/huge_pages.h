#pragma once
// An allocator for the arrays that rays jump about in: in huge pages a large tree needs few entries of the
// address translation cache.

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace candela {

template <class T>
struct HugePageAllocator {
  using value_type = T;
  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    std::size_t bytes = count * sizeof(T);
    if (bytes < kPage) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    bytes = (bytes + kPage - 1) / kPage * kPage;
    void* p = ::operator new (bytes, std::align_val_t{kPage});
#if defined(__linux__)
    // Advice: where it cannot be followed, nothing is lost.
    madvise(p, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t count) {
    std::size_t bytes = count * sizeof(T);
    ::operator delete (p, std::align_val_t{bytes < kPage ? alignof(T) : kPage});
  }
  /// Whoever resizes an array of these writes all of it: leave numbers unset.
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
  bool operator==(const HugePageAllocator&) const { return true; }

private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

} // namespace candela
