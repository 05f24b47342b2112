// Which side of a surface shines, of every shape, evenly and with a texture, seen directly and found by every
// strategy.

#include "render/render_testing.h"
#include "support/textures.h"

namespace candela::test {
namespace {

struct Lamp {
  const char* name;
  Shape shape;
  mat4 world_from_object;
  vec3 target, front, back; ///< both look at the target: the front from where the normal points to
};

std::vector<Lamp> lamps() {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{-1.5f, -1, 0}, {1.5f, -1, 0}, {0, 2, 0}};
  mesh->uvs = {{0, 0}, {1, 0}, {0.5f, 1}};
  mesh->triangles = {{0, 1, 2}};
  const mat4 one(1), flat = glm::scale(one, {1, 1.5f, 0.8f}), mirrored = glm::scale(one, {-1, 1, 1});
  const vec3 origin(0), up(0.2f, 0.3f, 3), down(0.2f, 0.3f, -3), inside(0.1f, 0.05f, 0.6f),
      side(3, 0.2f, 0.5f);
  CurvesShape tube;
  auto strands = std::make_shared<Strands>();
  strands->points = {{0, -2, 0}, {0, -1, 0}, {0, 0, 0}, {0.1f, 1, 0}, {0, 2, 0}};
  strands->counts = {5}, strands->widths = {1, 0.8f};
  tube.strands = strands;
  return {{"rectangle", RectangleShape{}, one, origin, up, down},
          {"mirrored rectangle", RectangleShape{}, mirrored, origin, up, down},
          {"plane", PlaneShape{}, one, origin, up, down},
          {"disc", DiscShape{}, one, origin, up, down},
          {"mirrored disc", DiscShape{}, mirrored, origin, up, down},
          {"ellipse", DiscShape{}, flat, origin, up, down},
          {"triangle", std::shared_ptr<const Mesh>(mesh), one, origin, up, down},
          {"sphere", SphereShape{}, one, {0, 0, -0.9f}, up, inside},
          {"mirrored sphere", SphereShape{}, mirrored, {0, 0, -0.9f}, up, inside},
          {"ellipsoid", SphereShape{}, flat, {0, 0, -0.7f}, up, inside},
          {"cube", CubeShape{}, one, {0, 0, -1}, up, inside},
          {"cylinder", CylinderShape{1, 1, true}, one, {-0.9f, 0, 0.5f}, side, inside},
          {"open cylinder", CylinderShape{1, 1, false}, one, {-0.9f, 0, 0.5f}, side, inside},
          {"cone", ConeShape{1, 1.5f, true}, one, {-0.4f, 0, 0.5f}, side, {0.1f, 0.05f, 0.5f}},
          {"torus", TorusShape{1, 0.5f}, one, {0.8f, 0, 0}, {3, 0.2f, 0.5f}, {1.1f, 0.1f, 0}},
          {"tube", tube, one, {0, 0.1f, 0}, up, down}};
}

enum class Look { at_lamp, at_receiver };

Document document_of(const Lamp& lamp, bool textured, bool two_sided, bool front, Look look) {
  SceneMaker s(8, 8, look == Look::at_lamp ? 4 : 32);
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", CheckerTexture{{4, 3, 1}, vec3(0.5f), 6}}));
  Material m;
  m.model = DiffuseMaterial{vec3(0)};
  m.emission = vec3(1);
  if (textured) m.emission.use.texture = 0;
  m.two_sided_emission = two_sided;
  s.document.scene.instances.push_back({"", lamp.shape, lamp.world_from_object, {s.material(m)}});
  const vec3 from = front ? lamp.front : lamp.back, d = lamp.target - from;
  if (look == Look::at_lamp) {
    s.camera(from, lamp.target, 4);
  } else { // at a receiver where the viewer was, which faces the lamp
    const vec3 n = glm::normalize(d), x = glm::normalize(glm::cross(n, vec3(0.1f, 0.9f, 0.3f)));
    const float half = 0.05f * glm::length(d);
    s.rectangle(from, half * x, half * glm::cross(n, x), s.diffuse(vec3(0.8f)));
    s.camera(from + 0.3f * d + 0.02f * glm::length(d) * x, from, 6);
  }
  s.document.settings.path.max_depth = look == Look::at_lamp ? 1 : 2;
  return s.document;
}

/// The mean of the picture. Scenes share what they can, for some of these shapes are large meshes.
RunningStatistics mean_of(Document d, std::shared_ptr<const RenderScene>& scene, LightSampling how) {
  static std::uint64_t salt = 0;
  d.settings.path.light_sampling = how;
  d.settings.sampler.seed = sampler_seed(++salt);
  scene = RenderScene::build(d, scene.get());
  Film film(d.settings.film.width, d.settings.film.height);
  std::atomic<bool> stop{false};
  render_pass(*scene, d, {0, static_cast<std::uint32_t>(d.settings.stop.spp)}, film, stop, {});
  return over_pixels(film, 1);
}

TEST(EmittingSidesStatistical, AreThoseThatTheMaterialSays) {
  for (const Lamp& lamp : lamps())
    for (bool front : {true, false}) {
      std::shared_ptr<const RenderScene> at_lamp, at_receiver;
      for (bool textured : {false, true})
        for (bool two_sided : {false, true}) {
          SCOPED_TRACE(testing::Message()
                       << lamp.name << (textured ? ", textured" : "") << (two_sided ? ", two-sided" : "")
                       << (front ? ", front" : ", back"));
          // A tube has no inside.
          const bool shines = front || two_sided || std::string_view(lamp.name) == "tube";
          const auto lit = mean_of(document_of(lamp, textured, two_sided, front, Look::at_lamp), at_lamp,
                                   LightSampling::mis);
          RunningStatistics by[3];
          for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis})
            by[static_cast<std::size_t>(how)] =
                mean_of(document_of(lamp, textured, two_sided, front, Look::at_receiver), at_receiver, how);
          if (!shines) {
            EXPECT_EQ(lit.mean(), 0);
            for (const RunningStatistics& one : by) EXPECT_EQ(one.mean(), 0);
            continue;
          }
          EXPECT_GT(lit.mean(), textured ? 0.4 : 0.99);
          EXPECT_GT(by[2].mean(), 5e-3);
          for (int i : {0, 1})
            EXPECT_GT(z_test(by[i], by[2], 1e-4 * by[2].mean()), sidak_threshold(2 * 7 * 16))
                << i << ": " << by[i].mean() << ", by MIS " << by[2].mean() << "; " << seed_note();
        }
    }
}

} // namespace
} // namespace candela::test
