// Edits, opening scenes and closing are handled during any other work. A guard with a generous limit ends the
// test program if one of them hangs.

#include "app/harness.h"
#include "io/candela/candela_json.h"
#include "support/build_gate.h"

#include <fmt/format.h>

#include <condition_variable>
#include <fstream>

namespace candela::test {
namespace {

namespace fs = std::filesystem;

/// Ends the program after a time that suffices on any machine.
class HangGuard {
public:
  explicit HangGuard(const char* what)
      : thread_([this, what] {
          std::unique_lock lock(mutex_);
          if (done_.wait_for(lock, std::chrono::seconds(120), [this] { return is_done_; })) return;
          fmt::print(stderr, "{} hangs\n", what);
          std::abort();
        }) {}
  ~HangGuard() {
    {
      std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    thread_.join();
  }

private:
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_;
};

/// The camera is inside a cube of lossless glass: most of its paths are totally reflected for ever.
Document inside_glass() {
  Document document;
  Material glass;
  glass.model = DielectricMaterial();
  document.scene.materials.push_back(glass);
  document.scene.instances.push_back({"cube", CubeShape{}, mat4(1), {0}});
  LightDesc sky;
  sky.model = ConstantLightModel{};
  document.scene.lights.push_back(sky);
  document.scene.camera.position = vec3(0);
  document.scene.camera.target = vec3(1);
  document.scene.camera.vertical_fov = radians(20.0f);
  document.settings.film.width = 320;
  document.settings.film.height = 200;
  return document; // never finished by itself
}

bool shows_the_newest(const ViewerHarness& hand) {
  const SessionStatus status = hand.viewer.session().status();
  return hand.state().picture && status.generation == status.submitted &&
         hand.state().picture->frame->generation >= status.restarting;
}

void close(ViewerHarness& hand) {
  hand.send(CloseRequested{});
  hand.frame();
  EXPECT_TRUE(hand.viewer.wants_close());
}

TEST(ViewerClosingUi, PathsThatAreReflectedForEverKeepNobodyWaiting) {
  const HangGuard guard("a camera inside lossless glass");
  ScratchFolder folder;
  const std::string room = folder / "room.json", glass = folder / "glass.json";
  write_candela_json(test_document(), room);
  write_candela_json(inside_glass(), glass);
  ViewerHarness hand(inside_glass());
  for (int i = 0; i < 5; ++i) {
    hand.wait_until("the edit is shown", [&] { return shows_the_newest(hand); });
    hand.viewer.handle(DocumentEdited{[](Document& d) { d.scene.camera.position.x += 0.01f; }});
    hand.frame();
  }
  for (const std::string& path : {room, glass}) {
    hand.send(FilesDropped{{path}});
    hand.wait_until("the scene is open", [&] { return hand.state().scene_path == path; });
    hand.frame();
    hand.wait_until("it is shown", [&] { return shows_the_newest(hand); });
    EXPECT_EQ(hand.state().picture_of, "");
  }
  hand.key(Key::c); // and twice as much of it
  hand.wait_until("it is compared", [&] { return hand.state().compare.active; });
  hand.frame(5);
  close(hand);
}

TEST(ViewerClosingUi, WhateverIsUnderWay) {
  ScratchFolder folder;
  const std::string large = folder / "large.obj";
  {
    std::ofstream out(large);
    out << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 1000000; ++i) out << "f 1 2 3\n";
  }
  Document endless = test_document();
  endless.settings.stop.spp = 0;
  auto closes = [&](const char* what, const Document& document, auto begin) {
    SCOPED_TRACE(what);
    const HangGuard guard(what);
    ViewerHarness hand(document, {.screenshot_folder = folder.path()});
    hand.wait_until("there is a picture", [&] { return hand.state().picture != nullptr; });
    begin(hand);
    close(hand);
  };
  closes("reading", endless, [&](ViewerHarness& hand) {
    hand.send(FilesDropped{{large}});
    hand.wait_until("it reads", [&] { return hand.state().loaded > 0.02; });
  });
  closes("rendering", endless, [](ViewerHarness&) {});
  Document denoised = endless;
  denoised.settings.display.denoise = true;
  closes("denoising", denoised, [](ViewerHarness& hand) {
    hand.wait_until("there is something to denoise", [&] { return hand.state().status.spp > 1; });
  });
  closes("comparing, with a reference", endless, [](ViewerHarness& hand) {
    hand.key(Key::c);
    hand.frame(3);
    hand.click("compare.render_reference");
    hand.frame(3);
  });
  closes("a lesson", endless, [](ViewerHarness& hand) {
    hand.key(Key::f2);
    hand.frame(3);
  });
  closes("saving", endless, [](ViewerHarness& hand) {
    for (int i = 0; i < 3; ++i) hand.key(Key::p);
  });
  for (int i = 1; i <= 3; ++i) // the requested files are complete
    for (const char* ending : {"png", "exr"})
      EXPECT_EQ(read_image(folder / fmt::format("candela-{:04}.{}", i, ending)).width, 64);
}

TEST(ViewerClosingUi, WhileGeometryIsBuilt) {
  const HangGuard guard("building");
  BuildGate gate(true);
  ViewerHarness hand(test_document(), {.on_build = gate.hook()});
  hand.wait_until("it is being built", [&] { return hand.state().status.phase == SessionPhase::building; });
  close(hand);
}

} // namespace
} // namespace candela::test
