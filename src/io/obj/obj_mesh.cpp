#include "io/obj/obj_mesh.h"

#include "core/hash.h"
#include "io/obj/triangulate.h"

#include <fmt/format.h>

#include <array>

namespace candela {

namespace {

using glm::dvec3;

/// Assigns indices to distinct corners in the order of their first use. A hash table with open addressing and
/// linear probing: large models have millions of corners, and nodes would take more memory than the mesh.
class CornerNumbers {
public:
  explicit CornerNumbers(ProgressPart& progress) : progress_(progress) {}

  std::uint32_t number(const ObjCorner& c) {
    if (2 * (corners_.size() + 1) > slots_.size()) grow();
    std::size_t at = slot_of(c);
    for (; slots_[at] != kFree; at = (at + 1) & (slots_.size() - 1))
      if (corners_[slots_[at]] == c) return slots_[at];
    slots_[at] = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back(c);
    return slots_[at];
  }
  const BlockVector<ObjCorner>& corners() const { return corners_; }

private:
  static constexpr std::uint32_t kFree = 0xffffffffu;

  std::size_t slot_of(const ObjCorner& c) const {
    auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
    return hash_combine(hash64(bits(c.v) << 32 | bits(c.vt)), bits(c.vn)) & (slots_.size() - 1);
  }

  /// Doubles the number of slots. For hundreds of millions that takes seconds, so it checks for cancellation.
  void grow() {
    constexpr std::size_t kStride = std::size_t{1} << 22;
    const std::size_t size = std::max<std::size_t>(64, 2 * slots_.size());
    std::vector<std::uint32_t>().swap(slots_);
    slots_.reserve(size);
    while (slots_.size() < size) {
      progress_.check();
      slots_.resize(std::min(size, slots_.size() + kStride), kFree);
    }
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      progress_.check();
      std::size_t at = slot_of(corners_[i]);
      while (slots_[at] != kFree) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = i;
    }
  }

  ProgressPart& progress_;
  BlockVector<ObjCorner> corners_;
  std::vector<std::uint32_t> slots_; ///< a power of two, at most half of them in use
};

class MeshAssembly {
public:
  MeshAssembly(const ObjContents& contents, const std::string& file, WarningList& warnings,
               ProgressPart& progress, double share)
      : c_(contents), file_(file), warnings_(warnings), progress_(progress), share_(share),
        vertices_(progress) {}

  Mesh run() {
    const double part = (1 - share_) / 3;
    each_face(part, [&](const ObjFace& face) { measure(face); });
    if (lower_.x <= upper_.x) mesh_.origin = mesh_origin(lower_, upper_);
    mesh_.triangles.reserve(most_triangles_);
    mesh_.material_slots.reserve(most_triangles_);
    each_face(part, [&](const ObjFace& face) { add(face); });
    if (mesh_.triangles.empty()) {
      if (c_.first_loss && (c_.faces.empty() || lost_faces_)) throw *c_.first_loss;
      if (loss_) throw *loss_;
      throw input_error({file_}, "mesh", "it has no face", "export the model with faces");
    }
    write_vertices(part);
    return std::move(mesh_);
  }

private:
  template <class Visit>
  void each_face(double part, Visit visit) {
    const double start = share_, step = part / static_cast<double>(c_.faces.size() + 1);
    for (std::size_t i = 0; i < c_.faces.size(); ++i) {
      progress_.reach(share_ = start + step * static_cast<double>(i));
      visit(c_.faces[i]);
    }
  }

  ObjCorner corner(const ObjFace& face, int i) const {
    return c_.corners[face.first + static_cast<std::uint32_t>(i)];
  }
  bool is_there(int v) const {
    return v >= 0 && static_cast<std::size_t>(v) < c_.positions.size() &&
           !std::isnan(c_.positions[static_cast<std::size_t>(v)].x);
  }
  bool is_whole(const ObjFace& face) const {
    for (int i = 0; i < face.count; ++i)
      if (!is_there(corner(face, i).v)) return false;
    return true;
  }

  void measure(const ObjFace& face) {
    if (!is_whole(face)) return lose(face);
    most_triangles_ += static_cast<std::size_t>(face.count) - 2;
    for (int i = 0; i < face.count; ++i) {
      const ObjCorner c = corner(face, i);
      const dvec3 p = c_.positions[static_cast<std::size_t>(c.v)];
      lower_ = glm::min(lower_, p), upper_ = glm::max(upper_, p);
      has_normals_ |= attribute(c.vn, c_.normals.size()) >= 0;
      has_uvs_ |= attribute(c.vt, c_.uvs.size()) >= 0;
    }
  }

  /// Reports a face that is dropped.
  void lose(const ObjFace& face) {
    lost_faces_ = true;
    warnings_.add({file_, face.line, 0}, "faces that use vertices that are not there are dropped");
    for (int i = 0; i < face.count && !loss_; ++i)
      if (const int v = corner(face, i).v; static_cast<std::size_t>(v) >= c_.positions.size())
        loss_ = bad_obj_index({file_, face.line, 0}, "v", v + 1, c_.positions.size(), false);
  }

  /// The index, if it is valid.
  static int attribute(int index, std::size_t count) {
    return index >= 0 && static_cast<std::size_t>(index) < count ? index : ObjCorner::kNone;
  }

  vec3 position(int v) const { return vec3(c_.positions[static_cast<std::size_t>(v)] - mesh_.origin); }

  void add(const ObjFace& face) {
    if (!is_whole(face)) return;
    corners_.clear(), outline_.clear(), triangles_.clear();
    for (int i = 0; i < face.count; ++i) {
      ObjCorner c = corner(face, i);
      resolve(c.vt, c_.uvs.size(), face, "texture coordinates that are not there: 0 there");
      resolve(c.vn, c_.normals.size(), face, "normals that are not there: flat there");
      corners_.push_back(c), outline_.push_back(position(c.v));
    }
    triangulate(outline_, triangles_);
    for (const auto& [a, b, c] : triangles_) add(face, a, b, c);
  }

  void resolve(int& index, std::size_t count, const ObjFace& face, std::string_view warning) {
    if (index == ObjCorner::kNone) return;
    index = attribute(index, count);
    if (index == ObjCorner::kNone) warnings_.add({file_, face.line, 0}, warning);
  }

  void add(const ObjFace& face, int ia, int ib, int ic) {
    auto a = static_cast<std::size_t>(ia), b = static_cast<std::size_t>(ib), c = static_cast<std::size_t>(ic);
    dvec3 first(outline_[a]);
    dvec3 twice_area = glm::cross(dvec3(outline_[b]) - first, dvec3(outline_[c]) - first);
    if (twice_area == dvec3(0)) {
      warnings_.add({file_, face.line, 0}, "triangles without area are dropped");
      return;
    }
    // Braces guarantee the order of evaluation, on which vertex indices depend.
    mesh_.triangles.push_back(
        uvec3{vertices_.number(corners_[a]), vertices_.number(corners_[b]), vertices_.number(corners_[c])});
    mesh_.material_slots.push_back(face.slot);
  }

  void write_vertices(double part) {
    const BlockVector<ObjCorner>& corners = vertices_.corners();
    mesh_.positions.reserve(corners.size());
    if (has_normals_) mesh_.normals.reserve(corners.size());
    if (has_uvs_) mesh_.uvs.reserve(corners.size());
    const bool has_colors = c_.colors.size() > 0;
    if (has_colors) mesh_.vertex_colors.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      progress_.reach(share_ + part * static_cast<double>(i) / static_cast<double>(corners.size()));
      const ObjCorner& c = corners[i];
      mesh_.positions.push_back(position(c.v));
      const auto vertex = static_cast<std::size_t>(c.v);
      if (has_colors) mesh_.vertex_colors.push_back(vertex < c_.colors.size() ? c_.colors[vertex] : vec3(1));
      if (has_normals_) {
        vec3 n = c.vn >= 0 ? c_.normals[static_cast<std::size_t>(c.vn)] : vec3(0);
        double length = glm::length(dvec3(n)); // the square of a float could overflow
        mesh_.normals.push_back(length > 0 ? vec3(dvec3(n) / length) : vec3(0));
      }
      if (has_uvs_) mesh_.uvs.push_back(c.vt >= 0 ? c_.uvs[static_cast<std::size_t>(c.vt)] : vec2(0));
    }
  }

  const ObjContents& c_;
  const std::string& file_;
  WarningList& warnings_;
  ProgressPart& progress_;
  double share_; ///< of the progress so far
  dvec3 lower_{std::numeric_limits<double>::infinity()}, upper_{-std::numeric_limits<double>::infinity()};
  std::size_t most_triangles_ = 0;
  bool has_normals_ = false, has_uvs_ = false, lost_faces_ = false;
  std::optional<Error> loss_;
  CornerNumbers vertices_;
  std::vector<ObjCorner> corners_; ///< of the current face
  std::vector<vec3> outline_;
  std::vector<std::array<int, 3>> triangles_;
  Mesh mesh_;
};

} // namespace

glm::dvec3 mesh_origin(dvec3 lower, dvec3 upper) {
  // A float has 24 bits. At this distance from the origin, relative to its size, a mesh keeps 19 of them.
  constexpr double kFar = 32;
  const dvec3 most = glm::max(glm::abs(lower), glm::abs(upper));
  const double far = std::max({most.x, most.y, most.z}), size = glm::length(upper - lower);
  if (far <= kFar * size || size == 0) return dvec3(0);
  return dvec3(vec3(0.5 * (lower + upper)));
}

Mesh obj_mesh(const ObjContents& contents, const std::string& file, WarningList& warnings,
              ProgressPart& progress, double share) {
  return MeshAssembly(contents, file, warnings, progress, share).run();
}

} // namespace candela
