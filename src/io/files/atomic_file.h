#pragma once
// Files appear whole or not at all: everything the program writes goes through here.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace candela {

/// Replaces (or makes) the file at `path`: the bytes go to a temporary name in the same folder, are flushed
/// to the disk, and the name is changed, so that nobody ever sees a part of them, whatever happens. The
/// permissions of a file that is replaced are kept; a symbolic link's target is replaced, not the link; what
/// is no regular file (a pipe, a device) and open descriptors (/dev/stdout) are written to directly, as is a
/// file that is mounted by itself (as containers do), which has no other name to take. On failure the
/// temporary file is removed, an old file is as it was, and output_error is thrown.
void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes);
void write_file_atomically(const std::string& path, std::string_view text);

/// Throws the output_error with which write_file_atomically() would end at `path`, as far as that can be
/// known beforehand: work of hours is not to end with a folder that was never there. Changes nothing.
void check_writable(const std::string& path);

/// Whether the path names an open descriptor, a pipe or a device, which can take several outputs in turn.
bool is_stream(const std::string& path);

/// Writes to the first of folder/stem.ending, folder/stem-2.ending, folder/stem-3.ending … that does not
/// exist, and never to one that does, even if other programs do the same at this moment. `ending` has its
/// dot. Returns the path; throws output_error as above.
std::string write_file_uniquely(const std::string& folder, const std::string& stem, const std::string& ending,
                                std::span<const std::uint8_t> bytes);

/// A path to hand to code that writes a file by itself, step by step, for as long as the object lives:
/// commit() gives the file its name; without it the destructor removes it.
class PendingFile {
public:
  /// Creates the temporary file, empty; output_error if that fails.
  explicit PendingFile(const std::string& path);
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();

  const std::string& temporary_path() const { return temporary_; }
  /// Appends to the file.
  void write(std::span<const std::uint8_t> bytes);
  /// Flushes to the disk and gives the file its name, replacing what had it.
  void commit();
  /// The same unless a file has that name: then false, and the file stays pending.
  bool commit_new(const std::string& path);

private:
  void flush();

  std::string path_;      ///< as the user knows it, for messages
  std::string target_;    ///< the same with symbolic links followed
  std::string temporary_; ///< empty once committed
  int descriptor_ = -1;
};

} // namespace candela
