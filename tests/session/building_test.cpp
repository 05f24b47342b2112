// Geometry that takes long to build: its progress, and cancellation of outdated builds.

#include "session/session_testing.h"
#include "support/build_gate.h"
#include "support/materials.h"

#include <chrono>
#include <thread>

namespace candela {
namespace {

using test::BuildGate;
using test::headless;
using test::kPatience;
using test::shows;
using test::small_cornell;

Document small_document() {
  test::SceneMaker s(16, 12, 1);
  s.sphere(vec3(0), 1, s.diffuse(vec3(0.5f)));
  s.constant_light(vec3(1));
  s.camera({0, 0, 4}, vec3(0), 40);
  return s.document;
}

/// Waves of 2 * side^2 triangles.
Document large_document(unsigned side) {
  Mesh mesh;
  for (unsigned i = 0; i <= side; ++i)
    for (unsigned j = 0; j <= side; ++j) {
      const vec2 p(static_cast<float>(i) / static_cast<float>(side),
                   static_cast<float>(j) / static_cast<float>(side));
      mesh.positions.emplace_back(2.0f * p - 1.0f, 0.1f * std::sin(20 * p.x) * std::cos(30 * p.y));
    }
  for (unsigned i = 0; i < side; ++i)
    for (unsigned j = 0; j < side; ++j) {
      const unsigned a = i * (side + 1) + j, b = a + side + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  test::SceneMaker s(16, 12, 1);
  s.mesh(std::move(mesh), s.diffuse(vec3(0.5f)));
  s.constant_light(vec3(1));
  s.camera({0, 0, 4}, vec3(0), 40);
  return s.document;
}

template <class Condition>
bool wait_until(Condition condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::yield();
  }
  return true;
}

/// Waits until the last submitted document is being built.
bool wait_for_building(const RenderSession& session, std::uint64_t generation) {
  return wait_until([&] {
    const SessionStatus status = session.status();
    return status.generation == generation && status.phase == SessionPhase::building;
  });
}

TEST(SessionBuilding, ANewerDocumentEndsTheBuildingOfTheOneBefore) {
  BuildGate gate(false);
  RenderSession session({.on_build = gate.hook()});
  const Document small = small_document();
  session.submit(small);
  ASSERT_TRUE(session.wait_finished(kPatience));
  const auto built = session.built();
  gate.close();
  ASSERT_TRUE(wait_for_building(session, session.submit(large_document(20))));
  const std::uint64_t back = session.submit(small);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.status().builds_cancelled, 1u);
  EXPECT_EQ(session.latest()->generation, back);
  EXPECT_EQ(&session.built().scene->geometry(), &built.scene->geometry()) << "what was there was kept";
  EXPECT_EQ(session.status().error, "");
}

TEST(SessionBuilding, TheFirstOneMayBeOutOfDateToo) {
  BuildGate gate(true);
  RenderSession session({.on_build = gate.hook()});
  ASSERT_TRUE(wait_for_building(session, session.submit(large_document(20))));
  session.submit(small_document());
  ASSERT_TRUE(wait_until([&] { return session.status().builds_cancelled == 1; }));
  gate.open();
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.status().builds_cancelled, 1u);
  EXPECT_EQ(session.built().scene->geometry().world().triangles.size(), 0u);
}

// Otherwise a scene would never appear while the user flies.
TEST(SessionBuilding, AnotherCameraDoesNotCancelIt) {
  BuildGate gate(true);
  RenderSession session({.on_build = gate.hook()});
  Document large = large_document(20);
  ASSERT_TRUE(wait_for_building(session, session.submit(large)));
  large.scene.camera.position.z = 5;
  session.submit(large);
  gate.open();
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.status().builds_cancelled, 0u);
}

// A dragged object is shown at every position, and the final picture is the headless image.
TEST(SessionBuilding, WhatMovesIsShownSoonAndBuiltWellInTheEnd) {
  RenderSession session;
  Document large = large_document(150);
  large.settings.stop.spp = 3;
  ASSERT_TRUE(shows(session, large));
  EXPECT_EQ(session.built().scene->geometry().quality(), BuildQuality::high);
  session.pause(true); // nothing better comes until it continues
  std::shared_ptr<const Geometry::Object> object;
  for (int step = 0; step < 3; ++step) {
    large.scene.instances[0].world_from_object[3].x += 0.1f;
    ASSERT_TRUE(shows(session, large));
    const Geometry& moved = session.built().scene->geometry();
    EXPECT_EQ(moved.quality(), BuildQuality::fast);
    ASSERT_EQ(moved.objects().size(), 1u);
    if (!object) object = moved.objects()[0];
    EXPECT_EQ(moved.objects()[0], object) << "the mesh's tree is built once";
    EXPECT_NE(session.status().phase, SessionPhase::finished);
  }
  session.pause(false);
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_EQ(session.built().scene->geometry().quality(), BuildQuality::high);
  EXPECT_EQ(session.latest()->spp, 3);
  EXPECT_TRUE(session.latest()->linear == headless(large));
  EXPECT_EQ(session.status().builds_cancelled, 0u);
  EXPECT_EQ(session.status().restarts, 4u) << "building well is no edit";
}

// Moving the camera meanwhile neither loses the better geometry nor waits for it.
TEST(SessionBuilding, EditsWhileItIsBuiltWellEndInTheHeadlessImage) {
  RenderSession session;
  Document large = large_document(150);
  large.settings.stop.spp = 2;
  ASSERT_TRUE(shows(session, large));
  for (int step = 0; step < 40; ++step) {
    if (step % 8 == 0) large.scene.instances[0].world_from_object[3].y += 0.02f;
    large.scene.camera.position.x += 0.01f;
    session.submit(large);
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * (step % 8)));
  }
  ASSERT_TRUE(session.wait_finished(kPatience));
  EXPECT_TRUE(session.latest()->linear == headless(large));
}

// Undo while the edit's better geometry is being built: the fast geometry of the previous state must be
// improved, too.
TEST(SessionBuilding, AnUndoneMoveEndsInTheHeadlessImage) {
  RenderSession session;
  const Document large = large_document(150);
  ASSERT_TRUE(shows(session, large));
  Document moved = large;
  moved.scene.instances[0].world_from_object[3].y += 0.2f;
  session.submit(moved);
  ASSERT_TRUE(shows(session, large));
  EXPECT_TRUE(session.latest()->linear == headless(large));
}

TEST(SessionBuilding, WhatIsExpectedToMoveIsMadeReady) {
  RenderSession session;
  Document large = large_document(150);
  ASSERT_TRUE(shows(session, large));
  session.expect_moves();
  session.expect_moves(); // as when the selection changes
  large.scene.instances[0].world_from_object[3].x += 0.1f;
  ASSERT_TRUE(shows(session, large));
  EXPECT_TRUE(session.latest()->linear == headless(large));
}

TEST(SessionBuilding, ShareGrows) {
  RenderSession session;
  const std::uint64_t generation = session.submit(large_document(400));
  double last = 0;
  int steps = 0;
  ASSERT_TRUE(wait_until([&] {
    const SessionStatus status = session.status();
    if (status.phase != SessionPhase::building || status.generation != generation) return status.spp > 0;
    EXPECT_GE(status.built, last);
    EXPECT_LE(status.built, 1);
    steps += status.built > last;
    last = status.built;
    return false;
  }));
  EXPECT_GT(steps, 1);
}

// Flying through a scene builds no geometry.
TEST(SessionBuilding, ACameraMoveBuildsNothing) {
  int builds = 0; // written by the render thread, read while it rests
  RenderSession session({.on_build = [&](const Progress&) { ++builds; }});
  Document d = small_cornell(1);
  ASSERT_TRUE(shows(session, d));
  const auto first = session.built().scene;
  for (int step = 0; step < 4; ++step) {
    d.scene.camera.position.x += 2;
    ASSERT_TRUE(shows(session, d));
    const auto moved = session.built().scene;
    EXPECT_EQ(moved->shared_geometry(), first->shared_geometry());
    EXPECT_EQ(moved->shared_materials(), first->shared_materials());
    EXPECT_EQ(moved->shared_lights(), first->shared_lights());
  }
  EXPECT_EQ(builds, 1);
  test::color(d.scene.materials[0], "diffuse") *= 0.5f;
  ASSERT_TRUE(shows(session, d));
  EXPECT_NE(session.built().scene->shared_materials(), first->shared_materials());
  EXPECT_EQ(session.built().scene->shared_lights(), first->shared_lights());
  EXPECT_EQ(session.built().scene->lights().data(), first->lights().data());
  EXPECT_EQ(builds, 1);
  EXPECT_EQ(session.latest()->linear, headless(d));
}

TEST(SessionBuilding, WhoLeavesDoesNotWaitForIt) {
  BuildGate gate(true);
  auto session = std::make_unique<RenderSession>(SessionOptions{.on_build = gate.hook()});
  ASSERT_TRUE(wait_for_building(*session, session->submit(large_document(20))));
  session.reset(); // joins; under the sanitizers nothing is left behind
}

} // namespace
} // namespace candela
