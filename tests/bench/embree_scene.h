#pragma once
// Embree in traversal_bench: a scene of one mesh, traced with single rays or packets of 16.

#include "bench_scenes.h"
#include "core/ray.h"
#include "stopwatch.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace candela::bench {

/// Robust scenes are watertight, as ours are; they have no spatial splits, whatever the quality.
class EmbreeScene {
public:
  EmbreeScene(const TriangleMesh& mesh, RTCBuildQuality quality, int threads, bool robust = true)
      : device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())), scene_(rtcNewScene(device_)) {
    if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, quality);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.vertices.size()));
    std::copy(mesh.vertices.begin(), mesh.vertices.end(), v);
    auto* t = static_cast<uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(uvec3), mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), t);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    Stopwatch watch;
    rtcCommitScene(scene_);
    build_ = watch.elapsed();
  }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BuildTime build_time() const { return build_; }

  bool intersect(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query;
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  /// The number of hits of 16 rays, traced as coherent ones.
  std::size_t intersect_16(const Ray* rays) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit16 query;
    for (std::size_t i = 0; i < 16; ++i) {
      const Ray& ray = rays[i];
      query.ray.org_x[i] = ray.origin.x, query.ray.org_y[i] = ray.origin.y, query.ray.org_z[i] = ray.origin.z;
      query.ray.dir_x[i] = ray.direction.x, query.ray.dir_y[i] = ray.direction.y;
      query.ray.dir_z[i] = ray.direction.z;
      query.ray.tnear[i] = ray.t_min, query.ray.tfar[i] = ray.t_max;
      query.ray.time[i] = 0, query.ray.mask[i] = ~0u, query.ray.id[i] = 0, query.ray.flags[i] = 0;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    alignas(64) std::array<int, 16> valid;
    valid.fill(-1);
    rtcIntersect16(valid.data(), scene_, &context, &query);
    std::size_t hits = 0;
    for (unsigned id : query.hit.geomID) hits += id != RTC_INVALID_GEOMETRY_ID;
    return hits;
  }
  bool occluded(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embree_ray(ray);
    rtcOccluded1(scene_, &context, &query);
    return query.tfar < 0;
  }

private:
  static RTCRay embree_ray(const Ray& ray) {
    RTCRay r;
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.t_min, r.tfar = ray.t_max;
    r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
    return r;
  }

  RTCDevice device_;
  RTCScene scene_;
  BuildTime build_;
};

} // namespace candela::bench
