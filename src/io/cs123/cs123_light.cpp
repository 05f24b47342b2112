#include "io/cs123/cs123_light.h"

#include <fmt/format.h>

namespace candela {

namespace {

/// Sets the type; whether it is an area light.
bool read_type(pugi::xml_node part, const XmlPlaces& places, LightType& type) {
  auto attribute = part.attribute("v") ? part.attribute("v") : part.attribute("value");
  std::string_view name = attribute.value();
  if (name == "area") return true;
  if (name == "point")
    type = LightType::point;
  else if (name == "directional")
    type = LightType::directional;
  else if (name == "spot")
    type = LightType::spot;
  else
    throw input_error(attribute ? places.attribute(attribute, part) : places.element(part), "lightdata",
                      fmt::format("there is no light type '{}'", name.substr(0, 40)),
                      "give point, directional, spot or area");
  return false;
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
  Cs123Light out;
  LightDesc& light = out.light;
  light.name = "light";
  std::optional<pugi::xml_node> function;
  float penumbra = 0;
  for (pugi::xml_node part : data.children()) {
    if (part.type() != pugi::node_element) continue;
    std::string_view name = part.name();
    if (name == "id")
      light.name = fmt::format("light {}", values.number(part, {"v", "value"}));
    else if (name == "type")
      out.is_area = read_type(part, places, light.type);
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
      out.width = positive(part, values);
    else if (name == "height")
      out.height = positive(part, values);
    else
      values.ignore(part);
  }
  light.beam_width = std::max(light.cutoff_angle - penumbra, 0.0f);
  bool at_a_point = !out.is_area && light.type != LightType::directional;
  if (function && at_a_point) {
    light.attenuation = attenuation_of(*function, values);
    if (light.attenuation.x > 0 || light.attenuation.y > 0)
      values.warnings().add(places.element(*function),
                            "a light's function of distance is not physical: that would be 0 0 1");
  }
  if ((out.is_area || light_uses(light.type, "direction")) && is_black(light.direction))
    throw input_error(places.element(data), "lightdata", "its direction has no length", "give a direction");
  return out;
}

void add_cs123_light(SceneDesc& scene, SceneBuilder& builder, Cs123Light source) {
  LightDesc& light = source.light;
  if (!source.is_area) {
    scene.lights.push_back(std::move(light));
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
  instance.world_from_object = mat4(vec4(0.5f * source.width * x, 0), vec4(0.5f * source.height * y, 0),
                                    vec4(z, 0), vec4(light.position, 1));
  scene.instances.push_back(std::move(instance));
}

} // namespace candela
