#pragma once
// The standard streams: results go to stdout and must not be lost, messages go to stderr.

#include <fmt/format.h>

#include <string_view>

namespace candela {

/// Before anything else in main(). A standard stream that is closed gets a stand-in that cannot be read from
/// or written to, or the next file that is opened would become it; SIGPIPE and SIGXFSZ no longer end the
/// program, for a picture that is being rendered is more important than the reader of its progress.
void prepare_streams();

/// An output_error where stdout cannot be written to, as far as that can be known beforehand.
void check_stdout();

/// Writes results to stdout; output_error where they do not get there. Where the reader of a pipe is gone, it
/// ends the program by SIGPIPE, as other programs are, unless the parent process ignores that signal.
void print_result(std::string_view text);

/// Writes to stderr; a closed or broken stream is ignored.
void say_text(std::string_view text);
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  say_text(fmt::format(format, std::forward<T>(values)...));
}

} // namespace candela
