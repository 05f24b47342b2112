#pragma once
// Scenes in Candela JSON, and the result of reading them.

#include "io/scene_files.h"

namespace candela::test {

struct CandelaJson : ::testing::Test {
  SceneFiles files;

  LoadedScene read(const std::string& json) {
    files.write("s.json", json);
    return files.read("s.json");
  }
  std::string error(const std::string& json, ExitCode code = ExitCode::bad_input) {
    files.write("s.json", json);
    return files.error("s.json", code);
  }
};

} // namespace candela::test
