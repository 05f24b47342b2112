#include "io/obj/triangulate.h"

namespace candela {

namespace {

using dvec2 = glm::dvec2;
using dvec3 = glm::dvec3;

/// Twice the signed area.
double area(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The corners in the plane of the polygon's area vector (Newell), counter-clockwise.
std::vector<dvec2> project(std::span<const vec3> corners) {
  dvec3 normal(0), origin(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(dvec3(corners[i]) - origin, dvec3(corners[i + 1]) - origin);
  // Projecting along the normal's largest axis preserves orientation without a rotation.
  dvec3 n = glm::abs(normal);
  int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<dvec2> flat;
  flat.reserve(corners.size());
  for (vec3 p : corners) flat.emplace_back(p[u], p[v]);
  return flat;
}

class EarClipper {
public:
  explicit EarClipper(std::vector<dvec2> corners)
      : p_(std::move(corners)), previous_(p_.size()), next_(p_.size()), ear_(p_.size()) {
    int n = static_cast<int>(p_.size());
    for (int i = 0; i < n; ++i) previous_[at(i)] = (i + n - 1) % n, next_[at(i)] = (i + 1) % n;
    for (int i = 0; i < n; ++i) ear_[at(i)] = is_ear(i);
  }

  void run(std::vector<std::array<int, 3>>& triangles) {
    int left = static_cast<int>(p_.size()), i = 0, tried = 0;
    while (left > 3) {
      if (!ear_[at(i)] && tried < left) {
        i = next_[at(i)], ++tried;
        continue; // a self-intersecting polygon may have no ear: after a full round, cut any corner
      }
      int a = previous_[at(i)], c = next_[at(i)];
      triangles.push_back({a, i, c});
      next_[at(a)] = c, previous_[at(c)] = a;
      ear_[at(a)] = is_ear(a), ear_[at(c)] = is_ear(c);
      // Continuing two corners further avoids fans of thin triangles.
      i = next_[at(c)], tried = 0, --left;
    }
    triangles.push_back({previous_[at(i)], i, next_[at(i)]});
  }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  bool is_ear(int i) const {
    int ia = previous_[at(i)], ic = next_[at(i)];
    dvec2 a = p_[at(ia)], b = p_[at(i)], c = p_[at(ic)];
    double whole = area(a, b, c);
    if (whole <= 0) return false;
    for (int k = next_[at(ic)]; k != ia; k = next_[at(k)]) {
      dvec2 q = p_[at(k)];
      // Bridges to holes visit a point twice: a duplicate does not count as inside.
      if (q == a || q == b || q == c) continue;
      if (area(a, b, q) >= 0 && area(b, c, q) >= 0 && area(c, a, q) >= 0) return false;
    }
    return true;
  }

  std::vector<dvec2> p_;
  std::vector<int> previous_, next_;
  std::vector<char> ear_;
};

} // namespace

void triangulate(std::span<const vec3> corners, std::vector<std::array<int, 3>>& triangles) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
    return;
  }
  std::vector<dvec2> p = project(corners);
  if (corners.size() == 4) {
    bool inside_02 = area(p[0], p[1], p[2]) >= 0 && area(p[0], p[2], p[3]) >= 0;
    bool inside_13 = area(p[0], p[1], p[3]) >= 0 && area(p[1], p[2], p[3]) >= 0;
    if (inside_02 || !inside_13) {
      triangles.push_back({0, 1, 2});
      triangles.push_back({0, 2, 3});
    } else {
      triangles.push_back({0, 1, 3});
      triangles.push_back({1, 2, 3});
    }
    return;
  }
  EarClipper(std::move(p)).run(triangles);
}

} // namespace candela
