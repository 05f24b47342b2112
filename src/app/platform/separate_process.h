#pragma once
// Work in a process of its own, whose memory is freed when it ends.

#include <functional>
#include <string>

namespace candela {

/// Runs `work` in a child of this process, which must not have started threads, and returns its text.
/// Rethrows its exceptions; throws Error with ExitCode::limit if the system killed it, as it does when memory
/// runs out, and with ExitCode::interrupted if the user did.
std::string run_separately(const std::function<std::string()>& work);

} // namespace candela
