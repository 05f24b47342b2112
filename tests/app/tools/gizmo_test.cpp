// Handles and their drags; typed transforms.

#include "app/tools/gizmo.h"
#include "app/tools/transform_parts.h"
#include "support/seed.h"

#include <gtest/gtest.h>

#include <random>

namespace candela {
namespace {

ScreenProjection screen_of(Projection projection = Projection::perspective) {
  Camera camera;
  camera.position = {3, 2, 5};
  camera.vertical_fov = radians(40.0f);
  camera.projection = projection;
  camera.orthographic_height = 4;
  return {camera, PixelRect{0, 0, 800, 600}, {800, 600}};
}

const vec3 kPivot(0.2f, -0.1f, 0.4f);

/// A point on the handle where the mouse hits it.
vec2 grip(const ScreenProjection& screen, GizmoHandle handle, Tool tool) {
  const vec2 middle = *screen.point(kPivot);
  if (handle == GizmoHandle::view) return middle + (tool == Tool::rotate ? vec2(0, -102) : vec2(0));
  vec3 axis(0);
  axis[static_cast<int>(handle)] = 1;
  return *screen.point(kPivot + 60 * screen.units_per_pixel(kPivot) * axis);
}

TEST(Gizmo, ItsHandlesAreHit) {
  for (auto projection : {Projection::perspective, Projection::orthographic}) {
    const ScreenProjection screen = screen_of(projection);
    for (Tool tool : {Tool::move, Tool::scale}) {
      const Gizmo gizmo{tool, kPivot, mat3(1), 1};
      for (GizmoHandle handle : {GizmoHandle::x, GizmoHandle::y, GizmoHandle::z, GizmoHandle::view})
        EXPECT_EQ(gizmo.hit(screen, grip(screen, handle, tool)), handle);
      EXPECT_FALSE(gizmo.hit(screen, {5, 5}));
    }
    EXPECT_EQ(
        (Gizmo{Tool::rotate, kPivot, mat3(1), 1}.hit(screen, grip(screen, GizmoHandle::view, Tool::rotate))),
        GizmoHandle::view);
  }
}

TEST(Gizmo, AMoveFollowsTheMouseAlongItsAxis) {
  for (auto projection : {Projection::perspective, Projection::orthographic}) {
    const ScreenProjection screen = screen_of(projection);
    for (int axis = 0; axis < 3; ++axis) {
      vec3 step(0);
      step[axis] = 0.7f;
      const vec2 from = *screen.point(kPivot), to = *screen.point(kPivot + step);
      GizmoDrag drag({Tool::move, kPivot, mat3(1), 1}, static_cast<GizmoHandle>(axis), from);
      const mat4 moved = drag.moved_to(screen, to, false);
      EXPECT_LT(glm::length(vec3(moved[3]) - step), 2e-3f);
      const float grid = snap_step(screen.units_per_pixel(kPivot), 1);
      const float snapped = drag.moved_to(screen, to, true)[3][axis] / grid;
      EXPECT_NEAR(snapped, std::round(snapped), 1e-3f);
      EXPECT_NEAR(snapped * grid, 0.7f, 0.51f * grid);
    }
    GizmoDrag drag({Tool::move, kPivot, mat3(1), 1}, GizmoHandle::view, *screen.point(kPivot));
    const vec2 to = *screen.point(kPivot) + vec2(40, -25);
    const mat4 moved = drag.moved_to(screen, to, false);
    EXPECT_LT(glm::length(*screen.point(kPivot + vec3(moved[3])) - to), 0.1f);
    EXPECT_NEAR(glm::dot(vec3(moved[3]), screen.forward()), 0, 1e-4f);
  }
}

TEST(Gizmo, ARotationTurnsWithTheHandAndAroundMoreThanOnce) {
  const ScreenProjection screen = screen_of();
  const vec2 middle = *screen.point(kPivot);
  auto at = [&](float angle) { return middle + 100.0f * vec2(std::cos(angle), -std::sin(angle)); };
  GizmoDrag drag({Tool::rotate, kPivot, mat3(1), 1}, GizmoHandle::y, at(0)); // y points to the viewer's side
  mat4 turned(1);
  const float whole = 2 * kPi + 0.5f;
  for (int i = 1; i <= 50; ++i) turned = drag.moved_to(screen, at(whole * static_cast<float>(i) / 50), false);
  const mat4 expected = glm::rotate(mat4(1), whole, vec3(0, 1, 0));
  for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(turned[c] - expected[c]), 1e-3f);
  EXPECT_LT(glm::length(transform_point(turned, kPivot) - kPivot), 1e-4f) << "about the pivot";
  const mat4 snapped = drag.moved_to(screen, at(whole), true);
  const mat4 by_30 = glm::rotate(mat4(1), radians(30.0f), vec3(0, 1, 0)); // 28.6 degrees over a turn
  for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(snapped[c] - by_30[c]), 1e-3f);
}

TEST(Gizmo, AScaleKeepsThePivotAndStaysPositive) {
  const ScreenProjection screen = screen_of();
  const mat3 axes(glm::rotate(mat4(1), 0.5f, glm::normalize(vec3(1, 2, 3))));
  const Gizmo gizmo{Tool::scale, kPivot, axes, 1};
  const float unit = screen.units_per_pixel(kPivot);
  for (int axis = 0; axis < 3; ++axis) {
    const vec2 from = *screen.point(kPivot + 60 * unit * axes[axis]), middle = *screen.point(kPivot);
    GizmoDrag drag(gizmo, static_cast<GizmoHandle>(axis), from);
    const mat4 twice = drag.moved_to(screen, middle + 2.0f * (from - middle), false);
    EXPECT_LT(glm::length(transform_vector(twice, axes[axis]) - 2.0f * axes[axis]), 0.05f);
    const vec3 other = axes[(axis + 1) % 3];
    EXPECT_LT(glm::length(transform_vector(twice, other) - other), 1e-4f);
    EXPECT_LT(glm::length(transform_point(twice, kPivot) - kPivot), 1e-4f);
    const mat4 through = drag.moved_to(screen, middle - 3.0f * (from - middle), false);
    EXPECT_GT(glm::determinant(mat3(through)), 0) << "never inside out, never flat";
  }
}

TEST(Gizmo, SnapStepsAreRoundAndSome30Pixels) {
  for (float unit : {0.001f, 0.034f, 1.0f, 77.0f}) {
    const float step = snap_step(unit, 1);
    EXPECT_GE(step, 30 * unit * 0.999f);
    EXPECT_LE(step, 76 * unit);
    const float digits = step / std::pow(10.0f, std::floor(std::log10(step * 1.001f)));
    EXPECT_TRUE(std::abs(digits - 1) < 0.01f || std::abs(digits - 2) < 0.01f || std::abs(digits - 5) < 0.01f);
  }
}

TEST(TransformParts, AreThoseThatMadeTheMatrix) {
  std::mt19937_64 random(test::fresh_seed());
  SCOPED_TRACE(test::seed_note());
  std::uniform_real_distribution<float> unit(-1, 1);
  auto vector = [&] { return vec3(unit(random), unit(random), unit(random)); };
  for (int i = 0; i < 200; ++i) {
    TransformParts parts{10.0f * vector(), 180.0f * vector(), vec3(1.5f) + vector()};
    parts.rotation.y *= 0.49f; // beyond 90 degrees other angles make the same matrix
    if (i % 2 == 1) parts.scale.x = -parts.scale.x;
    const mat4 matrix = transform_of(parts);
    EXPECT_FALSE(has_shear(matrix));
    const TransformParts again = transform_parts(matrix);
    EXPECT_LT(glm::length(again.position - parts.position), 1e-4f);
    EXPECT_LT(glm::length(again.scale - parts.scale), 1e-4f);
    EXPECT_LT(glm::length(again.rotation - parts.rotation), 0.05f);
  }
}

TEST(TransformParts, GimbalLockAndShear) {
  const mat4 locked = transform_of({vec3(0), vec3(20, 90, 0), vec3(1)});
  const mat4 again = transform_of(transform_parts(locked));
  for (int c = 0; c < 3; ++c) EXPECT_LT(glm::length(again[c] - locked[c]), 1e-3f);
  mat4 sheared(1);
  sheared[1].x = 0.3f;
  EXPECT_TRUE(has_shear(sheared));
}

} // namespace
} // namespace candela
