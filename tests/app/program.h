#pragma once
// The program as its users start it: exit codes, what goes to stdout and stderr, and the files that it
// leaves.

#include "support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <sys/wait.h>

namespace candela::test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

class ProgramTest : public testing::Test {
protected:
  ScratchFolder scratch;
  std::string scene = std::string(CANDELA_TEST_SOURCE_DIR) + "/scenes/cornell_box.json";

  std::string path(const std::string& name) { return scratch / name; }
  std::string text(const std::string& name) { return read_text(path(name)); }
  /// `arguments` as for a shell, run in the scratch folder; `before` is what the shell does first.
  Outcome run(const std::string& arguments, const std::string& environment = "",
              const std::string& before = "true", const std::string& streams = ">out.txt 2>err.txt") {
    for (const char* name : {"out.txt", "err.txt"}) std::filesystem::remove(path(name));
    const std::string command = fmt::format("cd '{}' && {} && {} '{}' {} {}", scratch.path(), before,
                                            environment, CANDELA_PROGRAM, arguments, streams);
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("out.txt"), text("err.txt")};
  }
};

} // namespace candela::test
