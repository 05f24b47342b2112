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

void FileWatch::watch(std::set<std::string> files) {
  {
    std::lock_guard lock(mutex_);
    files_ = std::move(files);
    ++generation_;
    changed_.clear();
  }
  ended_.notify_one();
}

std::set<std::string> FileWatch::take_changes() {
  std::lock_guard lock(mutex_);
  return std::exchange(changed_, {});
}

bool FileWatch::has_change() const {
  std::lock_guard lock(mutex_);
  return !changed_.empty();
}

FileWatch::Stamps FileWatch::look(const std::set<std::string>& files) {
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
    const std::set<std::string> files = files_;
    const std::uint64_t generation = generation_;
    lock.unlock();
    const auto began = std::chrono::steady_clock::now();
    const Stamps now = look(files);
    const std::chrono::duration<double> looked = std::chrono::steady_clock::now() - began;
    lock.lock();
    bool news = false;
    if (generation != known) {
      known = generation;
      base = now;
    } else if (now != base && now == last && generation == generation_) {
      std::size_t i = 0;
      for (const std::string& file : files) {
        if (now[i] != base[i]) changed_.insert(file);
        ++i;
      }
      base = now;
      news = true;
    }
    last = now;
    if (news && wake_) {
      lock.unlock();
      wake_();
      lock.lock();
    }
    // Thousands of files, or a slow disk, are looked at the more seldom.
    constexpr double kShare = 0.05;
    ended_.wait_for(lock, std::max(std::chrono::duration<double>(seconds), looked / kShare),
                    [&] { return stopping_ || generation_ != known; });
  }
}

} // namespace candela
