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

  /// Watches these files instead: compares with their stamps in `known`, else with those last reported, else
  /// with the current ones.
  void watch(std::set<std::string> files, FileStamps known = {});

  /// The files that were written, created or removed since and have not changed again: a file that is still
  /// being written would be incomplete. Each change is reported once.
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
