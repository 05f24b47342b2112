#pragma once
// A pool of large values that are created often and shared for some time: memory is reused, since new pages
// cost more than writing to them.

#include <memory>
#include <mutex>
#include <vector>

namespace candela {

template <class T>
class Recycler {
public:
  /// A new T, or a returned one in its last state. May outlive the Recycler.
  std::shared_ptr<T> take() {
    std::unique_ptr<T> value;
    {
      std::lock_guard lock(shelf_->mutex);
      if (!shelf_->spare.empty()) {
        value = std::move(shelf_->spare.back());
        shelf_->spare.pop_back();
      }
    }
    if (!value) value = std::make_unique<T>();
    return {value.release(), [shelf = shelf_](T* back) {
              std::unique_ptr<T> owned(back);
              std::lock_guard lock(shelf->mutex);
              if (shelf->spare.size() < kMostSpare) shelf->spare.push_back(std::move(owned));
            }};
  }

private:
  static constexpr std::size_t kMostSpare = 2;
  struct Shelf {
    Shelf() { spare.reserve(kMostSpare); } // giving back never allocates
    std::mutex mutex;
    std::vector<std::unique_ptr<T>> spare;
  };
  std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

} // namespace candela
