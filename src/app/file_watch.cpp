#include "app/file_watch.h"

#include <utility>

namespace candela {

FileWatch::FileWatch(std::function<void()> wake, double seconds_between_looks)
    : wake_(std::move(wake)), thread_([this, seconds_between_looks] { run(seconds_between_looks); }) {}

FileWatch::~FileWatch() {
  {
    std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void FileWatch::watch(std::vector<std::string> files) {
  {
    std::lock_guard lock(mutex_);
    files_ = std::move(files);
    ++generation_;
    changed_ = false;
  }
  ended_.notify_one();
}

bool FileWatch::take_change() {
  std::lock_guard lock(mutex_);
  return std::exchange(changed_, false);
}

bool FileWatch::has_change() const {
  std::lock_guard lock(mutex_);
  return changed_;
}

FileWatch::Stamps FileWatch::look(const std::vector<std::string>& files) {
  Stamps stamps;
  for (const std::string& file : files) {
    std::error_code failed;
    Stamp stamp;
    stamp.written = std::filesystem::last_write_time(file, failed);
    stamp.exists = !failed;
    if (stamp.exists) stamp.size = std::filesystem::file_size(file, failed);
    stamps.push_back(stamp);
  }
  return stamps;
}

void FileWatch::run(double seconds) {
  std::uint64_t known = 0; // generation that `base` belongs to
  Stamps base, last;
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const std::vector<std::string> files = files_;
    const std::uint64_t generation = generation_;
    lock.unlock();
    const Stamps now = look(files);
    lock.lock();
    bool news = false;
    if (generation != known) {
      known = generation;
      base = now;
    } else if (now != base && now == last && generation == generation_) {
      base = now;
      changed_ = news = true;
    }
    last = now;
    if (news && wake_) {
      lock.unlock();
      wake_();
      lock.lock();
    }
    ended_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [&] { return stopping_ || generation_ != known; });
  }
}

} // namespace candela
