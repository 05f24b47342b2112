#include "io/files/atomic_file.h"

#include "core/error.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace candela {

namespace {

namespace fs = std::filesystem;

Error failed(const std::string& path, const char* what, int error) {
  const char* remedy = error == ENOSPC || error == EDQUOT ? "free some disk space"
                       : error == ENOENT                  ? "make its folder first"
                       : error == EISDIR                  ? "name a file in it"
                                                          : "check the path and its permissions";
  return output_error(path, fmt::format("{}: {}", what, std::strerror(error)), remedy);
}

/// The file that `path` refers to: follows links, even to files that do not exist yet.
std::string follow_links(const std::string& path) {
  fs::path at = path;
  for (int i = 0; i < 40; ++i) { // the kernel's limit
    std::error_code error;
    fs::path next = fs::read_symlink(at, error);
    if (error) return at.string();
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  throw failed(path, "it cannot be written", ELOOP);
}

void write_all(int descriptor, std::span<const std::uint8_t> bytes, const std::string& path) {
  while (!bytes.empty()) {
    ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw failed(path, "it cannot be written", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

/// Makes the new name survive a crash. Failures are ignored: some file systems cannot sync folders, and the
/// file is complete in any case.
void sync_folder(const std::string& file) {
  fs::path folder = fs::path(file).parent_path();
  int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

bool is_special(const struct stat& status) { return !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode); }

/// A file that is a mount point cannot be replaced by a file of its folder.
bool is_mounted_file(const std::string& path, const struct stat& status) {
  struct statx more {};
  return S_ISREG(status.st_mode) && ::statx(AT_FDCWD, path.c_str(), 0, STATX_TYPE, &more) == 0 &&
         (more.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

/// N of /dev/fd/N, /proc/self/fd/N and of links to them, such as /dev/stdout. Opening such a path again would
/// overwrite the file from its start; replacing it would leave other writers with an unlinked file.
std::optional<int> named_descriptor(const std::string& path) {
  fs::path at = path;
  for (int i = 0; i < 40; ++i) {
    const std::string folder = at.parent_path().string(), name = at.filename().string();
    if (folder == "/dev/fd" || folder == "/proc/self/fd" ||
        folder == fmt::format("/proc/{}/fd", ::getpid())) {
      int value = -1;
      const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), value);
      if (error == std::errc() && end == name.data() + name.size()) return value;
    }
    std::error_code error;
    const fs::path next = fs::read_symlink(at, error);
    if (error) return std::nullopt;
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  return std::nullopt;
}

/// The way of writing to a path.
enum class Way { replaced, opened, descriptor };

struct Target {
  Way way = Way::replaced;
  int descriptor = -1;
};

Target target_of(const std::string& path) {
  if (const std::optional<int> n = named_descriptor(path)) return {Way::descriptor, *n};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {is_special(status) || is_mounted_file(path, status) ? Way::opened : Way::replaced, -1};
}

/// Whether rename would fail because of the folder's sticky bit, which protects other users' files even if
/// they are writable.
bool is_kept_by_folder(const struct stat& file, const fs::path& folder) {
  struct stat status {};
  const uid_t me = ::geteuid();
  return me != 0 && ::stat(folder.empty() ? "." : folder.c_str(), &status) == 0 &&
         (status.st_mode & S_ISVTX) != 0 && file.st_uid != me && status.st_uid != me;
}

} // namespace

PendingFile::PendingFile(const std::string& path) : path_(path), target_(follow_links(path)) {
  if (path.empty()) throw output_error("''", "the name is empty", "name a file");
  struct stat status {};
  const bool replaces = ::stat(target_.c_str(), &status) == 0;
  // For instance, the name is too long, or a parent is a file: no new file can have that name either.
  if (!replaces && errno != ENOENT) throw failed(path, "it cannot be written", errno);
  if (replaces && S_ISDIR(status.st_mode)) throw failed(path, "it cannot be written", EISDIR);
  // rename would replace even a read-only file.
  if (replaces && ::access(target_.c_str(), W_OK) != 0) throw failed(path, "it cannot be written", errno);
  static std::atomic<unsigned> counter = 0;
  fs::path folder = fs::path(target_).parent_path();
  if (replaces && is_kept_by_folder(status, folder)) throw failed(path, "it cannot be replaced", EPERM);
  for (int attempt = 0; attempt < 1000 && descriptor_ < 0; ++attempt) {
    // A short name, since the target's name may have the maximum length.
    temporary_ = (folder / fmt::format(".candela-{}-{}.tmp", ::getpid(), counter++)).string();
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) {
    temporary_.clear(); // the file is not ours
    throw failed(path, "it cannot be written", errno);
  }
  // If this fails, the file has the default permissions.
  if (replaces && ::fchmod(descriptor_, status.st_mode & 07777) != 0) errno = 0;
}

PendingFile::~PendingFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void PendingFile::write(std::span<const std::uint8_t> bytes) { write_all(descriptor_, bytes, path_); }

void PendingFile::flush() {
  if (descriptor_ < 0) return;
  if (::fsync(descriptor_) != 0) throw failed(path_, "it cannot be flushed to the disk", errno);
  int result = ::close(descriptor_);
  int error = errno;
  descriptor_ = -1;
  if (result != 0) throw failed(path_, "it cannot be written", error);
}

void PendingFile::commit() {
  flush();
  if (::rename(temporary_.c_str(), target_.c_str()) != 0)
    throw failed(path_, "it cannot be given its name", errno);
  temporary_.clear();
  sync_folder(target_);
}

bool PendingFile::commit_new(const std::string& path) {
  flush();
  if (::link(temporary_.c_str(), path.c_str()) == 0) {
    ::unlink(temporary_.c_str());
  } else {
    if (errno == EEXIST) return false;
    // A file system without hard links: reserve the name, then replace what was reserved.
    int reserved = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (reserved < 0 && errno == EEXIST) return false;
    if (reserved < 0) throw failed(path, "it cannot be written", errno);
    ::close(reserved);
    if (::rename(temporary_.c_str(), path.c_str()) != 0) {
      int error = errno;
      ::unlink(path.c_str());
      throw failed(path, "it cannot be given its name", error);
    }
  }
  temporary_.clear();
  sync_folder(path);
  return true;
}

void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes) {
  const Target target = target_of(path);
  if (target.way == Way::descriptor) {
    std::fflush(nullptr); // keeps the order of the output
    write_all(target.descriptor, bytes, path);
    return;
  }
  if (target.way == Way::opened) {
    int descriptor = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (descriptor < 0) throw failed(path, "it cannot be written", errno);
    try {
      write_all(descriptor, bytes, path);
    } catch (...) {
      ::close(descriptor);
      throw;
    }
    if (::close(descriptor) != 0) throw failed(path, "it cannot be written", errno);
    return;
  }
  PendingFile file(path);
  file.write(bytes);
  file.commit();
}

void check_writable(const std::string& path) {
  const Target target = target_of(path);
  switch (target.way) {
  case Way::descriptor: {
    const int mode = ::fcntl(target.descriptor, F_GETFL);
    if (mode < 0) throw failed(path, "it cannot be written", errno);
    if ((mode & O_ACCMODE) == O_RDONLY) throw failed(path, "it cannot be written", EBADF);
    return;
  }
  case Way::opened: // opening a pipe would wait for its reader
    if (::access(path.c_str(), W_OK) != 0) throw failed(path, "it cannot be written", errno);
    return;
  case Way::replaced: PendingFile{path}; return; // removed at once
  }
}

bool is_stream(const std::string& path) {
  struct stat status {};
  return named_descriptor(path) || (::stat(path.c_str(), &status) == 0 && is_special(status));
}

void write_file_atomically(const std::string& path, std::string_view text) {
  write_file_atomically(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string write_file_uniquely(const std::string& folder, const std::string& stem, const std::string& ending,
                                std::span<const std::uint8_t> bytes) {
  auto candidate = [&](int i) {
    return (fs::path(folder) / (i == 1 ? stem + ending : fmt::format("{}-{}{}", stem, i, ending))).string();
  };
  // The pending file's name only serves for messages and to choose the folder.
  PendingFile file((fs::path(folder) / fmt::format(".{}-new{}", stem, ending)).string());
  file.write(bytes);
  for (int i = 1; i < 1000000; ++i)
    if (std::string path = candidate(i); file.commit_new(path)) return path;
  throw output_error(candidate(1), "a million files have such names", "remove some of them");
}

} // namespace candela
