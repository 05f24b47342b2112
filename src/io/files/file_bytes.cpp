#include "io/files/file_bytes.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace candela {

namespace {

struct Descriptor {
  int value = -1;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

template <class Container>
Container read_whole(const std::string& path, const char* element, std::size_t max_bytes,
                     const Progress* progress) {
  Location where{path};
  auto failed = [&](const char* what) {
    return input_error(where, element, fmt::format("{}: {}", what, std::strerror(errno)),
                       "check the path and its permissions");
  };
  // O_NONBLOCK: opening a pipe without a writer returns, so that it can be refused.
  Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.value < 0) throw failed("it cannot be opened");
  struct stat status {};
  if (::fstat(file.value, &status) != 0) throw failed("it cannot be opened");
  if (!S_ISREG(status.st_mode))
    throw input_error(where, element, "it is not a regular file", "name a file, no folder, pipe or device");
  auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > max_bytes)
    throw limit_error(where, element, fmt::format("{} bytes are more than the {} allowed", size, max_bytes),
                      "use a smaller file");
  // Filling the container with zeros first would take long for gigabytes, without a check for cancellation.
  Container bytes;
  bytes.reserve(size);
  std::array<char, 65536> piece;
  while (bytes.size() < size) {
    if (progress) progress->check();
    const std::size_t wanted = std::min<std::size_t>(piece.size(), size - bytes.size());
    ssize_t got = ::read(file.value, piece.data(), wanted);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw failed("it cannot be read");
    if (got == 0) break; // the file has shrunk: the decoder will report it
    const auto* begin = reinterpret_cast<const typename Container::value_type*>(piece.data());
    bytes.insert(bytes.end(), begin, begin + got);
  }
  return bytes;
}

} // namespace

Bytes read_file_bytes(const std::string& path, const char* element, const Progress* progress,
                      std::size_t max_bytes) {
  return read_whole<Bytes>(path, element, max_bytes, progress);
}

std::string read_file_characters(const std::string& path, const char* element, std::size_t max_bytes,
                                 const Progress* progress) {
  return read_whole<std::string>(path, element, max_bytes, progress);
}

} // namespace candela
