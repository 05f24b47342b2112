#include "render/world/sealed_media.h"

#include <algorithm>
#include <tuple>

namespace candela {

namespace {

bool overlap(const Bounds3& a, const Bounds3& b) {
  return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::lessThanEqual(b.lo, a.hi));
}

/// Whether the instance bounds a volume on all sides, at all times alike.
bool is_closed(const Instance& instance, const MeshHulls& hulls) {
  if (instance.motion != Motion()) return false;
  struct Visitor {
    const MeshHulls& hulls;
    bool operator()(const std::shared_ptr<const Mesh>& mesh) const {
      return !mesh->deforms() && hulls.at(mesh).closed;
    }
    bool operator()(const SphereShape&) const { return true; }
    bool operator()(const CubeShape&) const { return true; }
    bool operator()(const TorusShape&) const { return true; }
    bool operator()(const CylinderShape& s) const { return s.caps; }
    bool operator()(const ConeShape& s) const { return s.caps; }
    bool operator()(const RectangleShape&) const { return false; }
    bool operator()(const DiscShape&) const { return false; }
    bool operator()(const PlaneShape&) const { return false; }
    bool operator()(const CurvesShape&) const { return false; }
  };
  return std::visit(Visitor{hulls}, instance.shape);
}

Bounds3 world_bounds(const Instance& instance, const MeshHulls& hulls) {
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
  const Bounds3 own = mesh != nullptr ? hulls.at(*mesh).bounds : shape_bounds(instance.shape);
  Bounds3 world;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p((corner & 1) != 0 ? own.hi.x : own.lo.x, (corner & 2) != 0 ? own.hi.y : own.lo.y,
                 (corner & 4) != 0 ? own.hi.z : own.lo.z);
    world.grow(vec3(instance.world_from_object * vec4(p, 1)));
  }
  return world;
}

/// Whether a light may lie in the box. Lights around the scene lie in none.
bool holds_light(const Bounds3& box, const std::vector<Light>& lights) {
  return std::ranges::any_of(lights, [&](const Light& light) {
    const LightKind kind = light_kind(light);
    if (kind == LightKind::infinite || kind == LightKind::delta_direction) return false;
    const auto bounds = light_bounds(light);
    return !bounds || overlap(bounds->box, box);
  });
}

} // namespace

MeshHull hull_of(const Mesh& mesh) {
  MeshHull hull{true, {}};
  for (const vec3 p : mesh.positions) hull.bounds.grow(p);
  // Vertices at one place are one vertex.
  auto coordinates = [&](std::uint32_t i) {
    const vec3 p = mesh.positions[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> order(mesh.positions.size()), place(mesh.positions.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](auto a, auto b) { return coordinates(a) < coordinates(b); });
  for (std::size_t k = 0, distinct = 0; k < order.size(); ++k) {
    if (k > 0 && coordinates(order[k]) != coordinates(order[k - 1])) ++distinct;
    place[order[k]] = static_cast<std::uint32_t>(distinct);
  }
  /// An edge from its lower to its higher end, or back.
  struct Edge {
    std::uint32_t low, high;
    int direction;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const uvec3& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = place[t[c]], b = place[t[(c + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  std::ranges::sort(
      edges, [](const Edge& a, const Edge& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  for (std::size_t i = 0; i < edges.size() && hull.closed;) {
    int sum = 0;
    const Edge first = edges[i];
    for (; i < edges.size() && same(edges[i], first); ++i) sum += edges[i].direction;
    hull.closed = sum == 0;
  }
  hull.closed &= !edges.empty();
  return hull;
}

std::vector<bool> sealed_media(const std::vector<Instance>& instances, const SceneMaterials& materials,
                               const std::vector<Light>& lights, MeshHulls& hulls) {
  std::vector<bool> sealed(materials.media().size(), true);
  if (materials.world_medium()) sealed[materials.world_medium().index] = false;
  MeshHulls used;
  for (const Instance& instance : instances)
    for (const int index : instance.materials) {
      const SurfaceMaterial& material = materials[static_cast<std::size_t>(index)];
      const MediumId inside = material.media.inside;
      if (!inside || !sealed[inside.index]) continue;
      const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&instance.shape);
      if (mesh != nullptr && !used.contains(*mesh)) {
        const auto known = hulls.find(*mesh);
        used.emplace(*mesh, known != hulls.end() ? known->second : hull_of(**mesh));
      }
      const bool passable = material.invisible || material.opacity < 1 || material.opacity_texture != nullptr;
      const bool whole = std::ranges::all_of(instance.materials, [&](int other) { return other == index; });
      sealed[inside.index] = !passable && whole && is_closed(instance, used) &&
                             !holds_light(world_bounds(instance, used), lights);
    }
  hulls = std::move(used);
  return sealed;
}

} // namespace candela
