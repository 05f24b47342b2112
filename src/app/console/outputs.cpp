#include "app/console/outputs.h"

#include "app/platform/streams.h"
#include "io/files/atomic_file.h"

#include <filesystem>
#include <map>
#include <new>

namespace candela {

namespace {

namespace fs = std::filesystem;

/// A key that is equal for all paths of one file, existing or not; empty for paths that are not files, or
/// unknown.
std::string identity(const std::string& path) {
  if (is_stream(path)) return {};
  std::error_code failed;
  const fs::path absolute = fs::absolute(path, failed);
  if (failed) return {};
  const fs::path whole = fs::weakly_canonical(absolute, failed);
  return failed ? std::string() : whole.string();
}

std::string named(const PlannedOutput& output) { return output.option + " " + output.path; }

} // namespace

void check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs) {
  std::map<std::string, std::string> read, written;
  for (const std::string& input : inputs) read.emplace(identity(input), input);
  for (const PlannedOutput& output : outputs) {
    check_writable(output.path);
    const std::string file = identity(output.path);
    if (file.empty()) continue;
    if (read.contains(file))
      throw usage_error(named(output), "it is a file that is read, and would be lost", "give another name");
    if (const auto [other, is_new] = written.emplace(file, named(output)); !is_new)
      throw usage_error(named(output), "it is the same file as " + other->second, "give each its own name");
  }
}

void OutputWriter::attempt(const std::string& path, const std::function<void()>& write) {
  auto failed = [this](ExitCode code, std::string_view what) {
    say("candela: {}\n", what);
    if (code_ == ExitCode::done) code_ = code;
  };
  try {
    write();
  } catch (const Error& e) { failed(e.code(), e.what()); } catch (const std::bad_alloc&) {
    failed(ExitCode::limit,
           fmt::format("{}: memory: there is not enough to write it: close other programs", path));
  }
}

} // namespace candela
