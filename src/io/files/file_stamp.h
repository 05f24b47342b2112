#pragma once
// A stamp that tells whether a file has changed, without reading it.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace candela {

struct FileStamp {
  bool exists = false;
  std::filesystem::file_time_type written;
  std::uintmax_t size = 0;
  bool operator==(const FileStamp&) const = default;
};
/// Files by their path.
using FileStamps = std::map<std::string, FileStamp>;

inline FileStamp file_stamp(const std::string& path) {
  std::error_code failed;
  FileStamp stamp;
  stamp.written = std::filesystem::last_write_time(path, failed);
  stamp.exists = !failed;
  if (!stamp.exists) return {};
  stamp.size = std::filesystem::file_size(path, failed);
  return stamp;
}

} // namespace candela
