// A scene in motion, at an instant, is the same scene frozen there; and what moves is relative.

#include "render/camera/pixel_rays.h"
#include "render/motion_testing.h"

namespace {

using namespace candela;
using namespace candela::test;

/// Shapes of all kinds that move in all ways, textures among them, under a lamp and a sky.
SceneMaker busy_scene() {
  SceneMaker s(40, 30, 8);
  s.camera({0.5f, 2, 6}, {0, 0.3f, 0}, 40);
  s.constant_light(vec3(0.4f));
  const int grey = s.diffuse(vec3(0.6f)), red = s.diffuse({0.8f, 0.2f, 0.1f}),
            lamp = s.diffuse(vec3(0), vec3(9));
  const int mirror = s.material(lossless("mirror"));
  s.document.scene.textures.push_back(std::make_shared<const Texture>(Texture{"tiles", CheckerTexture{}}));
  Material tiles = s.document.scene.materials[static_cast<std::size_t>(grey)];
  use_of(tiles).texture = 0;
  const int tiled = s.material(tiles);
  use_of(tiles).mapping = TextureMapping::triplanar;
  const int projected = s.material(tiles);
  s.rectangle({0, -1, 0}, {5, 0, 0}, {0, 0, -5}, tiled);
  s.rectangle({0, 4, 0}, {1, 0, 0}, {0, 0, 1}, lamp);
  auto& instances = s.document.scene.instances;
  auto add = [&](Shape shape, vec3 at, int material, const Motion& motion) {
    mat4 m = glm::rotate(glm::translate(mat4(1), at), 0.7f, vec3(1, 2, 0.5f));
    instances.push_back({"", std::move(shape), glm::scale(m, vec3(0.5f)), {material}, motion});
  };
  Motion grow = rotation(1.5f, {0, 1, 1}, {0.3f, 0, 0});
  grow.scale = {1.4f, 0.8f, 1};
  grow.translate = {0.2f, 0.1f, 0};
  add(SphereShape{}, {-1.5f, 0, 0}, tiled, translation({0.6f, 0.5f, 0}));
  add(CubeShape{}, {0, 0, 0}, projected, rotation(4, {1, 0, 1}));
  add(TorusShape{}, {1.5f, 0, 0}, red, grow);
  add(DiscShape{}, {0, 1, -1}, tiled, rotation(2, {1, 0, 0}, {0, 1, 0}));
  add(RectangleShape{}, {-1, 1, -1}, mirror, translation({0.4f, 0, 0.5f}));
  add(std::make_shared<const Mesh>(deforming_sheet(10)), {1, 1, -1}, tiled, {});
  add(std::make_shared<const Mesh>(deforming_sheet(7)), {-0.3f, 0.8f, 1}, red, rotation(1, {0, 0, 1}));
  instances.back().world_from_object =
      glm::scale(instances.back().world_from_object, vec3(-0.6f, 0.6f, 0.6f));
  return s;
}

/// Share of pixels that differ by more than rounding: at edges single samples may fall otherwise.
double share_of_differing_pixels(const Film& a, const Film& b, float tolerance) {
  int differ = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const vec3 p = a.mean(x, y), q = b.mean(x, y);
      differ += max_component(glm::abs(p - q) / (glm::max(p, q) + 0.1f)) > tolerance ? 1 : 0;
    }
  return static_cast<double>(differ) / (a.width() * a.height());
}

void expect_alike(const Document& a, const Document& b, double share) {
  EXPECT_LE(share_of_differing_pixels(render(a), render(b), 2e-3f), share) << seed_note();
}

TEST(MotionFrozenRender, AnInstantIsTheSceneFrozenThere) {
  for (float time : {0.0f, 0.37f, 1.0f})
    for (const char* settings :
         {"view=normal", "view=geometric_normal", "view=depth", "view=uv", "view=albedo", "integrator=path",
          "integrator=whitted", "integrator=ao", "path.smooth_terminator=true"}) {
      SCOPED_TRACE(testing::Message() << settings << " at " << time);
      SceneMaker s = busy_scene();
      apply_setting(s.document, settings);
      s.document.settings.sampler.seed = sampler_seed(1);
      open_shutter(s.document, time, time);
      expect_alike(s.document, frozen(s.document, time), 0.01);
    }
}

/// Else the test above would say nothing.
TEST(MotionFrozenRender, AnotherInstantIsAnotherPicture) {
  SceneMaker s = busy_scene();
  open_shutter(s.document, 0.4f, 0.4f);
  for (const char* settings : {"view=normal", "integrator=path"}) {
    apply_setting(s.document, settings);
    EXPECT_GT(share_of_differing_pixels(render(s.document), render(frozen(s.document, 0)), 2e-3f), 0.2);
  }
}

/// An open shutter shows the mean over the times: against many frozen instants, by blocks of pixels.
TEST(MotionFrozenRender, AnOpenShutterIsTheMeanOfItsInstants) {
  constexpr int kInstants = 48;
  SceneMaker s = busy_scene();
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.path.clamp = 0;
  open_shutter(s.document, 0, 1);
  s.document.settings.stop.spp = 384;
  s.document.settings.sampler.seed = sampler_seed(7);
  const Film blurred = render(s.document);
  s.document.settings.stop.spp = 8;
  std::vector<Film> instants;
  for (int i = 0; i < kInstants; ++i) {
    const float time = (static_cast<float>(i) + 0.5f) / kInstants;
    s.document.settings.sampler.seed = sampler_seed(static_cast<std::uint64_t>(100 + i));
    open_shutter(s.document, time, time);
    instants.push_back(render(s.document));
  }
  // Midpoints are off by little: what crosses a block of 10 pixels does so over several instants.
  int blocks = 0, far = 0;
  for (int by = 0; by < 30; by += 10)
    for (int bx = 0; bx < 40; bx += 10) {
      double a = 0, b = 0, variance = 0;
      for (int y = by; y < by + 10; ++y)
        for (int x = bx; x < bx + 10; ++x) {
          a += static_cast<double>(luminance(blurred.mean(x, y))) / 100;
          variance += static_cast<double>(luminance(blurred.variance_of_mean(x, y))) / 1e4;
          for (const Film& f : instants) {
            b += static_cast<double>(luminance(f.mean(x, y))) / 100 / kInstants;
            variance +=
                static_cast<double>(luminance(f.variance_of_mean(x, y))) / 1e4 / (kInstants * kInstants);
          }
        }
      ++blocks;
      far += std::abs(a - b) > 6 * std::sqrt(variance) + 0.01 * a ? 1 : 0;
    }
  EXPECT_EQ(blocks, 12);
  EXPECT_EQ(far, 0) << seed_note();
}

/// The camera's way is the opposite way of everything else.
TEST(MotionFrozenRender, ACameraThatMovesSeesWhatMovesTheOtherWay) {
  const vec3 way(0.7f, 0.2f, -0.4f);
  SceneMaker s(40, 30, 32);
  s.camera({0.5f, 2, 6}, {0, 0.3f, 0}, 40);
  s.constant_light(vec3(1));
  s.sphere({0, 0.5f, 0}, 0.8f, s.diffuse({0.8f, 0.4f, 0.2f}));
  s.rectangle({0, -0.5f, 0}, {2, 0, 0}, {0, 0, -2}, s.diffuse(vec3(0.5f)));
  s.document.settings.sampler.seed = sampler_seed(2);
  open_shutter(s.document, 0, 1);
  for (const char* model : {"camera.lens=thin", "camera.aperture_radius=0.1",
                            "camera.projection=orthographic", "camera.projection=spherical"}) {
    SCOPED_TRACE(model);
    Document moving_camera = s.document;
    apply_setting(moving_camera, model);
    Document moving_objects = moving_camera;
    moving_camera.scene.camera.motion_position = moving_camera.scene.camera.motion_target = way;
    for (Instance& instance : moving_objects.scene.instances) instance.motion = translation(-way);
    expect_alike(moving_camera, moving_objects, 0.01);
    EXPECT_GT(share_of_differing_pixels(render(moving_camera), render(s.document), 2e-3f), 0.1);
  }
}

TEST(MotionFrozenRender, ACameraAtAnInstantIsOneThatStandsThere) {
  SceneMaker s = busy_scene();
  Camera& camera = s.document.scene.camera;
  camera.motion_position = {1, -0.5f, -1}, camera.motion_target = {-0.5f, 0.4f, 0.3f};
  camera.motion_up = {0.3f, 0, 0}, camera.motion_fov = radians(15.0f);
  for (Lens lens : {Lens::thin, Lens::double_gauss})
    for (float aperture : {0.0f, 0.05f}) {
      camera.lens = lens, camera.aperture_radius = aperture, camera.focus_distance = 5;
      open_shutter(s.document, 1, 1);
      Document there = s.document;
      there.scene.camera = camera_at_end(camera);
      Camera& c = there.scene.camera;
      c.motion_position = c.motion_target = c.motion_up = vec3(0), c.motion_fov = 0;
      expect_alike(s.document, there, 0.01);
    }
}

TEST(MotionFrozen, RaysOfASampleHaveOneTimeOfTheShutter) {
  SceneMaker s(16, 16, 1);
  open_shutter(s.document, 0.25f, 0.75f);
  const PixelRays rays(s.document);
  Sampler sampler = PixelRays::sampler(s.document.settings.sampler);
  std::array<int, 16> strata{};
  for (std::uint32_t i = 0; i < 16; ++i) {
    const auto start = rays.start({3, 4}, i, sampler);
    ASSERT_TRUE(start);
    ASSERT_GE(start->ray.time, 0.25f);
    ASSERT_LT(start->ray.time, 0.75f);
    ++strata[static_cast<std::size_t>((start->ray.time - 0.25f) * 32)];
  }
  for (int count : strata) EXPECT_EQ(count, 1); // stratified
}

TEST(MotionFrozenRender, SamplesCanBeReplayedAndDoNotDependOnThreads) {
  SceneMaker s = busy_scene();
  open_shutter(s.document, 0, 1);
  s.document.settings.stop.spp = 2;
  PassOptions one, five;
  one.threads = 1, five.threads = 5;
  const Film a = render(s.document, one), b = render(s.document, five);
  const auto scene = RenderScene::build(s.document);
  for (int y = 0; y < a.height(); y += 3)
    for (int x = 0; x < a.width(); ++x) {
      ASSERT_EQ(a.mean(x, y), b.mean(x, y));
      const uvec2 pixel(x, y);
      const vec3 first = replay_sample(*scene, s.document, pixel, 0),
                 second = replay_sample(*scene, s.document, pixel, 1);
      ASSERT_LT(max_component(glm::abs(a.mean(x, y) - 0.5f * (first + second))),
                1e-5f + 1e-5f * max_component(first + second));
    }
}

/// Emitters that move are not sampled as lights: all strategies find them, and as much of them as of one
/// frozen at the time, which is sampled.
TEST(MotionFrozenRender, AnEmitterThatMovesLightsAsMuchUnderEveryStrategy) {
  SceneMaker s(16, 12, 512);
  look_down(s, 3, 1);
  s.rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, s.diffuse(vec3(0.8f)));
  s.rectangle({-1, 0, 2}, {0, 1, 0}, {1, 0, 0}, s.diffuse(vec3(0), vec3(5)));
  s.document.scene.instances[1].motion = translation({2, 0, 0});
  s.document.settings.sampler.type = SamplerType::independent;
  s.document.settings.path.max_depth = 2;
  struct Mean {
    double value = 0, variance = 0;
  };
  auto mean = [&](Document document, LightSampling how, std::uint64_t salt) {
    document.settings.path.light_sampling = how;
    document.settings.sampler.seed = sampler_seed(salt);
    const Film film = render(document);
    const double n = film.width() * film.height();
    Mean m;
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        m.value += static_cast<double>(film.mean(x, y).x) / n;
        m.variance += static_cast<double>(film.variance_of_mean(x, y).x) / (n * n);
      }
    return m;
  };
  open_shutter(s.document, 0.3f, 0.3f);
  const Document still = frozen(s.document, 0.3f);
  EXPECT_TRUE(RenderScene::build(s.document)->lights().empty());
  EXPECT_EQ(RenderScene::build(still)->lights().size(), 1u);
  const Mean sampled = mean(still, LightSampling::nee, 1);
  EXPECT_GT(sampled.value, 0.1);
  std::uint64_t salt = 10;
  for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis}) {
    const Mean found = mean(s.document, how, salt++);
    EXPECT_LT(std::sqrt(found.variance), 0.01 * sampled.value) << "too few samples to tell";
    const double z = (found.value - sampled.value) / std::sqrt(found.variance + sampled.variance);
    EXPECT_GT(normal_p_value(z), sidak_threshold(3)) << seed_note();
  }
}

} // namespace
