// What textures ask of surfaces beside coordinates: where a point lies in its object, and the mesh's colours.

#include "render/render_testing.h"
#include "render/world/texture_point.h"
#include "support/textures.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <random>
#include <set>

namespace candela::test {
namespace {

class Dice {
public:
  float operator()(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random_); }
  vec3 in_cube(float half) {
    const float x = (*this)(-half, half), y = (*this)(-half, half);
    return {x, y, (*this)(-half, half)};
  }

private:
  std::mt19937 random_{static_cast<std::mt19937::result_type>(fresh_seed())};
};

vec3 color_of(vec3 p) { return 0.5f + 0.1f * vec3(p.x + p.y, p.y - p.z, 2 * p.z); }

/// A sphere of triangles whose vertices' colours are linear in their position, and whose faces' are numbers.
Mesh colored_mesh() {
  Mesh mesh = sphere_mesh(20, 30, true);
  for (vec3 p : mesh.positions) mesh.vertex_colors.push_back(color_of(p));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    mesh.face_colors.emplace_back(static_cast<float>(i), 0, 1);
  return mesh;
}

/// Each shape twice, the second one mirrored, moved, turned and stretched.
SceneMaker all_shapes() {
  SceneMaker s(8, 8, 1);
  const int mat = s.diffuse(vec3(1));
  const auto mesh = std::make_shared<const Mesh>(colored_mesh());
  const auto big = [] {
    Mesh m = colored_mesh(); // of so many triangles in all its places that it is placed rather than baked
    m.name = "shared";
    return std::make_shared<const Mesh>(std::move(m));
  }();
  std::vector<Shape> shapes = {SphereShape{0.8f},
                               DiscShape{},
                               RectangleShape{},
                               CubeShape{},
                               CylinderShape{},
                               TorusShape{},
                               mesh,
                               big,
                               big,
                               big,
                               big};
  float x = -10;
  for (const Shape& shape : shapes)
    for (bool mirrored : {false, true}) {
      mat4 m = glm::translate(mat4(1), {x += 2.5f, mirrored ? 0.5f : 0, 1});
      m = glm::rotate(m, 0.7f * x, glm::normalize(vec3(1, 2, -x)));
      if (mirrored) m = glm::scale(m, {-0.7f, 1.2f, 0.9f});
      s.document.scene.instances.push_back({"", shape, m, {mat}});
    }
  return s;
}

TEST(SurfacePlace, IsThePointInItsObjectWithItsNormalTangentsAndColors) {
  SCOPED_TRACE(seed_note());
  Dice dice;
  const SceneMaker s = all_shapes();
  const auto scene = RenderScene::build(s.document);
  const Geometry& geometry = scene->geometry();
  ASSERT_FALSE(geometry.placed().empty());
  std::set<std::uint32_t> met;
  std::set<float> faces;
  for (int i = 0; i < 40000; ++i) {
    const std::size_t n = static_cast<std::size_t>(dice(0, 0.999f) * float(scene->instances().size()));
    const vec3 from = dice.in_cube(40),
               to = vec3(scene->instances()[n].world_from_object[3]) + dice.in_cube(1);
    const Ray ray{from, 0, glm::normalize(to - from), kInfinity};
    const auto hit = geometry.accel().intersect(ray);
    if (!hit) continue;
    const std::uint32_t index = geometry.instance_of(*hit);
    const Instance& instance = scene->instances()[index];
    const SurfaceInteraction surface = geometry.surface(ray, *hit);
    const SurfaceTangents tangents = geometry.tangents(ray, *hit);
    const TexturePoint at = texture_point(*scene, ray, *hit, nullptr, true);
    ASSERT_TRUE(at.place);
    const SurfacePlace& place = *at.place;
    auto near = [&](vec3 a, vec3 b, float tolerance) { return glm::length(a - b) < tolerance; };
    const mat4& m = instance.world_from_object;
    ASSERT_TRUE(near(transform_point(m, place.position), surface.position, 2e-5f)) << index;
    ASSERT_TRUE(near(transform_vector(m, place.dpdu), tangents.dpdu, 2e-4f)) << index;
    ASSERT_TRUE(near(transform_vector(m, place.dpdv), tangents.dpdv, 2e-4f)) << index;
    ASSERT_NEAR(glm::length(place.normal), 1, 1e-5f);
    // Perpendicular to what is perpendicular to the normal in the world, and on its side.
    const vec3 across = glm::normalize(glm::cross(surface.shading_normal, vec3(0.3f, -0.5f, 0.8f)));
    const vec3 there = transform_vector(glm::inverse(m), across);
    ASSERT_LT(std::abs(glm::dot(glm::normalize(there), place.normal)), 1e-4f) << index;
    ASSERT_GT(glm::dot(transform_vector(m, place.normal), surface.shading_normal), 0) << index;
    if (std::holds_alternative<std::shared_ptr<const Mesh>>(instance.shape)) {
      ASSERT_TRUE(near(place.vertex_color, color_of(place.position), 1e-4f)) << index;
      // The triangle that was hit is the one that the point lies in.
      const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(instance.shape);
      const uvec3 t = mesh.triangles[static_cast<std::size_t>(place.face_color.x)];
      const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      const vec3 normal = glm::cross(b - a, c - a);
      for (auto [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        ASSERT_GT(glm::dot(glm::cross(q - p, place.position - p), normal), -1e-5f) << index;
      faces.insert(place.face_color.x);
    } else {
      ASSERT_EQ(place.vertex_color, vec3(1));
      ASSERT_EQ(place.face_color, vec3(1));
    }
    met.insert(index);
  }
  EXPECT_EQ(met.size(), scene->instances().size());
  EXPECT_GT(faces.size(), 500u);
}

Material textured(vec3 factor, TextureUse use, bool emits) {
  Material m;
  use.texture = 0;
  DiffuseMaterial matte;
  matte.diffuse.value = emits ? vec3(0) : factor;
  if (!emits) matte.diffuse.use = use;
  m.model = matte;
  if (emits) m.emission.value = factor, m.emission.use = use;
  return m;
}

/// Two rows of two squares in the plane z = 0, from -1 to 1.
Mesh squares(const std::vector<vec3>& face_colors) {
  Mesh mesh;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) mesh.positions.emplace_back(x - 1, y - 1, 0);
  for (std::uint32_t y = 0; y < 2; ++y)
    for (std::uint32_t x = 0; x < 2; ++x) {
      const std::uint32_t a = 3 * y + x;
      mesh.triangles.emplace_back(a, a + 1, a + 4);
      mesh.triangles.emplace_back(a, a + 4, a + 3);
    }
  for (vec3 color : face_colors) mesh.face_colors.insert(mesh.face_colors.end(), 2, color);
  return mesh;
}

TEST(SurfacePlaceRender, EveryIntegratorShowsTheColorsOfFaces) {
  const std::vector<vec3> colors = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.5f}};
  for (bool emits : {true, false}) {
    SceneMaker s(2, 2, 4);
    MeshAttributeTexture faces;
    faces.attribute = MeshAttributeTexture::Attribute::face_color;
    s.document.scene.textures.push_back(std::make_shared<const Texture>(Texture{"", faces}));
    s.mesh(squares(colors), s.material(textured(vec3(0.5f), {}, emits)));
    s.camera({0, 0, 4}, {0, 0, 0}, 40);
    s.document.scene.camera.projection = Projection::orthographic;
    s.document.scene.camera.orthographic_height = 2;
    if (!emits) s.document.settings.view = View::albedo;
    for (Integrator integrator : {Integrator::path, Integrator::whitted, Integrator::direct}) {
      if (emits) s.document.settings.integrator = integrator;
      const Film film = render(s.document);
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
          const vec3 expected = 0.5f * colors[static_cast<std::size_t>(2 * (1 - y) + x)];
          for (int c = 0; c < 3; ++c) EXPECT_NEAR(film.mean(x, y)[c], expected[c], 1e-5f) << x << y;
        }
    }
  }
}

TEST(SurfacePlaceRender, LightSamplingFindsWhatRaysMeetStatistical) {
  // A floor under lamps whose radiance is the mesh's, or a projected picture's: neither is known beforehand.
  SCOPED_TRACE(seed_note());
  TextureUse projected;
  projected.mapping = TextureMapping::triplanar;
  projected.uv.scale = vec2(0.7f), projected.filter = TextureFilter::nearest;
  MeshAttributeTexture faces;
  faces.attribute = MeshAttributeTexture::Attribute::face_color;
  for (int lamp = 0; lamp < 3; ++lamp) {
    SceneMaker s(16, 16, 16);
    const bool own = lamp == 0;
    s.document.scene.textures.push_back(
        own ? std::make_shared<const Texture>(Texture{"", faces})
            : picture_texture(2, 2, {255, 40, 0, 0, 0, 255, 9, 200, 0, 255, 255, 255}));
    const int mat = s.material(textured(vec3(4), own ? TextureUse() : projected, true));
    mat4 m = glm::translate(mat4(1), {0.2f, 1.2f, -0.1f});
    m = glm::rotate(m, 0.4f, vec3(0, 1, 0));
    m = glm::rotate(m, 0.5f * kPi, vec3(1, 0, 0)); // +z down
    if (own)
      s.mesh(squares({{1, 0, 0}, {0, 3, 0}, {0, 0, 1}, {1, 1, 0.5f}}), mat, m);
    else
      s.document.scene.instances.push_back(
          {"", lamp == 1 ? Shape(RectangleShape{}) : Shape(SphereShape{0.5f}), m, {mat}});
    s.rectangle({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, s.diffuse(vec3(0.8f)));
    s.camera({0, 0.6f, 0}, {0, 0, 0}, 100, {0, 0, 1});
    s.document.settings.path.max_depth = 2;
    // Means of pictures, which other seeds make independent of each other.
    std::array<RunningStatistics, 3> found;
    for (LightSampling how : {LightSampling::bsdf, LightSampling::nee, LightSampling::mis}) {
      const auto k = static_cast<std::size_t>(how);
      s.document.settings.path.light_sampling = how;
      for (std::uint64_t picture = 0; picture < 64; ++picture) {
        s.document.settings.sampler.seed = sampler_seed(64 * k + picture);
        found[k].add(over_pixels(render(s.document), 1).mean());
      }
      EXPECT_LT(std::sqrt(found[k].variance_of_mean()), 0.005 * found[k].mean()) << "too few samples to tell";
    }
    for (std::size_t k = 1; k < 3; ++k)
      EXPECT_GT(z_test(found[k], found[0], 1e-5 * found[0].mean()), sidak_threshold(6)) << lamp << k;
    EXPECT_GT(found[0].mean(), 0.05);
  }
}

TEST(SurfacePlaceRender, ProjectedReliefIsThatOfCoordinatesWhereTheyAgree) {
  // On a rectangle from -1 to 1 the coordinates are (p + 1) / 2.
  const auto texture = std::make_shared<const Texture>(Texture{"", NoiseTexture()});
  for (bool bump : {true, false})
    for (bool mirrored : {false, true}) {
      std::array<Film, 2> films = {Film(8, 8), Film(8, 8)};
      for (bool projected : {false, true}) {
        SceneMaker s(8, 8, 1);
        Material m;
        m.model = DiffuseMaterial{vec3(1)};
        TextureUse use;
        use.texture = 0;
        use.color_space = ColorSpace::linear;
        use.uv.scale = vec2(1.5f);
        if (projected) {
          use.mapping = TextureMapping::triplanar;
          use.uv.scale = vec2(0.75f), use.uv.offset = vec2(0.75f);
        }
        if (bump) {
          m.bump.value = 0.2f, m.bump.use = use;
          s.document.scene.textures.push_back(texture);
        } else {
          m.normal_map.value = vec3(1), m.normal_map.use = use;
          s.document.scene.textures.push_back(
              picture_texture(2, 2, {150, 100, 250, 90, 128, 240, 128, 170, 240, 120, 128, 250}));
        }
        mat4 world = glm::rotate(mat4(1), 0.3f, glm::normalize(vec3(1, 2, 0.5f)));
        world = glm::scale(world, vec3(mirrored ? -1 : 1, 1, 1));
        s.document.scene.instances.push_back({"", RectangleShape{}, world, {s.material(m)}});
        LightDesc lamp;
        PointLightModel point;
        point.position = {0.7f, 1, 2};
        lamp.model = point;
        s.document.scene.lights.push_back(lamp);
        s.camera({0.3f, 0.2f, 4}, {0, 0, 0}, 20);
        s.document.settings.path.max_depth = 2;
        films[projected] = render(s.document);
      }
      float contrast = 0;
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          const float a = films[0].mean(x, y).x, b = films[1].mean(x, y).x;
          EXPECT_NEAR(a, b, 4e-3f * a) << bump << mirrored << ' ' << x << ' ' << y;
          contrast = std::max(contrast, std::abs(a / films[0].mean(0, 0).x - 1));
        }
      EXPECT_GT(contrast, 0.05f) << "this shows nothing";
    }
}

TEST(SurfacePlaceRender, ProjectionsGoWhereTheirObjectGoes) {
  // The object and the camera moved and turned together: the same picture.
  std::array<Film, 2> films = {Film(16, 16), Film(16, 16)};
  for (bool moved : {false, true}) {
    SceneMaker s(16, 16, 4);
    s.document.scene.textures.push_back(std::make_shared<const Texture>(Texture{"", CheckerTexture()}));
    TextureUse use;
    use.mapping = TextureMapping::triplanar;
    const int mat = s.material(textured(vec3(1), use, false));
    const mat4 m = moved
                       ? glm::rotate(glm::translate(mat4(1), {3, -2, 5}), 1.1f, glm::normalize(vec3(1, 2, 3)))
                       : mat4(1);
    s.document.scene.instances.push_back({"", TorusShape{}, m, {mat}});
    s.camera(transform_point(m, {1, 2, 4}), transform_point(m, vec3(0)), 40, transform_vector(m, {0, 1, 0}));
    s.document.settings.view = View::albedo;
    films[moved] = render(s.document);
  }
  int apart = 0; // where squares or silhouettes pass between rounded rays
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) apart += glm::length(films[0].mean(x, y) - films[1].mean(x, y)) > 1e-3f;
  EXPECT_LE(apart, 3);
}

} // namespace
} // namespace candela::test
