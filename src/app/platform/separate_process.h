#pragma once
// Work in a process of its own: its memory is freed when it ends.

#include <functional>
#include <string>

namespace candela {

/// Runs `work` in a child of this process, which must not have started threads, and returns the text that it
/// returns. What it throws is thrown here; Error (ExitCode::limit) where the system killed it, as it does
/// when memory runs out, and Error (ExitCode::interrupted) where the user did.
std::string run_separately(const std::function<std::string()>& work);

} // namespace candela
