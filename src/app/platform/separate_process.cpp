#include "app/platform/separate_process.h"

#include "core/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace candela {

namespace {

/// The first byte of the child's answer is its exit code; the rest is the result or the error message.
std::string answer(const std::function<std::string()>& work) {
  auto of = [](ExitCode code, const std::string& text) {
    return fmt::format("{}{}", static_cast<char>(code), text);
  };
  try {
    return of(ExitCode::done, work());
  } catch (const Error& e) { return of(e.code(), e.what()); } catch (const std::bad_alloc&) {
    return of(ExitCode::limit, "memory: there is not enough: close other programs or take a smaller scene");
  }
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(descriptor, text.data() + done, text.size() - done);
    if (n < 0 && errno != EINTR) return; // the reader is gone
    if (n > 0) done += static_cast<std::size_t>(n);
  }
}

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> piece;
  for (ssize_t n = 1; n != 0;) {
    n = ::read(descriptor, piece.data(), piece.size());
    if (n > 0) text.append(piece.data(), static_cast<std::size_t>(n));
    if (n < 0 && errno != EINTR) break;
  }
  return text;
}

} // namespace

std::string run_separately(const std::function<std::string()>& work) {
  std::fflush(nullptr); // otherwise the child would write buffered output again
  int ends[2];
  if (::pipe(ends) != 0) throw Error(ExitCode::limit, fmt::format("process: {}", std::strerror(errno)));
  const pid_t child = ::fork();
  if (child < 0) throw Error(ExitCode::limit, fmt::format("process: {}", std::strerror(errno)));
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::close(ends[0]);
    write_all(ends[1], answer(work));
    std::fflush(nullptr);
    ::_exit(0);
  }
  ::close(ends[1]);
  // Ctrl+C reaches both: it ends the child, and this process must survive to clean up.
  auto* const before = std::signal(SIGINT, SIG_IGN);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  std::signal(SIGINT, before);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) throw Error(ExitCode::interrupted, "interrupted");
  if (!WIFEXITED(status) || text.empty())
    throw Error(ExitCode::limit,
                "memory: a part of the program was killed, as the system does when memory runs "
                "out: close other programs or take a smaller scene");
  const auto code = static_cast<ExitCode>(static_cast<unsigned char>(text.front()));
  if (code != ExitCode::done) throw Error(code, text.substr(1));
  return text.substr(1);
}

} // namespace candela
