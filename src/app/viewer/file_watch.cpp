#include "app/viewer/file_watch.h"

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

void FileWatch::watch(std::set<std::string> files, FileStamps known) {
  {
    std::lock_guard lock(mutex_);
    // Changes that were not taken yet are kept, except for files that have been read since.
    std::erase_if(changed_,
                  [&](const std::string& file) { return !files.contains(file) || known.contains(file); });
    for (auto& [file, stamp] : known_) known.emplace(file, stamp); // not checked yet
    files_ = std::move(files);
    known_ = std::move(known);
    ++generation_;
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

FileStamps FileWatch::look(const std::set<std::string>& files) {
  FileStamps stamps;
  for (const std::string& file : files) stamps.emplace(file, file_stamp(file));
  return stamps;
}

void FileWatch::run(double seconds) {
  FileStamps told, last; // stamps as last reported; stamps at the last check
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const std::set<std::string> files = files_;
    const std::uint64_t generation = generation_;
    lock.unlock();
    const auto began = std::chrono::steady_clock::now();
    FileStamps now = look(files);
    const std::chrono::duration<double> looked = std::chrono::steady_clock::now() - began;
    lock.lock();
    if (generation != generation_) continue; // the set of files has changed
    for (auto& [file, stamp] : std::exchange(known_, {})) told.insert_or_assign(file, stamp);
    std::erase_if(told, [&](const auto& entry) { return !files.contains(entry.first); });
    told.insert(now.begin(), now.end());
    const bool news = now != told && now == last;
    if (news) {
      for (const auto& [file, stamp] : now)
        if (stamp != told[file]) changed_.insert(file);
      told = now;
    }
    last = std::move(now);
    if (news && wake_) {
      lock.unlock();
      wake_();
      lock.lock();
    }
    // Thousands of files, or a slow disk, are polled less often.
    constexpr double kShare = 0.05;
    ended_.wait_for(lock, std::max(std::chrono::duration<double>(seconds), looked / kShare),
                    [&] { return stopping_ || generation_ != generation; });
  }
}

} // namespace candela
