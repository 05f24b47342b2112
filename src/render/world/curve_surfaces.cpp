#include "render/world/curve_surfaces.h"

#include "render/world/surface_tangents.h"

namespace candela {

namespace {

using Bezier = std::array<glm::dvec4, 4>; ///< control points, and their radii in w

/// A point and the derivative there.
struct CurvePoint {
  glm::dvec4 p, d;
};
template <class Points>
CurvePoint curve_point(const Points& b, double u) {
  const double v = 1 - u;
  const glm::dvec4 b0(b[0]), b1(b[1]), b2(b[2]), b3(b[3]);
  return {v * v * v * b0 + 3 * u * v * v * b1 + 3 * u * u * v * b2 + u * u * u * b3,
          3.0 * (v * v * (b1 - b0) + 2 * u * v * (b2 - b1) + u * u * (b3 - b2))};
}

/// The i-th segment of a strand.
Bezier bezier_of(CurveBasis basis, std::span<const glm::dvec4> points, std::size_t i) {
  if (basis == CurveBasis::bezier)
    return {points[3 * i], points[3 * i + 1], points[3 * i + 2], points[3 * i + 3]};
  const glm::dvec4 p0 = points[i], p1 = points[i + 1], p2 = points[i + 2], p3 = points[i + 3];
  return {(p0 + 4.0 * p1 + p2) / 6.0, (2.0 * p1 + p2) / 3.0, (p1 + 2.0 * p2) / 3.0,
          (p1 + 4.0 * p2 + p3) / 6.0};
}

/// Whether a strand continues from `a` to `b` in the same direction, with the same taper.
bool is_smooth(const Bezier& a, const Bezier& b) {
  const glm::dvec4 before = a[3] - a[2], after = b[1] - b[0];
  const double lb = glm::length(glm::dvec3(before)), la = glm::length(glm::dvec3(after));
  if (!(lb > 0 && la > 0)) return false;
  constexpr double kKink = 1e-3; // radians: the overlap of neighbours covers it
  return glm::length(before / lb - after / la) < kKink;
}

/// Pieces that a segment is cut into, so that their boxes are tight: none much longer than thick.
std::size_t pieces_of(const Bezier& b) {
  double length = 0, width = 0;
  for (std::size_t k = 0; k < 3; ++k) length += glm::length(glm::dvec3(b[k + 1] - b[k]));
  for (const glm::dvec4& p : b) width = std::max(width, 2 * p.w);
  constexpr double kThick = 12;
  constexpr std::size_t kMost = 16;
  std::size_t pieces = 1;
  while (pieces < kMost && length > kThick * width * static_cast<double>(pieces)) pieces *= 2;
  return pieces;
}

/// Adds the strands of one shape.
class StrandAdder {
public:
  StrandAdder(CurveSurfaces& out, const CurvesShape& shape, const mat4& world_from_object)
      : out_(out), strands_(*shape.strands), world_from_object_(world_from_object),
        shape_(static_cast<std::uint32_t>(out.shapes.size() - 1)) {
    if (shape.curve_form() == CurveForm::ribbon) form_ = CurveSegment::ribbon;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(world_from_object))));
    radius_per_width_ = 0.5 * scale * static_cast<double>(shape.thickness);
  }

  void add_all() {
    std::size_t first = 0;
    for (const std::uint32_t count : strands_.counts) {
      add_strand(first, count);
      first += count;
    }
  }

private:
  void add_strand(std::size_t first, std::size_t count) {
    points_.clear();
    for (std::size_t i = first; i < first + count; ++i)
      points_.emplace_back(
          glm::dvec3(world_from_object_ * glm::dvec4(strands_.points[i], 1)),
          strands_.has_width_per_point() ? radius_per_width_ * static_cast<double>(strands_.widths[i]) : 0);
    const std::size_t n = curve_segments(strands_.basis, count);
    segments_.clear();
    for (std::size_t i = 0; i < n; ++i) {
      segments_.push_back(bezier_of(strands_.basis, points_, i));
      if (!strands_.has_width_per_point()) set_linear_radii(segments_.back(), i, n);
    }
    const std::uint32_t tip =
                            form_ == CurveSegment::ribbon ? CurveSegment::cut_end : CurveSegment::closed_end,
                        root = form_ == CurveSegment::ribbon ? CurveSegment::cut_start
                                                             : CurveSegment::closed_start;
    for (std::size_t i = 0; i < n; ++i) {
      std::uint32_t flags = form_;
      if (i == 0)
        flags |= root;
      else if (!is_smooth(segments_[i - 1], segments_[i]))
        flags |= CurveSegment::closed_start;
      if (i + 1 == n)
        flags |= tip;
      else if (!is_smooth(segments_[i], segments_[i + 1]))
        flags |= CurveSegment::closed_end;
      add_segment(segments_[i], flags, static_cast<double>(i) / static_cast<double>(n),
                  static_cast<double>(i + 1) / static_cast<double>(n));
    }
  }

  void set_linear_radii(Bezier& b, std::size_t i, std::size_t n) const {
    const double root = radius_per_width_ * static_cast<double>(strands_.widths[0]),
                 tip = radius_per_width_ * static_cast<double>(strands_.widths[1]);
    for (std::size_t k = 0; k < 4; ++k) {
      const double u = (static_cast<double>(i) + static_cast<double>(k) / 3) / static_cast<double>(n);
      b[k].w = (1 - u) * root + u * tip;
    }
  }

  void add_segment(const Bezier& b, std::uint32_t flags, double u_begin, double u_end) {
    const std::size_t pieces = pieces_of(b);
    const auto share = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(pieces); };
    CurvePoint start = curve_point(b, 0);
    for (std::size_t k = 0; k < pieces; ++k) {
      const CurvePoint end = curve_point(b, share(k + 1));
      const double third = 1 / (3 * static_cast<double>(pieces));
      CurveSegment piece;
      piece.points = {vec4(start.p), vec4(start.p + third * start.d), vec4(end.p - third * end.d),
                      vec4(end.p)};
      constexpr std::uint32_t kStart = CurveSegment::closed_start | CurveSegment::cut_start,
                              kEnd = CurveSegment::closed_end | CurveSegment::cut_end;
      piece.flags = flags & ~((k > 0 ? kStart : 0u) | (k + 1 < pieces ? kEnd : 0u));
      out_.segments.push_back(piece);
      out_.parts.push_back({static_cast<float>(glm::mix(u_begin, u_end, share(k))),
                            static_cast<float>(glm::mix(u_begin, u_end, share(k + 1))), shape_});
      start = end;
    }
  }

  CurveSurfaces& out_;
  const Strands& strands_;
  glm::dmat4 world_from_object_;
  std::uint32_t shape_;
  std::uint32_t form_ = CurveSegment::tube;
  double radius_per_width_ = 0;
  std::vector<glm::dvec4> points_; ///< of a strand, in the world
  std::vector<Bezier> segments_;   ///< of a strand
};

/// Where a ray met a curve, in double precision: from the ray and the segment's parameter, for the ray's t is
/// too coarse for thin hair that is far away.
struct SeenPoint {
  glm::dvec3 position, normal;
  glm::dvec3 derivative; ///< of the curve, by the segment's parameter
  glm::dvec3 across;     ///< unit: across the strand, as the ray sees it
  double offset;         ///< along `across`, in radii, -1 to 1
  double radius;

  SeenPoint(const CurveSegment& segment, const Ray& ray, double u) {
    const CurvePoint c = curve_point(segment.points, u);
    const glm::dvec3 center(c.p), origin(ray.origin), along = glm::normalize(glm::dvec3(ray.direction));
    derivative = glm::dvec3(c.d);
    radius = std::max(c.p.w, 0.0);
    across = glm::cross(derivative, along);
    const double sine = glm::length(across), speed = glm::length(derivative);
    across = sine > 1e-12 * speed ? across / sine : glm::dvec3(Basis::from_normal(vec3(along)).s);
    const double z = glm::dot(center - origin, along);
    const glm::dvec3 beside = (center - origin) - z * along; // from the ray to the curve
    if (segment.flags & CurveSegment::ribbon) {
      normal = glm::cross(across, speed > 0 ? derivative / speed : along);
      normal = glm::length(normal) > 0.5 ? glm::normalize(normal) : -along;
      if (glm::dot(normal, along) > 0) normal = -normal;
      position = center - beside;
    } else {
      const double depth = std::sqrt(std::max(radius * radius - glm::dot(beside, beside), 0.0));
      const glm::dvec3 outward = -beside - depth * along;
      const double length = glm::length(outward);
      normal = length > 0 ? outward / length : -along;
      position = center + radius * normal;
    }
    offset = radius > 0 ? std::clamp(glm::dot(position - center, across) / radius, -1.0, 1.0) : 0;
  }
};

} // namespace

bool CurveSurfaces::add(const Instance& instance, std::uint32_t index) {
  const auto* shape = std::get_if<CurvesShape>(&instance.shape);
  if (shape == nullptr) return false;
  shapes.push_back({static_cast<std::uint32_t>(instance.materials[0]), index});
  StrandAdder(*this, *shape, instance.world_from_object).add_all();
  return true;
}

void CurveSurfaces::set_surface(const Ray& ray, const Hit& hit, SurfaceInteraction& s) const {
  const CurveSegment& segment = segments[hit.primitive];
  const SeenPoint p(segment, ray, static_cast<double>(hit.u));
  s.position = vec3(p.position);
  // The neighbour's control points, beyond a joint, are rounded otherwise than this segment's.
  const vec3 far = glm::max(glm::abs(vec3(segment.points[0])), glm::abs(vec3(segment.points[3])));
  s.position_error = gamma_bound(6) * (glm::max(far, glm::abs(s.position)) + static_cast<float>(p.radius));
  s.geometric_normal = s.shading_normal = glm::normalize(vec3(p.normal));
}

vec2 CurveSurfaces::uv(const Ray& ray, const Hit& hit) const {
  const SeenPoint p(segments[hit.primitive], ray, static_cast<double>(hit.u));
  const Part& part = parts[hit.primitive];
  return {part.u_begin + hit.u * (part.u_end - part.u_begin), static_cast<float>(0.5 * p.offset + 0.5)};
}

SurfaceTangents CurveSurfaces::tangents(const Ray& ray, const Hit& hit) const {
  const CurveSegment& segment = segments[hit.primitive];
  const SeenPoint p(segment, ray, static_cast<double>(hit.u));
  const glm::dvec3 along = p.derivative - glm::dot(p.derivative, p.normal) * p.normal;
  const double speed = glm::length(along);
  if (!(speed > 1e-9 * glm::length(p.derivative) && p.radius > 0)) return tangents_without_uv(vec3(p.normal));
  const Part& part = parts[hit.primitive];
  const double share = static_cast<double>(part.u_end - part.u_begin);
  // Around a tube the offset changes with the cosine to the viewer; not at all at its very edge.
  const glm::dvec3 around = glm::cross(p.normal, along / speed);
  constexpr double kEdge = 1e-3;
  const double cosine = std::max(glm::dot(around, p.across), kEdge);
  return {vec3(along / share), vec3(around * (2 * p.radius / cosine)), true};
}

std::optional<CurvePieces::Meeting> CurveSurfaces::meet(std::uint32_t piece, vec3 from,
                                                        vec3 direction) const {
  const auto& points = segments[piece].points;
  const Ray ray{from, 0, direction, kInfinity};
  // A point on the piece itself, whose rays begin beside it, does not meet it where it lies.
  const float reach =
      max_component(glm::max(glm::abs(from), glm::abs(vec3(points[0])))) + std::max(points[0].w, points[3].w);
  const accel_detail::CurveRay curve_ray(ray, gamma_bound(32) * reach, kInfinity);
  Hit hit;
  hit.kind = PrimitiveKind::curve;
  auto intersect = [&](std::uint32_t other) {
    const auto met = accel_detail::intersect_curve(segments[other], curve_ray);
    if (met && met->t < hit.t) hit.primitive = other, hit.t = met->t, hit.u = met->u;
  };
  hit.t = kInfinity;
  intersect(piece);
  if (!(hit.t < kInfinity)) return std::nullopt;
  // Near a joint, the place is that of whichever the ray meets first, as if both were one surface.
  constexpr float kJoint = 1 / 16.0f;
  const float u = hit.u;
  if (u < kJoint && parts[piece].u_begin > 0) intersect(piece - 1);
  if (u > 1 - kJoint && parts[piece].u_end < 1) intersect(piece + 1);
  if (owner(hit.primitive, hit.u) != piece) return std::nullopt;
  SurfaceInteraction s;
  set_surface(ray, hit, s);
  return Meeting{s.position, s.position_error, s.geometric_normal};
}

std::optional<CurveLight> CurveSurfaces::light_of_piece(std::size_t piece,
                                                        const EmitterRadiance& radiance) const {
  const auto sent = radiance.even_and_opaque();
  if (!sent || Primitives::bounds(input(), piece).empty()) return std::nullopt;
  const auto& [points, flags] = segments[piece];
  // At corners of ribbons, the disc of the one may lie before the middle of the other.
  const bool from_corner = parts[piece].u_begin > 0 && (flags & CurveSegment::closed_start) != 0,
             to_corner = parts[piece].u_end < 1 && (flags & CurveSegment::closed_end) != 0;
  if ((flags & CurveSegment::ribbon) != 0 && (from_corner || to_corner)) return std::nullopt;
  const vec3 chord = vec3(points[3] - points[0]), tangent = vec3(points[1] - points[0]);
  CurveLight light;
  if (length_squared(chord) > 0)
    light.axis = glm::normalize(chord);
  else if (length_squared(tangent) > 0)
    light.axis = glm::normalize(tangent);
  // A cylinder about the control points of the curve in parts, which are much nearer to it than its own.
  std::vector<vec4> near;
  constexpr int kParts = 8;
  float width = 0, length = 0;
  for (int k = 0; k < kParts; ++k) {
    const double third = 1.0 / (3 * kParts);
    const CurvePoint from = curve_point(points, static_cast<double>(k) / kParts),
                     to = curve_point(points, static_cast<double>(k + 1) / kParts);
    for (const glm::dvec4& p : {from.p, from.p + third * from.d, to.p - third * to.d, to.p})
      near.emplace_back(vec3(p - glm::dvec4(points[0])), std::max(p.w, 0.0));
    width += static_cast<float>(std::max(from.p.w + to.p.w, 0.0)) / kParts;
    length += static_cast<float>(glm::length(glm::dvec3(to.p - from.p)));
  }
  const Basis across = Basis::from_normal(light.axis);
  Bounds3 box; // of the points, from the first: x and y across the axis, z along it
  for (const vec4& p : near) {
    const vec3 at = across.to_local(vec3(p));
    box.grow(at - vec3(0, 0, p.w)), box.grow(at + vec3(0, 0, p.w));
  }
  const vec3 middle = box.center();
  for (const vec4& p : near)
    light.radius = std::max(light.radius, glm::length(vec2(across.to_local(vec3(p)) - middle)) + p.w);
  // Pieces overlap a little, and what is far away is rounded.
  constexpr auto kOverlap = static_cast<float>(accel_detail::kCurveOverlap);
  const float far = max_component(glm::max(glm::abs(vec3(points[0])), glm::abs(vec3(points[3]))));
  const float slack = 4 * kOverlap * (length + light.radius) + 1e-5f * far;
  light.start = vec3(points[0]) + across.to_world({middle.x, middle.y, box.lo.z - slack});
  light.length = box.hi.z - box.lo.z + 2 * slack;
  light.radius += slack;
  light.area = kPi * width * length;
  light.emission = sent->mean;
  light.curves = this;
  light.piece = static_cast<std::uint32_t>(piece);
  return light;
}

Hit CurveSurfaces::hit_at(std::uint64_t number, vec3 point) const {
  Hit hit;
  hit.kind = PrimitiveKind::curve;
  hit.primitive = static_cast<std::uint32_t>(number);
  const auto& p = segments[hit.primitive].points;
  const vec3 chord = vec3(p[3] - p[0]);
  const float along = glm::dot(point - vec3(p[0]), chord), squared = length_squared(chord);
  hit.u = squared > 0 ? std::clamp(along / squared, 0.0f, 1.0f) : 0;
  return hit;
}

} // namespace candela
