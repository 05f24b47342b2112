#include "io/files/apart.h"

#include <condition_variable>
#include <mutex>

namespace candela {

namespace {

struct Threads {
  std::mutex mutex;
  std::condition_variable ended;
  int count = 0;

  ~Threads() {
    constexpr std::chrono::seconds kPatience{2};
    std::unique_lock lock(mutex);
    ended.wait_for(lock, kPatience, [&] { return count == 0; });
  }
};

Threads& threads() {
  static Threads all;
  return all;
}

} // namespace

ApartThread::ApartThread() {
  std::lock_guard lock(threads().mutex);
  ++threads().count;
}

ApartThread::~ApartThread() {
  if (!counts_) return;
  std::lock_guard lock(threads().mutex);
  --threads().count;
  threads().ended.notify_all();
}

} // namespace candela
