#include "scene/scene_desc.h"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <map>

namespace candela {

namespace {

constexpr std::string_view kShapeNames[] = {"mesh", "sphere",   "rectangle", "disc",  "plane",
                                            "cube", "cylinder", "cone",      "torus", "curves"};
static_assert(std::size(kShapeNames) == std::variant_size_v<Shape>);

/// Lengths may be any number above 0.
template <class S, auto Member>
void* shape_member(Shape& shape) {
  return &(std::get<S>(shape).*Member);
}
template <class S, auto Member>
constexpr Field<Shape> length_row(std::string_view key, std::string_view help) {
  return {{key, FieldType::real, 0, kUnlimited, "scene units", help, Invalidates::scene, {}, true, true},
          shape_member<S, Member>};
}
template <class S, auto Member>
constexpr Field<Shape> caps_row(std::string_view help) {
  return {{"caps", FieldType::boolean, 0, 0, "", help, Invalidates::scene}, shape_member<S, Member>};
}

const Field<Shape> kSphereFields[] = {length_row<SphereShape, &SphereShape::radius>("radius", "Radius")};
const Field<Shape> kCylinderFields[] = {
    length_row<CylinderShape, &CylinderShape::radius>("radius", "Radius"),
    length_row<CylinderShape, &CylinderShape::height>("height", "Length along z, from 0"),
    caps_row<CylinderShape, &CylinderShape::caps>("Closed by discs at both ends")};
const Field<Shape> kConeFields[] = {
    length_row<ConeShape, &ConeShape::radius>("radius", "Radius of the base, in z = 0"),
    length_row<ConeShape, &ConeShape::height>("height", "z of the apex, on the z axis"),
    caps_row<ConeShape, &ConeShape::caps>("Closed by the disc of its base")};
const Field<Shape> kTorusFields[] = {
    length_row<TorusShape, &TorusShape::radius>("radius", "Radius of the circle at the tube's centre"),
    length_row<TorusShape, &TorusShape::minor_radius>("minor_radius", "Radius of the tube; below radius")};

constexpr std::array<std::string_view, 2> kCurveFormNames{"round", "ribbon"};
const Field<Shape> kCurvesFields[] = {
    {{"form", FieldType::choice, 0, 0, "", "Tubes, or ribbons that face each ray: for thin hair",
      Invalidates::scene, kCurveFormNames},
     shape_member<CurvesShape, &CurvesShape::form>},
    {{"thickness",
      FieldType::real,
      0,
      kUnlimited,
      "",
      "Multiplies the widths of all strands",
      Invalidates::scene,
      {},
      true,
      true},
     shape_member<CurvesShape, &CurvesShape::thickness>}};

} // namespace

std::span<const std::string_view> shape_names() { return kShapeNames; }
std::string_view shape_name(const Shape& shape) { return kShapeNames[shape.index()]; }

std::optional<Shape> shape_of_name(std::string_view name) {
  const Shape kinds[] = {SphereShape{},   RectangleShape{}, DiscShape{},  PlaneShape{}, CubeShape{},
                         CylinderShape{}, ConeShape{},      TorusShape{}, CurvesShape{}};
  for (const Shape& shape : kinds)
    if (shape_name(shape) == name) return shape;
  return std::nullopt;
}

std::span<const Field<Shape>> shape_fields(const Shape& shape) {
  if (std::holds_alternative<SphereShape>(shape)) return kSphereFields;
  if (std::holds_alternative<CylinderShape>(shape)) return kCylinderFields;
  if (std::holds_alternative<ConeShape>(shape)) return kConeFields;
  if (std::holds_alternative<TorusShape>(shape)) return kTorusFields;
  if (std::holds_alternative<CurvesShape>(shape)) return kCurvesFields;
  return {};
}

Bounds3 shape_bounds(const Shape& shape) {
  Bounds3 box{vec3(-1, -1, 0), vec3(1, 1, 0)}; // of rectangles, discs, planes
  if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape)) {
    box = {};
    for (vec3 p : (*mesh)->positions) box.grow(p);
    for (vec3 p : (*mesh)->positions_end) box.grow(p);
  } else if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
    box = {vec3(-sphere->radius), vec3(sphere->radius)};
  } else if (std::holds_alternative<CubeShape>(shape)) {
    box = {vec3(-1), vec3(1)};
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    box = {vec3(-cylinder->radius, -cylinder->radius, 0),
           vec3(cylinder->radius, cylinder->radius, cylinder->height)};
  } else if (const auto* cone = std::get_if<ConeShape>(&shape)) {
    box = {vec3(-cone->radius, -cone->radius, 0), vec3(cone->radius, cone->radius, cone->height)};
  } else if (const auto* torus = std::get_if<TorusShape>(&shape)) {
    vec3 corner(vec2(torus->radius + torus->minor_radius), torus->minor_radius);
    box = {-corner, corner};
  } else if (const auto* curves = std::get_if<CurvesShape>(&shape)) {
    box = strand_bounds(*curves->strands, curves->thickness);
  }
  return box;
}

namespace {

/// Clamps also coordinates that overflowed in a transform.
vec3 within_reach(vec3 p) {
  auto limit = [](float x) { return std::isnan(x) ? 0 : std::clamp(x, -kMaxCoordinate, kMaxCoordinate); };
  return {limit(p.x), limit(p.y), limit(p.z)};
}

} // namespace

Bounds3 instance_bounds(const std::vector<Instance>& instances) {
  std::map<const Mesh*, Bounds3> meshes; // shared meshes are scanned once
  Bounds3 all, planes;
  for (const Instance& instance : instances) {
    Bounds3 box;
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape)) {
      auto [known, is_new] = meshes.try_emplace(mesh->get());
      if (is_new) known->second = shape_bounds(instance.shape);
      box = known->second;
    } else {
      box = shape_bounds(instance.shape);
    }
    if (box.empty()) continue;
    Bounds3& grown = std::holds_alternative<PlaneShape>(instance.shape) ? planes : all;
    for (int corner = 0; corner < 8; ++corner)
      grown.grow(within_reach(transform_point(
          instance.world_from_object, {(corner & 1) ? box.hi.x : box.lo.x, (corner & 2) ? box.hi.y : box.lo.y,
                                       (corner & 4) ? box.hi.z : box.lo.z})));
  }
  return all.empty() ? planes : all;
}

std::string shape_problem(const Shape& shape) {
  for (const auto& row : shape_fields(shape)) {
    if (row.type != FieldType::real) continue;
    float value = *static_cast<const float*>(row.address(const_cast<Shape&>(shape)));
    if (!(value > 0 && std::isfinite(value)))
      return fmt::format("{}: {} is not a positive number", row.key, value);
  }
  const auto* torus = std::get_if<TorusShape>(&shape);
  if (torus != nullptr && !(torus->minor_radius < torus->radius))
    return fmt::format("minor_radius: {} is not below the radius {}", torus->minor_radius, torus->radius);
  return {};
}

FieldInfo shape_limits(const Shape& shape, const Field<Shape>& row) {
  constexpr float kSmallestLength = 1e-6f;
  FieldInfo limits = row;
  if (row.type != FieldType::real) return limits;
  const float value = *static_cast<const float*>(row.address(const_cast<Shape&>(shape)));
  float lo = std::min(kSmallestLength, value), hi = std::max(kMaxCoordinate, value);
  if (const auto* torus = std::get_if<TorusShape>(&shape)) {
    if (row.key == "minor_radius")
      hi = std::nextafter(torus->radius, 0.0f);
    else
      lo = std::nextafter(torus->minor_radius, kInfinity);
  }
  auto shown = [](float x) { // 0.3, not 0.30000001192092896
    const std::string text = fmt::format("{}", x);
    double decimal = 0;
    std::from_chars(text.data(), text.data() + text.size(), decimal);
    return decimal;
  };
  limits.minimum = shown(lo);
  limits.above_minimum = false; // these values are themselves valid
  limits.maximum = shown(hi);
  return limits;
}

} // namespace candela
