#include "io/cs123/cs123_light.h"

#include <fmt/format.h>

namespace candela {

namespace {

Cs123Light::Type read_type(pugi::xml_node part, const XmlPlaces& places) {
  using enum Cs123Light::Type;
  auto attribute = part.attribute("v") ? part.attribute("v") : part.attribute("value");
  std::string_view name = attribute.value();
  if (name == "area") return area;
  if (name == "point") return point;
  if (name == "directional") return directional;
  if (name == "spot") return spot;
  throw input_error(attribute ? places.attribute(attribute, part) : places.element(part), "lightdata",
                    fmt::format("there is no light type '{}'", name.substr(0, 40)),
                    "give point, directional, spot or area");
}

float number_between(pugi::xml_node part, const Cs123Values& values, float low, float high) {
  float v = values.number(part, {"v", "value", "angle"});
  if (!(v >= low && v <= high))
    throw input_error(values.places().element(part), part.name(), fmt::format("{} is out of range", v),
                      fmt::format("give a number from {} to {}", low, high));
  return v;
}

float positive(pugi::xml_node part, const Cs123Values& values) {
  float v = values.number(part, {"v", "value"});
  if (!(v > 0))
    throw input_error(values.places().element(part), part.name(), fmt::format("{} is no length", v),
                      "give a positive number");
  return v;
}

/// The coefficients of a light's function of distance.
vec3 attenuation_of(pugi::xml_node part, const Cs123Values& values) {
  vec3 v = values.vector(part);
  if (std::min({v.x, v.y, v.z}) < 0 || is_black(v))
    throw input_error(values.places().element(part), part.name(),
                      is_black(v) ? "it is zero: the light would be infinite" : "a coefficient is negative",
                      "give 0 0 1 for light that falls off with the square");
  return glm::min(v, vec3(1e9f));
}

} // namespace

Cs123Light read_cs123_light(pugi::xml_node data, const Cs123Values& values) {
  const XmlPlaces& places = values.places();
  Cs123Light light;
  std::optional<pugi::xml_node> function;
  float penumbra = 0;
  for (pugi::xml_node part : data.children()) {
    if (part.type() != pugi::node_element) continue;
    std::string_view name = part.name();
    if (name == "id")
      light.name = fmt::format("light {}", values.number(part, {"v", "value"}));
    else if (name == "type")
      light.type = read_type(part, places);
    else if (name == "position" || name == "pos")
      light.position = values.vector(part);
    else if (name == "direction" || name == "dir")
      light.direction = values.vector(part);
    else if (name == "color")
      light.color = values.color(part);
    else if (name == "function")
      function = part;
    else if (name == "angle")
      light.cutoff_angle = radians(number_between(part, values, 0.01f, 180));
    else if (name == "penumbra")
      penumbra = radians(number_between(part, values, 0, 180));
    else if (name == "width")
      light.width = positive(part, values);
    else if (name == "height")
      light.height = positive(part, values);
    else
      values.ignore(part);
  }
  light.beam_width = std::max(light.cutoff_angle - penumbra, 0.0f);
  using enum Cs123Light::Type;
  if (function && (light.type == point || light.type == spot)) {
    light.attenuation = attenuation_of(*function, values);
    if (light.attenuation.x > 0 || light.attenuation.y > 0)
      values.warnings().add(places.element(*function),
                            "a light's function of distance is not physical: that would be 0 0 1");
  }
  if (light.type != point && is_black(light.direction))
    throw input_error(places.element(data), "lightdata", "its direction has no length", "give a direction");
  return light;
}

void add_cs123_light(SceneDesc& scene, SceneBuilder& builder, Cs123Light light) {
  using enum Cs123Light::Type;
  if (light.type != area) {
    LightDesc made;
    made.name = std::move(light.name);
    made.color = light.color;
    if (light.type == point)
      made.model = PointLightModel{light.position, light.attenuation};
    else if (light.type == directional)
      made.model = DirectionalLightModel{light.direction};
    else
      made.model = SpotLightModel{light.position, light.direction, light.cutoff_angle, light.beam_width,
                                  light.attenuation};
    scene.lights.push_back(std::move(made));
    return;
  }
  Material material;
  material.name = light.name;
  material.model = DiffuseMaterial{vec3(0)};
  material.emission = light.color;
  Instance instance;
  instance.name = light.name;
  instance.shape = RectangleShape{};
  instance.materials = {builder.add_material(std::move(material))};
  vec3 z = glm::normalize(light.direction), x = glm::cross(vec3(0, 1, 0), z);
  x = length_squared(x) > 1e-12f ? glm::normalize(x) : vec3(1, 0, 0);
  vec3 y = glm::normalize(glm::cross(z, x));
  instance.world_from_object = mat4(vec4(0.5f * light.width * x, 0), vec4(0.5f * light.height * y, 0),
                                    vec4(z, 0), vec4(light.position, 1));
  scene.instances.push_back(std::move(instance));
}

} // namespace candela
