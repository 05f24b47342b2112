#pragma once
// Scene files written by a test, and the result of reading them.

#include "io/scene_reader.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace candela::test {

class SceneFiles : public ScratchFolder {
public:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(*this / name).parent_path());
    write_text(*this / name, text);
  }

  LoadedScene read(const std::string& name, const ReadOptions& options = {}) const {
    return read_scene(*this / name, options);
  }

  /// The message of the error that reading `name` throws, without this folder's name; it must have the code.
  std::string error(const std::string& name, ExitCode code = ExitCode::bad_input,
                    const ReadOptions& options = {}) const {
    try {
      read(name, options);
    } catch (const Error& e) {
      EXPECT_EQ(static_cast<int>(e.code()), static_cast<int>(code)) << e.what();
      return without_folder(e.what());
    }
    ADD_FAILURE() << name << " was read without an error";
    return "";
  }

  std::string without_folder(std::string text) const {
    std::string folder = path() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
      text.erase(at, folder.size());
    return text;
  }

  /// The warnings as "count x text".
  std::vector<std::string> warnings(const LoadedScene& scene) const {
    std::vector<std::string> out;
    for (const Warning& w : scene.warnings)
      out.push_back(std::to_string(w.count) + " x " + without_folder(w.text));
    return out;
  }
};

/// Whether `text` begins with `start` and contains each of the other parts.
inline ::testing::AssertionResult says(const std::string& text, const std::string& start,
                                       std::initializer_list<const char*> parts = {}) {
  if (!text.starts_with(start))
    return ::testing::AssertionFailure() << "'" << text << "' does not begin with '" << start << "'";
  for (const char* part : parts)
    if (text.find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "'" << text << "' does not contain '" << part << "'";
  return ::testing::AssertionSuccess();
}

/// The mesh of an instance.
inline const Mesh& mesh_of(const LoadedScene& scene, std::size_t instance = 0) {
  return *std::get<std::shared_ptr<const Mesh>>(scene.document.scene.instances.at(instance).shape);
}

/// A PNG of 2x1 texels: red, green.
inline std::string tiny_png() {
  return std::string(
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00"
      "\x00\x01\x08\x02\x00\x00\x00\x7b\x40\xe8\xdd\x00\x00\x00\x0f\x49\x44\x41\x54\x78\xda\x63"
      "\xf8\xcf\xc0\xc0\xf0\x9f\x01\x00\x07\xff\x01\xff\xb8\x04\x35\xe0\x00\x00\x00\x00\x49\x45"
      "\x4e\x44\xae\x42\x60\x82",
      72);
}

} // namespace candela::test
