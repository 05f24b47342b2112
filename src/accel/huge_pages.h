#pragma once
// An allocator for the arrays that rays jump about in: in huge pages a large tree needs few entries of the
// address translation cache. On the 1.3-million-triangle sphere of traversal_bench that is worth GAIN of the
// rays.

#include <cstddef>
#include <cstdlib>
#include <new>
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
  bool operator==(const HugePageAllocator&) const { return true; }

private:
  static constexpr std::size_t kPage = std::size_t{1} << 21;
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

} // namespace candela
