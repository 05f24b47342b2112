// Path vertices: hits prepared for scattering.

#include "render/integrators/transport.h"
#include "render/render_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

TEST(Vertex, TheNormalIsBentOnlyWhereItLooksAway) {
  const vec3 wo(0, 0, 1);
  const vec3 towards = glm::normalize(vec3(1, 0, 0.2f)), away = glm::normalize(vec3(1, 0, -0.3f));
  EXPECT_EQ(visible_normal(towards, wo, 0.4f), towards);
  EXPECT_EQ(visible_normal(away, wo, -0.4f), away) << "seen from the inside it looks towards the viewer";
  for (float side : {0.4f, -0.4f}) {
    vec3 bent = visible_normal(side > 0 ? away : towards, wo, side);
    EXPECT_NEAR(glm::length(bent), 1, 1e-6f);
    EXPECT_GT(glm::dot(bent, wo) * side, 0);
    EXPECT_LT(std::abs(glm::dot(bent, wo)), 1e-3f) << "no further than needed";
    EXPECT_GT(bent.x, 0.99f) << "within the plane of both";
  }
}

TEST(VertexRender, SmoothSilhouettesAreNotBlack) {
  // A triangle whose vertices' normals all look away from the camera, as at the rim of a coarse smooth ball.
  SceneMaker s(8, 8, 16);
  Mesh mesh;
  mesh.positions = {{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}};
  mesh.normals = std::vector<vec3>(3, glm::normalize(vec3(1, 0, -0.2f)));
  mesh.triangles = {{0, 1, 2}};
  s.mesh(std::move(mesh), s.diffuse(vec3(0.5f)));
  s.constant_light(vec3(1));
  s.camera({0, 0, 5}, {0, 0, 0}, 20);
  Film film = render(s.document);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_GT(film.mean(x, y).g, 0.05f) << x << ' ' << y;
}

} // namespace
