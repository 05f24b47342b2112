#pragma once
// Shared by the tests of sessions: a small scene, waiting for its picture, and the expected picture.

#include "session/offline_render.h"
#include "session/render_session.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <vector>

namespace candela::test {

inline constexpr double kPatience = 120; ///< seconds before a wait counts as hanging

inline Document small_cornell(int spp = 4, int width = 61, int height = 43) {
  return cornell_flush(width, height, spp, true).document;
}

/// A scene whose samples take long for any film size: inside glass that no ray leaves, without Russian
/// roulette.
inline Document slow_document() {
  SceneMaker s(96, 96, 1);
  Material glass;
  glass.model = DielectricMaterial{2.5f};
  const int material = s.material(glass);
  s.document.scene.instances.push_back({"", CubeShape{}, mat4(1), {material}});
  s.camera({0, 0, 0}, {0.3f, 0.2f, 1}, 60);
  s.document.settings.path.rr = RussianRoulette::off;
  s.document.settings.path.max_depth = 1000000;
  return s.document;
}

inline std::vector<vec3> headless(const Document& document) {
  return render_document(document).film.image().pixels;
}

/// Submits the document and waits until it is finished; in a paused session, until its first pass is shown.
inline ::testing::AssertionResult shows(RenderSession& session, const Document& document) {
  session.submit(document);
  if (session.wait_finished(kPatience)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "it did not finish";
}

} // namespace candela::test
