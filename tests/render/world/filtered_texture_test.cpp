// Textures that are looked up over the footprints of rays.

#include "render/camera/camera_model.h"
#include "render/camera/camera_view.h"
#include "render/film/replay.h"
#include "render/render_testing.h"
#include "render/world/texture_point.h"
#include "support/textures.h"

namespace candela::test {
namespace {

std::shared_ptr<const Texture> checker() {
  return std::make_shared<const Texture>(Texture{"", CheckerTexture{vec3(0.9f), vec3(0.1f), 4}});
}
std::shared_ptr<const Texture> noise_picture() {
  std::vector<std::uint8_t> values;
  for (std::uint64_t i = 0; i < 32 * 32 * 3; ++i)
    values.push_back(static_cast<std::uint8_t>(hash_combine(7, i)));
  return picture_texture(32, 32, values);
}

enum class Part { reflectance, emission, opacity };

/// A floor up to the horizon, which repeats the texture at every unit.
Document plane_scene(std::shared_ptr<const Texture> texture, TextureFilter filter, Part part) {
  SceneMaker s(24, 24, 16);
  s.document.scene.textures.push_back(std::move(texture));
  TextureUse use;
  use.texture = 0;
  use.filter = filter;
  Material m;
  m.model = DiffuseMaterial{vec3(part == Part::reflectance ? 1.0f : 0.0f)};
  if (part == Part::reflectance) {
    use_of(m) = use;
    s.constant_light(vec3(1));
  } else {
    m.emission = vec3(1);
    (part == Part::emission ? m.emission.use : m.opacity.use) = use;
    m.two_sided_emission = true;
  }
  s.document.scene.instances.push_back({"", PlaneShape{}, mat4(1), {s.material(m)}});
  s.camera({0, 0, 6}, {40, 10, 0}, 20, {0, 0, 1});
  return s.document;
}

TEST(FilteredTexture, FootprintIsWhatAPixelOfTheCameraCovers) {
  SceneMaker s(64, 48, 1);
  s.camera({0, -4, 2}, {0.3f, 0, 0}, 60, {0, 0.2f, 1});
  Material m;
  s.document.scene.instances.push_back({"", PlaneShape{}, mat4(1), {s.material(m)}});
  for (bool parallel : {false, true}) {
    if (parallel) {
      s.document.scene.camera.projection = Projection::orthographic;
      s.document.scene.camera.orthographic_height = 3;
    }
    const auto scene = RenderScene::build(s.document);
    const Geometry& g = scene->geometry();
    const CameraView view(s.document.scene.camera, 64, 48);
    const auto camera = make_camera(s.document.scene.camera, 64, 48);
    auto through = [&](vec2 film) { return camera->ray(film, vec2(0))->ray; };
    auto uv = [&](vec2 film) {
      const Ray ray = through(film);
      return g.uv(ray, *g.accel().intersect(ray));
    };
    for (vec2 film : {vec2(32, 24), vec2(2, 46), vec2(60, 40), vec2(10, 20)}) {
      const Ray ray = through(film);
      const ConeOfRay cone{view.pixel_cone(ray.direction), ray.origin};
      const TexturePoint found = texture_point(*scene, ray, *g.accel().intersect(ray), &cone, false);
      const vec2 across = uv(film + vec2(0.5f, 0)) - uv(film - vec2(0.5f, 0)),
                 down = uv(film + vec2(0, 0.5f)) - uv(film - vec2(0, 0.5f));
      auto area = [](vec2 a, vec2 b) { return std::abs(a.x * b.y - a.y * b.x); };
      const UvFootprint& f = found.footprint;
      EXPECT_NEAR(area(f.major, f.minor), area(across, down), 0.03f * area(across, down)) << film.x;
      // The axes of a circle's image against the sides of a square's: as long, together.
      auto size = [](vec2 a, vec2 b) { return std::sqrt(glm::dot(a, a) + glm::dot(b, b)); };
      EXPECT_NEAR(size(f.major, f.minor), size(across, down), 0.15f * size(across, down)) << film.x;
    }
  }
}

TEST(FilteredTextureRender, FarPlanesHaveTheSameMeanAndMuchLessVariance) {
  for (Part part : {Part::reflectance, Part::emission, Part::opacity})
    for (bool is_checker : {true, false}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(part) << ' ' << is_checker);
      double mean[2], variance[2];
      for (bool filtered : {false, true}) {
        Document d = plane_scene(is_checker ? checker() : noise_picture(),
                                 filtered ? TextureFilter::trilinear : TextureFilter::bilinear, part);
        d.settings.path.max_depth = part == Part::reflectance ? 2 : 1;
        d.settings.sampler.type = SamplerType::independent;
        d.settings.sampler.seed = sampler_seed(3);
        const Film film = render(d);
        mean[filtered] = variance[filtered] = 0;
        for (int y = 0; y < 24; ++y)
          for (int x = 0; x < 24; ++x) {
            mean[filtered] += static_cast<double>(film.mean(x, y).y) / 576;
            variance[filtered] += static_cast<double>(film.variance_of_mean(x, y).y) / (576 * 576);
          }
      }
      // Opacity stays a matter of chance: it is the mean that is filtered.
      if (part != Part::opacity) { EXPECT_LT(5 * variance[1], variance[0]); }
      EXPECT_NEAR(mean[1], mean[0], 6 * std::sqrt(variance[0] + variance[1]) + 0.01 * mean[0]) << seed_note();
      EXPECT_GT(mean[0], 0.05);
    }
}

TEST(FilteredTextureRender, EveryIntegratorAndViewFiltersWhatIsSeen) {
  for (auto [integrator, view] : {std::pair{Integrator::path, View::radiance},
                                  {Integrator::direct, View::radiance},
                                  {Integrator::whitted, View::radiance},
                                  {Integrator::path, View::albedo}}) {
    double variance[2] = {0, 0};
    for (bool filtered : {false, true}) {
      Document d = plane_scene(checker(), filtered ? TextureFilter::trilinear : TextureFilter::bilinear,
                               view == View::albedo ? Part::reflectance : Part::emission);
      d.settings.integrator = integrator;
      d.settings.view = view;
      d.settings.path.max_depth = 1;
      const Film film = render(d);
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) variance[filtered] += static_cast<double>(film.variance_of_mean(x, y).y);
    }
    EXPECT_LT(5 * variance[1], variance[0]) << static_cast<int>(integrator) << static_cast<int>(view);
  }
}

TEST(FilteredTexture, ScenesWithoutThemCarryNothing) {
  Document d = plane_scene(noise_picture(), TextureFilter::bilinear, Part::reflectance);
  const auto plain = RenderScene::build(d);
  EXPECT_FALSE(plain->filters_textures());
  use_of(d.scene.materials[0]).filter = TextureFilter::trilinear;
  const auto filtered = RenderScene::build(d);
  EXPECT_TRUE(filtered->filters_textures());
  const TexturedModel* textured = filtered->material(0).textured;
  ASSERT_NE(textured, nullptr);
  EXPECT_TRUE(textured->is_filtered);
  const MipPyramid* pyramid = textured->lookups[0].pyramid;
  ASSERT_NE(pyramid, nullptr) << "made before anything is rendered";
  EXPECT_GE(filtered->memory_bytes(), plain->memory_bytes() + pyramid->memory_bytes());
  // Another texture of the same texels shares it, and edits keep it; another colour space does not.
  const auto& image = std::get<ImageTexture>(d.scene.textures[0]->model);
  d.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"copy", ImageTexture{"", image.texels}}));
  Material copy = d.scene.materials[0], linear = copy;
  use_of(copy).texture = 1;
  use_of(linear).color_space = ColorSpace::linear;
  d.scene.materials.push_back(copy);
  d.scene.materials.push_back(linear);
  const auto edited = RenderScene::build(d, filtered.get());
  auto pyramid_of = [&](std::uint32_t i) { return edited->material(i).textured->lookups[0].pyramid; };
  EXPECT_EQ(pyramid_of(0), pyramid);
  EXPECT_EQ(pyramid_of(1), pyramid);
  EXPECT_NE(pyramid_of(2), pyramid);
}

TEST(RayCone, RoughSurfacesWidenItByTheirLobe) {
  // A lobe of the solid angle 1 / pdf holds 16 cones, whose solid angle is pi (spread / 2)^2 each.
  const float spread = lobe_spread(1000);
  EXPECT_NEAR(16 * kPi * sqr(0.5f * spread) * 1000, 1, 1e-4f);
  EXPECT_LT(lobe_spread(1e6f), lobe_spread(1000));
  EXPECT_EQ(lobe_spread(0), lobe_spread(0.001f)) << "bounded";
  const ConeOfRay cone = ConeOfRay{{0, 0.01f}, {1, 0, 0}}.after({1, 0, 2}, spread);
  EXPECT_NEAR(cone.width_at({4, 0, 2}), 0.02f + 3 * (0.01f + spread), 1e-6f);
}

} // namespace
} // namespace candela::test
