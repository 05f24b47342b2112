// Thumbnails of materials in the panels.

#include "app/harness.h"
#include "support/textures.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

namespace candela::test {
namespace {

struct ViewerThumbnailsUi : ::testing::Test {
  std::unique_ptr<ViewerHarness> hand;

  void open(Document document = test_document()) {
    hand = std::make_unique<ViewerHarness>(std::move(document));
    hand->wait_for_picture();
    hand->frame(5);
    EXPECT_EQ(thumbnails().begun(), 0u) << "the panel is closed";
    hand->unfold("panel.materials", "material.type");
    hand->reveal("list.materials");
    wait();
  }
  const MaterialThumbnails& thumbnails() const { return hand->viewer.thumbnails(); }
  std::shared_ptr<const std::vector<std::uint8_t>> picture(std::size_t material) const {
    return thumbnails().finished(hand->document().scene, material);
  }
  /// As wait_until(), but with few frames: on a busy machine these would take the time from the renders.
  template <class Condition>
  void wait_for(const char* what, Condition done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error(what);
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      hand->frame();
    }
  }
  void wait() {
    wait_for("there are no pictures", [&] {
      for (std::size_t i = 0; i < hand->document().scene.materials.size(); ++i)
        if (!picture(i)) return false;
      return !thumbnails().running();
    });
    hand->frame(3);
  }
  /// Mean of the screen's channels over a rectangle.
  vec3 mean(vec2 lo, vec2 hi) const {
    const std::vector<std::uint8_t> screen = hand->pixels();
    vec3 sum(0);
    int count = 0;
    for (int y = static_cast<int>(lo.y); y < static_cast<int>(hi.y); ++y)
      for (int x = static_cast<int>(lo.x); x < static_cast<int>(hi.x); ++x, ++count)
        for (int c = 0; c < 3; ++c)
          sum[c] += static_cast<float>(screen[static_cast<std::size_t>(4 * (y * hand->size().x + x) + c)]);
    return sum / static_cast<float>(count);
  }
};

TEST_F(ViewerThumbnailsUi, AppearBesideTheMaterials) {
  open();
  EXPECT_NE(*picture(1), *picture(2));
  EXPECT_EQ(picture(1)->size(), 64u * 64u * 4u);
  // The rows of the red and of the green material.
  hand->reveal("materials/2");
  for (const auto& [row, channel] : {std::pair("materials/1", 0), std::pair("materials/2", 1)}) {
    const auto item = hand->find(row);
    ASSERT_TRUE(item);
    const float side = item->hi.y - item->lo.y;
    const vec3 color = mean(item->lo + 0.4f * side, item->lo + 0.6f * side);
    EXPECT_GT(color[channel], 1.5f * color[1 - channel]) << row;
  }
  hand->screenshot("thumbnails");
}

TEST_F(ViewerThumbnailsUi, SayWhyTheyCannotBeMade) {
  HarnessOptions options;
  options.studio = "/nowhere/studio.json";
  hand = std::make_unique<ViewerHarness>(test_document(), options);
  hand->wait_for_picture();
  hand->unfold("panel.materials", "material.type");
  hand->reveal("list.materials");
  wait_for("nothing is said", [&] {
    return !thumbnails().problem(hand->document().scene, 1).empty() && !thumbnails().running() &&
           !thumbnails().waits();
  });
  hand->frame(3);
  EXPECT_NE(thumbnails().problem(hand->document().scene, 1).find("/nowhere/studio.json"), std::string::npos);
  ASSERT_GT(hand->viewer.state().thumbnails.problems.size(), 1u);
  EXPECT_EQ(hand->viewer.state().thumbnails.problems[1], thumbnails().problem(hand->document().scene, 1));
  const std::size_t begun = thumbnails().begun();
  hand->frame(20);
  EXPECT_EQ(thumbnails().begun(), begun) << "it is not tried again and again";
}

TEST_F(ViewerThumbnailsUi, AreMadeAgainAfterAnEditAndKeptAfterUndo) {
  open();
  const auto before = picture(0);
  const std::size_t begun = thumbnails().begun();
  hand->click("materials/0");
  hand->choose("material.type", "mirror");
  EXPECT_EQ(picture(0), nullptr) << "that of the mirror is not there yet";
  wait();
  EXPECT_NE(*picture(0), *before);
  EXPECT_GE(thumbnails().begun(), begun + 2) << "few samples, then all";
  EXPECT_LE(thumbnails().begun(), begun + 4);
  const std::size_t after = thumbnails().begun();
  hand->control(Key::z, false, 3);
  EXPECT_EQ(picture(0), before) << "the very same, from the cache";
  EXPECT_EQ(thumbnails().begun(), after);
}

TEST_F(ViewerThumbnailsUi, CostNothingWhileThePanelIsClosed) {
  open();
  hand->click("panel.materials");
  hand->frame(3);
  const std::size_t begun = thumbnails().begun();
  hand->send(
      DocumentEdited{[](Document& document) { document.scene.materials[1].model = MirrorMaterial(); }});
  hand->wait_for_picture();
  hand->frame(10);
  EXPECT_EQ(thumbnails().begun(), begun);
  EXPECT_EQ(picture(1), nullptr);
  EXPECT_FALSE(thumbnails().waits());
}

TEST_F(ViewerThumbnailsUi, EqualMaterialsShareOne) {
  Document document = test_document();
  document.scene.materials[2] = document.scene.materials[1];
  document.scene.materials[2].name = "another red";
  open(std::move(document));
  EXPECT_EQ(picture(1), picture(2));
}

TEST_F(ViewerThumbnailsUi, StandInTheListOfAChoice) {
  Document document = test_document();
  document.scene.materials[0].model = BlendMaterial{};
  open(std::move(document));
  hand->click("materials/0");
  hand->click("material.first");
  hand->frame(3);
  const auto item = hand->find("material.first/red");
  ASSERT_TRUE(item);
  const float side = item->hi.y - item->lo.y;
  const vec3 color = mean(item->lo + 0.4f * side, item->lo + 0.6f * side);
  EXPECT_GT(color.x, 1.5f * color.y);
  hand->screenshot("thumbnails_choice");
}

TEST_F(ViewerThumbnailsUi, AreBounded) {
  Document document = test_document();
  for (int i = 0; i < 200; ++i) {
    Material m;
    m.model = DiffuseMaterial{vec3(0.004f * static_cast<float>(i), 0.3f, 0.2f)};
    document.scene.materials.push_back(m);
  }
  hand = std::make_unique<ViewerHarness>(std::move(document));
  hand->unfold("panel.materials", "material.type");
  const vec2 list = hand->reveal("list.materials");
  for (int turn = 1; turn <= 6; ++turn) {
    hand->scroll(list, -2);
    wait_for("no more are made", [&] {
      return thumbnails().begun() >= static_cast<std::size_t>(5 * turn) && !thumbnails().running();
    });
    ASSERT_LE(thumbnails().kept(), 10u);
  }
  EXPECT_GT(thumbnails().kept(), 5u);
}

} // namespace
} // namespace candela::test
