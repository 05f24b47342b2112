#pragma once
// Detects changes of files on the disk, by polling them on a thread of its own.

#include "io/files/file_stamp.h"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>

namespace candela {

class FileWatch {
public:
  /// `wake` is called from the watching thread when there is a change.
  explicit FileWatch(std::function<void()> wake, double seconds_between_looks = 0.5);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches these instead: compares with their stamps in `known`, else with those last reported, else with
  /// those of now.
  void watch(std::set<std::string> files, FileStamps known = {});

  /// Those that were written, made or removed since, and then came to rest: a file that is still being
  /// written would be read half. Each change is reported once.
  std::set<std::string> take_changes();
  bool has_change() const;

private:
  static FileStamps look(const std::set<std::string>& files);
  void run(double seconds);

  std::function<void()> wake_;
  mutable std::mutex mutex_; // never held while files are read
  std::condition_variable ended_;
  std::set<std::string> files_;
  FileStamps known_;
  std::uint64_t generation_ = 0; ///< of files_ and known_
  std::set<std::string> changed_;
  bool stopping_ = false;
  std::thread thread_;
};

} // namespace candela
