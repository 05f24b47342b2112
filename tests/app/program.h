#pragma once
// Runs the program as a process: exit codes, stdout, stderr and files.

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
  /// `arguments` are for a shell, in the scratch folder; `before` is a shell command that runs first.
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
