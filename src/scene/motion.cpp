#include "scene/motion.h"

#include "scene/scene_desc.h"

#include <array>

namespace candela {

namespace {

constexpr auto kScene = Invalidates::scene;

const std::array<Field<Motion>, 5> kFields{
    {{{"translate", FieldType::point, -kUnlimited, kUnlimited, "scene units", "Way in the world by time 1",
       kScene},
      [](Motion& m) -> void* { return &m.translate; }},
     {{"angle", FieldType::angle, -36000, 36000, "degrees",
       "Rotation by time 1, about the axis through the centre; may be several turns", kScene},
      [](Motion& m) -> void* { return &m.angle; }},
     {{"axis", FieldType::point, -kUnlimited, kUnlimited, "",
       "Axis of that rotation, in the object's own space", kScene},
      [](Motion& m) -> void* { return &m.axis; }},
     {{"scale", FieldType::point, 1e-3, 1e3, "", "Factors by time 1 along the object's own axes", kScene},
      [](Motion& m) -> void* { return &m.scale; }},
     {{"center", FieldType::point, -kUnlimited, kUnlimited, "",
       "What rotation and scaling keep in place, in the object's own space", kScene},
      [](Motion& m) -> void* { return &m.center; }}}};

} // namespace

std::span<const Field<Motion>> motion_fields() { return kFields; }

std::string motion_problem(const Motion& motion) {
  if (!(glm::length(motion.axis) > 0)) return "axis: it has no length; give a direction such as 0 1 0";
  return {};
}

MovingTransform placement_of(const Instance& instance) {
  const Motion& motion = instance.motion;
  MovingTransform out;
  out.world_from_object = glm::dmat4(instance.world_from_object);
  out.pivot = glm::dvec3(motion.center);
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape))
    out.pivot -= (*mesh)->origin;
  out.translation = glm::dvec3(motion.translate);
  out.axis = glm::normalize(glm::dmat3(out.world_from_object) * glm::dvec3(motion.axis));
  out.angle = static_cast<double>(motion.angle);
  out.scale = glm::dvec3(motion.scale);
  return out;
}

mat4 world_from_object(const Instance& instance, float time) {
  return instance.motion.any() ? mat4(placement_of(instance).at(static_cast<double>(time)))
                               : instance.world_from_object;
}

} // namespace candela
