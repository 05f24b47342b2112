#include "app/bench/bench_script.h"

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// The size of an object, by a part of which it is moved.
std::size_t triangles_of(const Instance& instance) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  return mesh != nullptr ? (*mesh)->triangles.size() : 1;
}

/// The object with the most triangles: moving it costs most.
Instance& largest_object(SceneDesc& scene) {
  return *std::ranges::max_element(scene.instances, {}, triangles_of);
}

bool emits(const Material& material) { return material.emission != vec3(0); }
vec3* diffuse_of(Material& material) {
  const ParameterRef parameter = find_parameter(material, "diffuse");
  return parameter ? &parameter.color->value : nullptr;
}
bool reflects(const Material& material) {
  const vec3* diffuse = diffuse_of(const_cast<Material&>(material));
  return !emits(material) && diffuse != nullptr && *diffuse != vec3(0);
}
bool shines(const LightDesc& light) { return light.scale != 0 && light.color != vec3(0); }

} // namespace

const char* to_string(InputKind kind) {
  switch (kind) {
  case InputKind::camera: return "camera";
  case InputKind::flight: return "flight";
  case InputKind::material: return "material";
  case InputKind::light: return "light";
  case InputKind::setting: return "setting";
  case InputKind::object: return "object";
  }
  return "";
}

vec2 flight_position(int step, ivec2 window) {
  const float t = 0.05f * static_cast<float>(step);
  return vec2(window) * (0.4f + 0.12f * vec2(std::sin(t), std::sin(2 * t)));
}

bool can_edit(InputKind kind, const Document& document) {
  const SceneDesc& scene = document.scene;
  switch (kind) {
  case InputKind::material: return std::ranges::any_of(scene.materials, reflects);
  case InputKind::light:
    return std::ranges::any_of(scene.lights, shines) || std::ranges::any_of(scene.materials, emits);
  case InputKind::object: return !scene.instances.empty();
  default: return true;
  }
}

void apply_edit(InputKind kind, int step, Document& document) {
  SceneDesc& scene = document.scene;
  const bool there = step % 2 == 0;
  const float factor = there ? 0.5f : 2.0f; // both are exact in floats
  switch (kind) {
  case InputKind::camera:
  case InputKind::flight: break;
  case InputKind::material: *diffuse_of(*std::ranges::find_if(scene.materials, reflects)) *= factor; break;
  case InputKind::light:
    if (auto light = std::ranges::find_if(scene.lights, shines); light != scene.lights.end())
      light->scale *= factor;
    else
      std::ranges::find_if(scene.materials, emits)->emission.value *= factor;
    break;
  case InputKind::setting: document.settings.sampler.seed = step + 1; break;
  case InputKind::object: {
    mat4& m = largest_object(scene).world_from_object;
    m[3].y += (there ? 1.0f : -1.0f) / 64;
    break;
  }
  }
}

} // namespace candela
