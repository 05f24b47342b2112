#include "core/error.h"
#include "io/files/text_file.h"
#include "io/scene_formats.h"
#include "io/scene_reader.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace candela {
namespace {

TEST(SceneFormats, HaveEndingsOfTheirOwn) {
  std::set<std::string_view> endings{kJobEnding, ".png", ".exr"};
  for (const SceneFormat& format : scene_formats()) {
    EXPECT_TRUE(endings.insert(format.ending).second) << format.ending << " is taken";
    EXPECT_EQ(lower_ending("folder.x/A" + std::string(format.ending)), format.ending);
    EXPECT_EQ(scene_format("folder.x/A" + std::string(format.ending)), &format);
    EXPECT_NE(scene_endings(", ").find(format.ending), std::string::npos);
    EXPECT_NE(format.read, nullptr);
  }
  EXPECT_EQ(scene_format("a.JSON"), scene_format("a.json"));
  EXPECT_EQ(scene_format("a.mtl"), nullptr);
  EXPECT_EQ(scene_format("json"), nullptr);
}

TEST(SceneFormats, AreNamedWhereNoneFits) {
  test::ScratchFolder folder;
  const std::string path = folder / "a.blend";
  std::ofstream(path) << "BLENDER";
  try {
    read_scene(path);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const SceneFormat& format : scene_formats())
      EXPECT_NE(text.find(format.ending), std::string::npos) << text;
  }
}

} // namespace
} // namespace candela
