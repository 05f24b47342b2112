#include "app/platform/streams.h"

#include "core/error.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace candela {

namespace {

bool pipe_was_ignored = false;

/// 0, or the errno of the failure.
int write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t done = ::write(descriptor, text.data(), text.size());
    if (done >= 0) {
      text.remove_prefix(static_cast<std::size_t>(done));
    } else if (errno == EAGAIN) { // another process made it non-blocking
      pollfd ready{descriptor, POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

Error stdout_error(int error) {
  return output_error("stdout", fmt::format("it cannot be written: {}", std::strerror(error)),
                      error == ENOSPC  ? "free some disk space"
                      : error == EBADF ? "leave it open, or send it to a file"
                                       : "check where it goes");
}

} // namespace

void prepare_streams() {
  for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0) // gets the lowest free descriptor, which is this one
      if (::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  pipe_was_ignored = std::signal(SIGPIPE, SIG_IGN) == SIG_IGN;
  std::signal(SIGXFSZ, SIG_IGN); // exceeding a file size limit is an error like a full disk
}

void check_stdout() {
  const int mode = ::fcntl(STDOUT_FILENO, F_GETFL);
  if (mode < 0 || (mode & O_ACCMODE) == O_RDONLY) throw stdout_error(EBADF);
}

void print_result(std::string_view text) {
  const int error = write_whole(STDOUT_FILENO, text);
  if (error == 0) return;
  if (error == EPIPE && !pipe_was_ignored) {
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
  }
  throw stdout_error(error);
}

void say_text(std::string_view text) {
  // Errors of stderr cannot be reported.
  if (write_whole(STDERR_FILENO, text) != 0) errno = 0;
}

} // namespace candela
