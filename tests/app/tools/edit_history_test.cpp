// Steps of the history, their names, and its limits.

#include "app/tools/edit_history.h"

#include <gtest/gtest.h>

namespace candela {
namespace {

EditState fresh() {
  EditState state;
  Material red;
  red.name = "red";
  state.document.scene.materials = {red, Material{}};
  state.document.scene.lights.emplace_back();
  Instance ball;
  ball.name = "ball";
  ball.shape = SphereShape{};
  ball.materials = {0};
  state.document.scene.instances.push_back(ball);
  state.scene = std::make_shared<OpenScene>();
  return state;
}

struct History : ::testing::Test {
  EditHistory history;
  EditState state = fresh();

  History() { history.reset(state); }
  /// An edit of the panels, without a gesture.
  void observe() { history.observe(state, true, false); }
};

TEST_F(History, StepsThereAndBack) {
  EXPECT_FALSE(history.can_undo());
  const Document first = state.document;
  state.document.settings.path.max_depth = 5;
  observe();
  EXPECT_EQ(history.undo_name(), "path.max_depth");
  state.document.scene.materials[0].opacity = 0.7f;
  observe();
  EXPECT_EQ(history.undo_name(), "red: opacity");
  const Document last = state.document;
  history.undo();
  EXPECT_EQ(history.redo_name(), "red: opacity");
  EXPECT_EQ(history.undo().document, first);
  EXPECT_FALSE(history.can_undo());
  history.redo();
  EXPECT_EQ(history.redo().document, last);
  EXPECT_FALSE(history.can_redo());
}

TEST_F(History, AGestureIsOneStep) {
  const Document first = state.document;
  for (int i = 1; i <= 20; ++i) {
    state.document.scene.camera.position.x = static_cast<float>(i);
    history.observe(state, true, true);
    EXPECT_FALSE(history.can_undo());
    EXPECT_TRUE(history.pending());
  }
  history.observe(state, false, false);
  EXPECT_EQ(history.undo_name(), "Camera");
  EXPECT_EQ(history.undo().document, first);
  EXPECT_FALSE(history.can_undo());
}

TEST_F(History, AGestureThatEndsWhereItBeganIsNone) {
  state.document.settings.display.exposure = 3;
  history.observe(state, true, true);
  state.document.settings.display.exposure = 0;
  observe();
  EXPECT_FALSE(history.can_undo());
}

TEST_F(History, ANewEditDropsWhatWasUndone) {
  for (int seed : {1, 2, 3}) {
    state.document.settings.sampler.seed = seed;
    observe();
  }
  history.undo();
  state.document = history.undo().document;
  state.document.settings.sampler.seed = 9;
  observe();
  EXPECT_FALSE(history.can_redo());
  EXPECT_EQ(history.undo().document.settings.sampler.seed, 1);
}

TEST_F(History, TheWindowsSizeIsNoEdit) {
  state.document.settings.film.width = 1234;
  observe();
  EXPECT_FALSE(history.can_undo());
  EXPECT_FALSE(differs_from_file(state.document, fresh().document, true));
  state.fit_film = false;
  observe();
  EXPECT_TRUE(history.can_undo()) << "a size of one's own is";
  EXPECT_TRUE(differs_from_file(state.document, fresh().document, false));
}

TEST_F(History, LookingAroundIsNotWorthAFile) {
  const Document saved = state.document;
  state.document.scene.camera.position.x = 9;
  EXPECT_FALSE(differs_from_file(state.document, saved, true));
  state.document.scene.camera.vertical_fov = 0.2f;
  EXPECT_TRUE(differs_from_file(state.document, saved, true));
}

TEST_F(History, NamesSayWhatWasEdited) {
  const EditState before = fresh();
  auto name = [&](auto edit) {
    EditState after = before;
    edit(after);
    return edit_name(before, after);
  };
  EXPECT_EQ(name([](EditState& s) { s.document.scene.instances[0].world_from_object[3].x = 1; }),
            "ball: move");
  EXPECT_EQ(name([](EditState& s) { s.document.scene.instances[0].world_from_object[0].x = 2; }),
            "ball: transform");
  EXPECT_EQ(name([](EditState& s) { s.document.scene.lights[0].scale = 2; }), "Light 0: scale");
  EXPECT_EQ(name([](EditState& s) { s.document.scene.materials[1].opacity = 0.5f; }), "Material 1: opacity");
  EXPECT_EQ(name([](EditState& s) { s.document.scene.lights.clear(); }), "Remove Light");
  EXPECT_EQ(name([](EditState& s) {
              for (Material& m : s.document.scene.materials) m.opacity = 0.3f;
            }),
            "2 materials");
  EXPECT_EQ(name([](EditState& s) {
              s.scene = std::make_shared<OpenScene>();
              s.scene->path = "/tmp/box.json";
            }),
            "Open box.json");
}

TEST_F(History, IsBounded) {
  for (int seed = 1; seed <= 3000; ++seed) {
    state.document.settings.sampler.seed = seed;
    observe();
  }
  int steps = 0;
  while (history.can_undo()) history.undo(), ++steps;
  EXPECT_GT(steps, 100);
  EXPECT_LE(steps, 500);
  // Old scenes are dropped, because their meshes may be large.
  std::weak_ptr<OpenScene> first = state.scene;
  for (int i = 0; i < 3; ++i) {
    state.scene = std::make_shared<OpenScene>();
    observe();
  }
  EXPECT_TRUE(first.expired());
}

TEST_F(History, FindsTheNearestStepWithTheseInstances) {
  const std::vector<Instance> first = state.document.scene.instances;
  auto step = [&](auto edit) {
    edit(state.document.scene);
    observe();
    return state.document;
  };
  const Document lit = step([](SceneDesc& s) { s.lights[0].scale = 2; });
  const Document moved = step([](SceneDesc& s) { s.instances[0].world_from_object[3].x = 1; });
  EXPECT_EQ(history.undos_to(moved.scene.instances), 0);
  EXPECT_EQ(history.undos_to({}), std::nullopt);
  ASSERT_EQ(history.undos_to(first), 1) << "the light stays as it is";
  EXPECT_EQ(history.undo_by(1).document, lit);
  ASSERT_EQ(history.undos_to(moved.scene.instances), -1);
  EXPECT_EQ(history.undo_by(-1).document, moved);
  EXPECT_FALSE(history.can_redo());
}

} // namespace
} // namespace candela
