#pragma once
// Atomic writing of files, used for everything that the program writes.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace candela {

/// Creates or replaces the file at `path`: the bytes are written to a temporary file in the same folder,
/// flushed to the disk and renamed, so that no incomplete file is ever visible. The permissions of a replaced
/// file are kept; of a symbolic link the target is replaced. Other files than regular ones (pipes, devices),
/// open descriptors (/dev/stdout) and files that are mount points (as in containers) are written to directly.
/// On failure the temporary file is removed, an old file is unchanged, and output_error is thrown.
void write_file_atomically(const std::string& path, std::span<const std::uint8_t> bytes);
void write_file_atomically(const std::string& path, std::string_view text);

/// Throws the output_error that write_file_atomically() would throw at `path`, as far as that can be known in
/// advance, so that long work does not end with a missing folder. Changes nothing.
void check_writable(const std::string& path);

/// Whether the path names an open descriptor, a pipe or a device, which can take several outputs in turn.
bool is_stream(const std::string& path);

/// Writes to the first of folder/stem.ending, folder/stem-2.ending, folder/stem-3.ending … that does not
/// exist. Never overwrites a file, even if other programs create files at the same time. `ending` includes
/// the dot. Returns the path; throws output_error as above.
std::string write_file_uniquely(const std::string& folder, const std::string& stem, const std::string& ending,
                                std::span<const std::uint8_t> bytes);

/// A temporary path for code that writes a file by itself. commit() gives the file its name; without it the
/// destructor removes the file.
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
  /// Flushes to the disk and renames the file, replacing an existing one.
  void commit();
  /// The same, but returns false if a file of that name exists; then this one stays pending.
  bool commit_new(const std::string& path);

private:
  void flush();

  std::string path_;      ///< as given by the user, for messages
  std::string target_;    ///< the same with symbolic links followed
  std::string temporary_; ///< empty once committed
  int descriptor_ = -1;
};

} // namespace candela
