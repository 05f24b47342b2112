#pragma once
// Small scenes for tests of sampling strategies. Lights and lobes are wide enough that every strategy finds
// them often, because rare events make tests weak.

#include "render/render_testing.h"
#include "support/textures.h"

namespace candela::test {

struct NamedScene {
  const char* name;
  Document document;
};

inline Material strategy_material(std::string_view type, vec3 diffuse, vec3 specular) {
  Material m = material_of_type(type);
  set_if_there(m, "diffuse", diffuse);
  set_if_there(m, "specular", specular);
  set_if_there(m, "exponent", 12.0f);
  set_if_there(m, "roughness", 0.6f);
  return m;
}

/// A floor and a wall of the material under a large light, a small one and a sphere light.
inline Document plates_scene(const Material& material) {
  SceneMaker s(8, 8, 1);
  int mat = s.material(material);
  s.rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, mat);
  s.rectangle({0, 2, -3}, {4, 0, 0}, {0, 2, 0}, mat);
  s.rectangle({-1, 3, 0}, {1.5f, 0, 0}, {0, 0, 1}, s.diffuse(vec3(0.3f), {2, 3, 4}));
  s.rectangle({2, 2, 0}, {0, 0.4f, 0}, {0, 0, 0.4f}, s.diffuse(vec3(0), {12, 8, 6})); // facing -x
  s.document.scene.instances.back().world_from_object[2] = vec4(-1, 0, 0, 0);
  s.sphere({1, 1, 1}, 0.4f, s.diffuse(vec3(0.5f), {3, 2, 5}));
  s.camera({0, 2, 6}, {0, 1, 0}, 45);
  return s.document;
}

inline Document mirror_and_glass_scene() {
  SceneMaker s(8, 8, 1);
  int white = s.diffuse({0.7f, 0.6f, 0.5f}), light = s.diffuse({0.2f, 0.2f, 0.2f}, vec3(3));
  s.closed_box({-2, -1, -2}, {2, 2, 3}, white);
  s.rectangle({0, 1.9f, 0}, {1.2f, 0, 0}, {0, 0, 1.2f}, light);
  Material glass;
  glass.model = DielectricMaterial();
  color(glass, "absorption") = {0.1f, 0.4f, 0.8f};
  s.sphere({0.8f, -0.3f, 0.5f}, 0.7f, s.material(glass));
  s.sphere({-0.8f, -0.3f, 0}, 0.7f,
           s.material(strategy_material("mirror", {0.4f, 0.3f, 0.2f}, {0.5f, 0.6f, 0.6f})));
  s.camera({0, 0.5f, 2.9f}, {0, 0, 0}, 60);
  return s.document;
}

/// A textured floor under emissive copies of one mesh, a half-transparent screen between them.
inline Document instances_scene() {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(
      picture_texture(2, 2, {255, 200, 100, 60, 120, 250, 200, 255, 200, 90, 60, 200}));
  Material floor;
  color(floor, "diffuse") = vec3(0.8f);
  use_of(floor).texture = 0;
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}, s.material(floor));
  auto ball = std::make_shared<const Mesh>(sphere_mesh(36, 40, false));
  int shine = s.diffuse(vec3(0.4f), {2, 3, 4});
  for (float x : {-1.2f, 1.2f}) {
    mat4 place = glm::translate(mat4(1), {x, 1.2f, 0});
    s.mesh_shared(ball, shine, glm::scale(place, {0.5f * x, 0.7f, 0.8f}));
  }
  Material screen;
  color(screen, "diffuse") = vec3(0.5f);
  screen.opacity = 0.5f;
  screen.emission = vec3{1, 0.5f, 0.2f};
  screen.two_sided_emission = true;
  s.rectangle({0, 0.8f, 0.5f}, {0.3f, 0, 0}, {0, 0.8f, 0}, s.material(screen));
  s.camera({0, 3, 5}, {0, 0.5f, 0}, 40);
  return s.document;
}

inline Document sky_sun_and_lamp_scene() {
  SceneMaker s(8, 8, 1);
  int grey = s.diffuse({0.7f, 0.5f, 0.6f});
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}, grey);
  s.sphere({0, 0.8f, 0}, 0.8f,
           s.material(strategy_material("phong", {0.3f, 0.3f, 0.4f}, {0.5f, 0.6f, 0.4f})));
  s.disc({-1.5f, 1, 0.5f}, 0.6f, {0, 1, 0}, {0, 0, 1}, s.diffuse(vec3(0.2f), {4, 2, 1}));
  s.constant_light({0.5f, 0.7f, 1});
  LightDesc sun;
  sun.model = DirectionalLightModel{{-1, -2, -1}};
  sun.color = {2, 1.5f, 1};
  s.document.scene.lights.push_back(sun);
  LightDesc lamp;
  lamp.model = PointLightModel{.position = {1.5f, 1.5f, 1}};
  lamp.color = {2, 3, 1};
  s.document.scene.lights.push_back(lamp);
  s.camera({0, 3, 5}, {0, 0.5f, 0}, 45);
  return s.document;
}

/// A panorama with a sun of some 30 degrees, and a spot, over a floor with a can and a ring on it.
inline Document environment_scene() {
  SceneMaker s(8, 8, 1);
  auto panorama = std::make_shared<Panorama>();
  panorama->image = {32, 16, {}};
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x) {
      bool sun = x >= 11 && x < 14 && y >= 3 && y < 6;
      panorama->image.pixels.push_back(sun         ? vec3(20, 16, 10)
                                       : y >= 8    ? vec3(0)
                                       : x % 8 < 2 ? vec3(0.8f, 0.5f, 0.3f)
                                                   : vec3(0.3f, 0.5f, 1));
    }
  LightDesc sky;
  sky.model = EnvironmentLightModel{.rotation = 1, .panorama = panorama};
  s.document.scene.lights.push_back(sky);
  LightDesc spot;
  spot.model = SpotLightModel{
      .position = {1.5f, 2, 1}, .direction = {-1, -1.5f, -0.5f}, .cutoff_angle = 0.7f, .beam_width = 0.3f};
  spot.color = {6, 9, 3};
  s.document.scene.lights.push_back(spot);
  mat4 upright = glm::rotate(mat4(1), -0.5f * kPi, vec3(1, 0, 0)); // z becomes y
  auto add = [&](const Shape& shape, vec3 at, Material m) {
    s.document.scene.instances.push_back({"", shape, glm::translate(mat4(1), at) * upright, {s.material(m)}});
  };
  add(PlaneShape{}, {0, 0, 0}, strategy_material("diffuse", {0.7f, 0.5f, 0.6f}, vec3(0)));
  add(CylinderShape{0.5f, 1.2f, true}, {-0.7f, 0, 0}, strategy_material("ggx", vec3(0), {0.9f, 0.7f, 0.5f}));
  Material green = strategy_material("diffuse", {0.2f, 0.6f, 0.4f}, vec3(0));
  add(TorusShape{0.5f, 0.2f}, {0.8f, 0.2f, 0.3f}, green);
  s.camera({0, 2.5f, 4}, {0, 0.4f, 0}, 40);
  return s.document;
}

/// Flat pieces whose normals lean away so far that about half of the lobes lies on the wrong side of the
/// surface.
inline Document smooth_gloss_scene() {
  SceneMaker s(8, 8, 1);
  Material gloss = strategy_material("ggx", vec3(0), {0.9f, 0.8f, 0.7f});
  number(gloss, "roughness") = 0.5f;
  Material lacquer = strategy_material("phong", vec3(0.3f), vec3(0.6f));
  number(lacquer, "exponent") = 10;
  for (const Material& m : {gloss, lacquer}) {
    const float z = material_type_name(m) == "ggx" ? -0.5f : 0.5f;
    Mesh mesh;
    mesh.positions = {{-1, 0, z - 0.5f}, {-1, 0, z + 0.5f}, {1, 0, z + 0.5f}, {1, 0, z - 0.5f}};
    mesh.normals.assign(4, glm::normalize(vec3(0.8f, 0.6f, 0.1f)));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    s.mesh(std::move(mesh), s.material(m));
  }
  s.rectangle({2.4f, 1.6f, 0}, {0, 0, 1}, {-0.5f, 0.7f, 0}, s.diffuse(vec3(0), vec3(6)));
  s.rectangle({-2, 1.5f, 0}, {0, 1.5f, 0}, {0, 0, 2}, s.diffuse(vec3(0.5f), vec3(0.5f)));
  s.constant_light(vec3(0.3f));
  s.camera({-1, 3, 0.4f}, {0, 0, 0}, 30);
  return s.document;
}

/// Lamps of every kind that shine as a picture or a checker shows, one of them full of holes.
inline Document textured_lamps_scene() {
  SceneMaker s(8, 8, 1);
  auto texels = std::make_shared<const Texels>(
      Texels{2, 2, 3, std::vector<float>{9, 0.5f, 0, 0, 3, 1, 0.2f, 0.2f, 6, 2, 2, 2}});
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", ImageTexture{"", std::move(texels)}}));
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", CheckerTexture{{5, 4, 1}, vec3(0.5f), 4}}));
  auto lamp = [&](int texture, float factor) {
    Material m = strategy_material("diffuse", vec3(0.3f), vec3(0));
    m.emission = vec3(factor);
    m.emission.use.texture = texture;
    return m;
  };
  const int floor = s.material(strategy_material("ggx", vec3(0), {0.9f, 0.8f, 0.7f}));
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}, floor);
  s.rectangle({0, 1.4f, -1.5f}, {1.5f, 0, 0}, {0, 1.2f, 0}, s.material(lamp(0, 1)));
  s.sphere({1.4f, 0.8f, 0.5f}, 0.5f, s.material(lamp(1, 1)));
  s.disc({-1.4f, 1.6f, 0.3f}, 0.6f, {0, 0, 1}, {0.6f, 0.8f, 0}, s.material(lamp(0, 1.5f)));
  Material holes = lamp(1, 0.6f);
  holes.two_sided_emission = true;
  holes.opacity.use.texture = 1;
  holes.opacity.value = 0.2f;
  holes.opacity.use.uv.scale = vec2(0.7f);
  s.rectangle({0, 1, 1}, {0.6f, 0, 0.2f}, {0, 0.6f, 0}, s.material(holes));
  s.camera({0, 3, 5}, {0, 0.5f, 0}, 40);
  return s.document;
}

/// Pictures and checkers looked up over footprints: on a matte, a glossy and a mirroring surface, of a lamp,
/// and of a screen's holes.
inline Document filtered_textures_scene() {
  SceneMaker s(8, 8, 1);
  auto& textures = s.document.scene.textures;
  textures.push_back(
      picture_texture(4, 4, {255, 40, 120, 200, 90, 255, 10, 160, 70, 255, 180, 30, 220, 60, 240, 110}, 1));
  textures.push_back(std::make_shared<const Texture>(Texture{"", CheckerTexture{vec3(0.9f), vec3(0.2f), 3}}));
  auto look_at = [](TextureUse& use, int texture, float scale) {
    use.texture = texture;
    use.filter = TextureFilter::trilinear;
    use.uv.scale = vec2(scale);
  };
  Material floor = strategy_material("diffuse", vec3(0.8f), vec3(0));
  look_at(use_of(floor), 1, 9);
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}, s.material(floor));
  Material gloss = strategy_material("phong", vec3(0.3f), vec3(0.6f));
  look_at(use_of(gloss, "specular"), 0, 20);
  look_at(use_of(gloss, "exponent"), 0, 5);
  s.rectangle({0, 1.5f, -2}, {3, 0, 0}, {0, 1.5f, 0}, s.material(gloss));
  s.sphere({1, 0.7f, 0}, 0.7f, s.material(strategy_material("mirror", vec3(0.2f), vec3(0.7f))));
  Material lamp = strategy_material("diffuse", vec3(0.3f), vec3(0));
  lamp.emission = vec3{5, 4, 3};
  look_at(lamp.emission.use, 0, 3);
  s.rectangle({-0.5f, 2.8f, 0.5f}, {1, 0, 0}, {0, 0, 1}, s.material(lamp));
  Material screen = strategy_material("diffuse", vec3(0.4f), vec3(0));
  screen.opacity = 0.9f;
  look_at(screen.opacity.use, 1, 6);
  s.rectangle({-1, 1, 1}, {0.8f, 0, 0.2f}, {0, 0.8f, 0}, s.material(screen));
  s.camera({0, 3, 5}, {0, 0.7f, 0}, 45);
  return s.document;
}

/// A sky, whose sun the BSDF would not find, and a lamp, a spot and two pictures that shape the intensity by
/// direction.
inline Document shaped_lights_scene() {
  SceneMaker s(8, 8, 1);
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0}, s.diffuse({0.7f, 0.5f, 0.6f}));
  s.sphere({-0.9f, 0.7f, 0}, 0.7f, s.material(strategy_material("ggx", vec3(0), {0.8f, 0.7f, 0.9f})));
  s.sphere({0.9f, 0.6f, 0.2f}, 0.6f, s.diffuse({0.3f, 0.6f, 0.4f}));
  auto profile = std::make_shared<IesProfile>();
  profile->vertical = {0, radians(30.0f), radians(60.0f), radians(100.0f)};
  profile->horizontal = {0, radians(120.0f), radians(240.0f), radians(360.0f)};
  profile->candela = {900, 700, 300, 20, 900, 500, 600, 90, 900, 300, 100, 5, 900, 700, 300, 20};
  auto picture = std::make_shared<Panorama>();
  picture->image = {4, 2, {}};
  for (int i = 0; i < 8; ++i)
    picture->image.pixels.emplace_back(i % 3, 1 + i % 2, 0.5f * static_cast<float>(i));
  auto add = [&](LightDescModel model, vec3 color, float temperature = 0) {
    LightDesc light;
    light.model = std::move(model);
    light.color = color, light.temperature = temperature;
    s.document.scene.lights.push_back(light);
  };
  add(SkyLightModel{.sun_elevation = radians(20.0f), .sun_scale = 0, .resolution = 32}, vec3(0.004f));
  add(PointLightModel{.position = {0, 2, 0.5f}, .roll = 0.4f, .profile = profile}, vec3(0.3f), 2700);
  add(SpotLightModel{.position = {-2, 2.5f, 1},
                     .direction = {2, -2, -1},
                     .cutoff_angle = 0.6f,
                     .beam_width = 0.3f,
                     .profile = profile},
      vec3(1));
  add(PointLightModel{.position = {1.5f, 1.5f, -1}, .panorama = picture}, vec3(0.4f));
  add(ProjectorLightModel{.position = {0, 3, 2}, .direction = {0, -2, -1}, .panorama = picture}, vec3(3));
  s.camera({0, 3, 5}, {0, 0.5f, 0}, 45);
  return s.document;
}

/// Balls of a few smooth triangles, at the rims of lamps that graze them: matte, glossy, translucent, and
/// squeezed copies of one mesh, large enough not to be baked.
inline Document coarse_balls_scene() {
  SceneMaker s(8, 8, 1);
  auto ball = std::make_shared<const Mesh>(sphere_mesh(5, 8, true));
  auto place = [&](vec3 at, vec3 size, int mat) {
    s.mesh_shared(ball, mat, glm::scale(glm::translate(mat4(1), at), size));
  };
  place({-1.1f, 0.2f, 0}, vec3(1), s.diffuse({0.8f, 0.7f, 0.6f}));
  place({1.1f, 0.2f, 0}, vec3(1), s.material(strategy_material("ggx", vec3(0), {0.9f, 0.7f, 0.5f})));
  place({-1.1f, -1.7f, 0}, {1, 0.7f, 0.8f},
        s.material(strategy_material("phong", {0.3f, 0.4f, 0.2f}, {0.5f, 0.4f, 0.5f})));
  auto finer = std::make_shared<const Mesh>(sphere_mesh(32, 40, true));
  const int white = s.diffuse(vec3(0.7f));
  for (float x : {0.7f, 1.6f})
    s.mesh_shared(finer, white, glm::scale(glm::translate(mat4(1), {x, -1.6f, 0}), {0.4f, -0.8f, 0.6f}));
  s.rectangle({-4, 0, 0}, {0, 2.5f, 0}, {0, 0, -2.5f}, s.diffuse(vec3(0.2f), {2, 3, 4}));
  s.document.scene.instances.back().world_from_object[2] = vec4(1, 0, 0, 0);
  s.sphere({0, 3, -1.5f}, 1, s.diffuse(vec3(0.2f), {4, 3, 2}));
  s.camera({0, -0.5f, 7}, {0, -0.7f, 0}, 38);
  s.document.settings.path.smooth_terminator = true;
  return s.document;
}

/// Glowing tubes and ribbons, with a corner and without one, over a glossy floor; one is checkered, and one
/// lets light through.
inline Document glowing_curves_scene() {
  SceneMaker s(8, 8, 1);
  s.document.scene.textures.push_back(
      std::make_shared<const Texture>(Texture{"", CheckerTexture{vec3(1), vec3(0.2f), 3}}));
  s.rectangle({0, 0, 0}, {0, 0, 3}, {3, 0, 0},
              s.material(strategy_material("phong", {0.3f, 0.4f, 0.2f}, {0.5f, 0.4f, 0.6f})));
  auto add = [&](CurveForm form, vec3 at, Material m) {
    Strands strands;
    strands.basis = CurveBasis::bezier;
    for (vec3 p : {vec3(0, 0, 0), vec3(0.2f, 0.5f, 0), vec3(0.5f, 0.6f, 0.3f), vec3(0.7f, 0.6f, 0.3f),
                   vec3(0.9f, 0.6f, 0.3f), vec3(1, 0.9f, 0), vec3(0.8f, 1.1f, 0), vec3(1.1f, 0.9f, 0.4f),
                   vec3(1.4f, 0.6f, 0.4f), vec3(1.6f, 0.7f, 0)})
      strands.points.push_back(at + p);
    strands.counts = {10};
    strands.widths = {0.3f, 0.2f};
    CurvesShape shape;
    shape.strands = std::make_shared<const Strands>(std::move(strands));
    shape.form = static_cast<int>(form);
    s.document.scene.instances.push_back({"", shape, mat4(1), {s.material(m)}});
  };
  Material lamp = strategy_material("diffuse", vec3(0.4f), vec3(0));
  lamp.emission = vec3{3, 2, 4};
  add(CurveForm::round, {-1.8f, 0.3f, 0}, lamp);
  add(CurveForm::ribbon, {0.2f, 0.3f, 0}, lamp);
  Material veil = lamp;
  veil.opacity = 0.5f;
  add(CurveForm::round, {-0.7f, 0.4f, -1}, veil);
  lamp.emission.use.texture = 0;
  add(CurveForm::round, {-0.7f, 0.4f, 1}, lamp);
  s.camera({0, 3, 5}, {0, 0.5f, 0}, 40);
  return s.document;
}

inline std::vector<NamedScene> strategy_scenes() {
  Document cornell = cornell_flush(8, 8, 1, true).document;
  return {{"Cornell box with blocks", cornell},
          {"phong plates", plates_scene(strategy_material("phong", {0.3f, 0.4f, 0.2f}, {0.5f, 0.4f, 0.6f}))},
          {"ggx plates", plates_scene(strategy_material("ggx", vec3(0), {0.8f, 0.7f, 0.9f}))},
          {"mirror and glass", mirror_and_glass_scene()},
          {"instances, texture, screen", instances_scene()},
          {"sky, sun and lamp", sky_sun_and_lamp_scene()},
          {"environment and spot", environment_scene()},
          {"coarse smooth gloss", smooth_gloss_scene()},
          {"textured lamps", textured_lamps_scene()},
          {"filtered textures", filtered_textures_scene()},
          {"shaped lights", shaped_lights_scene()},
          {"coarse smooth balls", coarse_balls_scene()},
          {"glowing curves", glowing_curves_scene()}};
}

} // namespace candela::test
