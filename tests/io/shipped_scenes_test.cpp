// The scenes in scenes/: each is read without warnings and has the properties that its description states.

#include "core/color.h"
#include "io/scene_files.h"
#include "support/materials.h"

#include <algorithm>

namespace candela {
namespace {

using test::color;
using test::has;

using test::mesh_of;
using test::SceneFiles;

std::string shipped(const std::string& name) { return CANDELA_TEST_SOURCE_DIR "/scenes/" + name; }

TEST(ShippedScenes, AreReadWithoutWarningsAndRoundTrip) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shipped(""))) {
    if (entry.path().extension() != ".json" || entry.path().filename() == "gallery.json") continue;
    SCOPED_TRACE(entry.path().string());
    ++count;
    LoadedScene loaded = read_scene(entry.path().string());
    EXPECT_EQ(loaded.warnings, std::vector<Warning>{});
    EXPECT_EQ(document_problem(loaded.document), "");
    EXPECT_NE(test::read_text(entry.path().string()).find("\"description\": \""), std::string::npos);
    SceneFiles files;
    write_candela_json(loaded.document, files / "copy.json");
    EXPECT_TRUE(same_content(files.read("copy.json", {true}).document, loaded.document));
  }
  EXPECT_GE(count, 25);
}

const Instance& named(const LoadedScene& scene, const std::string& name) {
  return *std::ranges::find(scene.document.scene.instances, name, &Instance::name);
}

TEST(ShippedScenes, TheCornellBoxIsTheMeasuredOne) {
  LoadedScene box = read_scene(shipped("cornell_box.json"));
  Bounds3 bounds = scene_bounds(box.document.scene);
  EXPECT_EQ(bounds.lo, vec3(0));
  EXPECT_EQ(bounds.hi, vec3(556, 548.8f, 559.2f));
  EXPECT_EQ(box.document.scene.instances.size(), 8u);
  for (const char* name : {"floor", "ceiling", "back wall", "left wall", "right wall"}) {
    const Mesh& wall = *std::get<std::shared_ptr<const Mesh>>(named(box, name).shape);
    for (const uvec3& t : wall.triangles) {
      vec3 a = wall.positions[t.x];
      vec3 normal = glm::cross(wall.positions[t.y] - a, wall.positions[t.z] - a);
      EXPECT_GT(glm::dot(normal, vec3(278, 274, 280) - a), 0) << name << " faces inwards";
    }
  }
}

TEST(ShippedScenes, TheStudioShowsOneMaterial) {
  const LoadedScene studio = read_scene(shipped("studio.json"));
  const SceneDesc& scene = studio.document.scene;
  const auto place = std::ranges::find(scene.materials, "material", &Material::name);
  ASSERT_NE(place, scene.materials.end());
  const int material = static_cast<int>(place - scene.materials.begin());
  for (const Instance& instance : scene.instances) {
    const bool shown = instance.name == "ball" || instance.name == "ring" || instance.name == "tile";
    EXPECT_EQ(instance.materials[0] == material, shown) << instance.name;
  }
  // Greys alone, so that colours are the material's.
  for (const Material& m : scene.materials) {
    if (m.name == "material") continue;
    EXPECT_EQ(m.emission.value.x, m.emission.value.y) << m.name;
    EXPECT_EQ(m.emission.value.x, m.emission.value.z) << m.name;
  }
  // The ball touches the ring, whose tube is inside of neither.
  const vec3 ball = transform_point(named(studio, "ball").world_from_object, vec3(0));
  const vec3 ring = transform_point(named(studio, "ring").world_from_object, vec3(0));
  const auto& torus = std::get<TorusShape>(named(studio, "ring").shape);
  EXPECT_NEAR(glm::length(vec2(torus.radius, ball.y - ring.y)), 1 + torus.minor_radius, 1e-3f);
  // The sweep is smooth where it bends: normals are those of its profile.
  const Mesh& sweep = *std::get<std::shared_ptr<const Mesh>>(named(studio, "sweep").shape);
  for (const uvec3& t : sweep.triangles) {
    const vec3 a = sweep.positions[t.x];
    const vec3 flat = glm::normalize(glm::cross(sweep.positions[t.y] - a, sweep.positions[t.z] - a));
    for (int k = 0; k < 3; ++k) EXPECT_GT(glm::dot(flat, sweep.normals[t[k]]), 0.995f);
  }
  EXPECT_EQ(std::ranges::count(scene.bookmarks, "ball", &Bookmark::name), 1) << "of the thumbnails";
}

TEST(ShippedScenes, TheFlushLightFillsItsHole) {
  LoadedScene box = read_scene(shipped("cornell_flush.json"));
  const Instance& light = named(box, "light");
  EXPECT_EQ(transform_vector(light.world_from_object, {0, 0, 1}), vec3(0, -1, 0)) << "it faces down";
  const auto& ceiling = std::get<std::shared_ptr<const Mesh>>(named(box, "ceiling").shape)->positions;
  double area = 0;
  for (int corner = 0; corner < 4; ++corner) {
    vec3 p = transform_point(light.world_from_object, {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, 0});
    EXPECT_TRUE(std::ranges::find(ceiling, p) != ceiling.end()) << p.x << " " << p.y << " " << p.z;
  }
  const Mesh& mesh = *std::get<std::shared_ptr<const Mesh>>(named(box, "ceiling").shape);
  for (const uvec3& t : mesh.triangles) {
    glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    double y = glm::cross(b - a, c - a).y;
    EXPECT_LT(y, 0) << "faces down";
    area -= 0.5 * y;
  }
  EXPECT_NEAR(area, 552.8 * 559.2 - 130 * 105, 0.1);
}

TEST(ShippedScenes, NothingInTheFurnaceLosesLight) {
  LoadedScene furnace = read_scene(shipped("furnace.json"));
  for (const Material& m : furnace.document.scene.materials) {
    if (material_type_name(m) == "diffuse") { EXPECT_EQ(color(m, "diffuse"), vec3(1)); }
    if (material_type_name(m) == "mirror") { EXPECT_EQ(color(m, "diffuse") + color(m, "specular"), vec3(1)); }
    if (material_type_name(m) == "dielectric") {
      EXPECT_EQ(color(m, "transmittance") - color(m, "absorption"), vec3(1));
    }
  }
  ASSERT_EQ(furnace.document.scene.lights.size(), 1u);
  EXPECT_EQ(furnace.document.scene.lights[0].color, vec3(1));
}

/// pi times area times radiance, of a sphere or a rectangle that is scaled alike in x and y.
double power(const LoadedScene& scene, const std::string& name) {
  const Instance& lamp = named(scene, name);
  const double scale = glm::length(transform_vector(lamp.world_from_object, {1, 0, 0}));
  const auto* ball = std::get_if<SphereShape>(&lamp.shape);
  const double side = ball ? scale * ball->radius : 2 * scale;
  const Material& material = scene.document.scene.materials[lamp.materials.at(0)];
  return (ball ? 4 * kPi : 1) * kPi * side * side * luminance(material.emission.value);
}

TEST(ShippedScenes, LampsHaveThePowerThatIsPromised) {
  const LoadedScene veach = read_scene(shipped("veach_mis.json"));
  const double first = power(veach, "smallest lamp");
  for (const char* name : {"small lamp", "big lamp", "biggest lamp"})
    EXPECT_NEAR(power(veach, name) / first, 1, 0.01) << name;
  const LoadedScene two = read_scene(shipped("two_lamps.json"));
  EXPECT_NEAR(power(two, "giant lamp") / power(two, "tiny lamp"), 1, 0.01);
}

TEST(ShippedScenes, TheWhiteRoomSwallowsNothing) {
  for (const Material& m : read_scene(shipped("white_room.json")).document.scene.materials) {
    if (material_type_name(m) == "dielectric") {
      EXPECT_EQ(color(m, "transmittance") - color(m, "absorption"), vec3(1)) << m.name;
    } else if (m.emission == vec3(0)) {
      const bool mirror = material_type_name(m) == "mirror";
      const vec3 albedo =
          (has(m, "diffuse") ? color(m, "diffuse") : vec3(0)) + (mirror ? color(m, "specular") : vec3(0));
      EXPECT_LT(glm::distance(albedo, vec3(1)), 1e-6f) << m.name;
    }
  }
}

TEST(ShippedScenes, TenThousandBallsDoNotTouch) {
  const LoadedScene field = read_scene(shipped("ten_thousand_spheres.json"));
  std::vector<glm::vec4> balls; // centre, radius
  for (const Instance& i : field.document.scene.instances)
    if (const auto* ball = std::get_if<SphereShape>(&i.shape))
      balls.emplace_back(transform_point(i.world_from_object, vec3(0)), ball->radius);
  ASSERT_EQ(balls.size(), 10000u);
  std::ranges::sort(balls, {}, &glm::vec4::x);
  for (std::size_t i = 0; i < balls.size(); ++i)
    for (std::size_t j = i + 1; j < balls.size() && balls[j].x - balls[i].x < balls[i].w + 0.2f; ++j)
      ASSERT_GT(glm::distance(vec3(balls[i]), vec3(balls[j])), balls[i].w + balls[j].w) << i << " and " << j;
}

TEST(ShippedScenes, TheClearSkyHasItsSunWhereTheGeneratorPutsIt) {
  const LoadedScene ruin = read_scene(shipped("sun_and_sky.json"));
  const Image& sky = light_panorama(ruin.document.scene.lights.at(0))->image;
  double sun = 0, all = 0;
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const double elevation = 90 - 180 * (y + 0.5) / sky.height, azimuth = 360 * (x + 0.5) / sky.width - 180;
      const double radiance = luminance(sky.pixels[static_cast<std::size_t>(y) * sky.width + x]);
      if (elevation <= 0) continue;
      const double received = radiance * std::cos(radians(static_cast<float>(elevation)));
      all += received;
      if (std::abs(elevation - 32) < 2 && std::abs(azimuth - 60) < 2) sun += received;
    }
  // On a surface facing the sun, its irradiance is several times that of the sky.
  EXPECT_GT(sun / all, 0.6);
  EXPECT_LT(sun / all, 0.95);
}

} // namespace
} // namespace candela
