#include "accel/primitives/curves.h"

namespace candela::accel_detail {

namespace {

/// A duff basis in double precision; see core/basis.h.
struct Across {
  glm::dvec3 x, y;
  explicit Across(glm::dvec3 n) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    x = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
};

/// The root of f in (a, b), where f(a) < 0 < f(b): secants from u, where f is `value`, with a bisection
/// wherever a step leaves the bracket, or two steps have not halved their length (after Brent 1973,
/// "Algorithms for Minimization without Derivatives", chapter 4). The last step is shorter than `tolerance`.
template <class F>
double root_between(F f, double a, double fa, double b, double fb, double u, double value, double tolerance) {
  double before = -fa < fb ? a : b, f_before = -fa < fb ? fa : fb;
  double step = b - a, step_before = step;
  constexpr int kMost = 120;
  for (int i = 0; value != 0 && i < kMost; ++i, value = f(u)) {
    (value < 0 ? a : b) = u;
    double next = u - value * (u - before) / (value - f_before);
    if (!(next > a && next < b && std::abs(next - u) <= 0.5 * step_before)) next = 0.5 * (a + b);
    before = u, f_before = value;
    step_before = step, step = std::abs(next - u);
    u = next;
    if (step <= tolerance) break;
  }
  return u;
}

/// The same from the root of the chord, to 1e-9.
template <class F>
double root_between(F f, double a, double fa, double b, double fb) {
  const double u = (a * fb - b * fa) / (fb - fa);
  return root_between(f, a, fa, b, fb, u, f(u), 1e-9);
}

/// A segment as a ray sees it: x and y across the ray, z along it, the radius in w.
///
/// The ray enters the ball at u at s(u) = z - sqrt(D), D = r^2 - x^2 - y^2. A local minimum of s is where it
/// enters the tube: s' = 0, or sqrt(D) s' = z' sqrt(D) + G = 0 with G = -D'/2. Where D < 0 the ray misses the
/// ball, and G alone tells where the ball that is nearest to it lies. The balls' other minima, at an end, are
/// inside of the tube unless the tube is closed there. Ribbons are met where the curve comes closest to the
/// ray, G = 0 with a constant radius, if D >= 0 there.
///
/// Both functions change their sign once on pieces that are short enough, and those are where to look for
/// roots (piece_is_simple). Longer ones are halved; halves that the ray passes by are dropped (Nakamaru and
/// Ohno 2002, "Ray Tracing for Curves Primitive").
class SeenCurve {
public:
  SeenCurve(const CurveSegment& segment, const CurveRay& ray) : flags_(segment.flags), ray_(ray) {
    std::array<glm::dvec4, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      const glm::dvec3 q = glm::dvec3(segment.points[k]) - ray.origin;
      p[k] = {glm::dot(q, ray.across_x), glm::dot(q, ray.across_y), glm::dot(q, ray.along),
              segment.points[k].w};
    }
    c0_ = p[0];
    c1_ = 3.0 * (p[1] - p[0]);
    c2_ = 3.0 * (p[0] - 2.0 * p[1] + p[2]);
    c3_ = p[3] - p[0] + 3.0 * (p[1] - p[2]);
    nearest_ = ray.t_min * ray.length;
    farthest_ = ray.t_max * ray.length;
  }

  std::optional<CurveHit> closest_hit() {
    const bool start = flags_ & (CurveSegment::closed_start | CurveSegment::cut_start),
               end = flags_ & (CurveSegment::closed_end | CurveSegment::cut_end);
    first_ = start ? 0 : -kCurveOverlap;
    last_ = end ? 1 : 1 + kCurveOverlap;
    search(at(first_), at(last_), 0);
    return best_;
  }

private:
  static constexpr int kMaxDepth = 12;

  struct Point {
    double u;
    glm::dvec4 p, d; ///< the curve, and its derivative
    /// r^2 - x^2 - y^2
    double discriminant() const { return p.w * p.w - p.x * p.x - p.y * p.y; }
  };

  bool is_ribbon() const { return flags_ & CurveSegment::ribbon; }

  Point at(double u) const {
    return {u, c0_ + u * (c1_ + u * (c2_ + u * c3_)), c1_ + u * (2.0 * c2_ + 3.0 * u * c3_)};
  }
  /// Half the derivative of the squared distance to the ray, less that of the ball's squared radius.
  double nearing(const Point& q) const {
    const double across = q.p.x * q.d.x + q.p.y * q.d.y;
    return is_ribbon() ? across : across - q.p.w * q.d.w;
  }
  double entering(const Point& q) const {
    const double d = q.discriminant();
    return d > 0 ? q.d.z * std::sqrt(d) + nearing(q) : nearing(q);
  }

  void search(const Point& a, const Point& b, int depth) {
    const double third = (b.u - a.u) / 3;
    const std::array<glm::dvec4, 4> hull{a.p, a.p + third * a.d, b.p - third * b.d, b.p};
    const glm::dvec4 lo = glm::min(glm::min(hull[0], hull[1]), glm::min(hull[2], hull[3])),
                     hi = glm::max(glm::max(hull[0], hull[1]), glm::max(hull[2], hull[3]));
    const double radius = std::max(hi.w, 0.0);
    if (lo.x > radius || lo.y > radius || hi.x < -radius || hi.y < -radius) return;
    if (hi.z < nearest_ || lo.z - radius > farthest_) return;
    if (depth >= kMaxDepth || piece_is_simple(hull, radius)) {
      add_hit_of_piece(a, b);
      return;
    }
    const Point middle = at(0.5 * (a.u + b.u));
    search(a, middle, depth + 1);
    search(middle, b, depth + 1);
  }

  /// G grows with u, and s is convex where it is defined: with v the velocity across the ray and q'' the
  /// second derivative of (x, y, z, r), if |v|^2 > r'^2 + (|(x, y)| + r) |q''|. Or the piece is straight, but
  /// for a thousandth of its radius: then s is convex, or grows, or falls.
  static bool piece_is_simple(const std::array<glm::dvec4, 4>& hull, double radius) {
    const glm::dvec4 bend0 = hull[0] - 2.0 * hull[1] + hull[2], bend1 = hull[1] - 2.0 * hull[2] + hull[3];
    const double bend = 6 * std::sqrt(std::max(glm::dot(bend0, bend0), glm::dot(bend1, bend1)));
    if (bend <= 8e-3 * radius) return true;
    double reach2 = 0, taper = 0;
    for (const glm::dvec4& p : hull) reach2 = std::max(reach2, p.x * p.x + p.y * p.y);
    const glm::dvec2 chord(hull[3].x - hull[0].x, hull[3].y - hull[0].y);
    double forward = kInfinity; // times the length of the chord
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec4 edge = 3.0 * (hull[k + 1] - hull[k]);
      forward = std::min(forward, edge.x * chord.x + edge.y * chord.y);
      taper = std::max(taper, std::abs(edge.w));
    }
    if (!(forward > 0)) return false;
    const double speed2 = forward * forward / glm::dot(chord, chord);
    return speed2 > taper * taper + (std::sqrt(reach2) + radius) * bend;
  }

  void add_hit_of_piece(const Point& a, const Point& b) {
    if (is_ribbon())
      add_ribbon_hit(a, b);
    else
      add_tube_hit(a, b);
  }

  /// Where G is 0, or the end that is nearest to it.
  Point nearest_point(const Point& a, const Point& b) const {
    const double ga = nearing(a), gb = nearing(b);
    if (ga >= 0) return a;
    if (gb <= 0) return b;
    return at(root_between([this](double u) { return nearing(at(u)); }, a.u, ga, b.u, gb));
  }
  /// A point of the piece that the ray meets the ball of, if there is one; else any. Of a piece that is
  /// simple, -D is convex and its slope is 2 G: where two of its tangents, at points about its least value,
  /// meet above 0, all balls are missed. Most rays are told apart by the first point.
  Point met_point(Point a, Point b) const {
    double ga = nearing(a), gb = nearing(b);
    if (ga >= 0) return a;
    if (gb <= 0) return b;
    constexpr double kNarrow = 1e-6;   // the rest is for nearest_point()
    constexpr double kBent = 0.01;     // straight pieces are bent by a thousandth of their radius
    double weight_a = 1, weight_b = 1; // halved for an end that stays (the Illinois variant of regula falsi)
    while (b.u - a.u > kNarrow) {
      const double ya = weight_a * ga, yb = weight_b * gb, u = (a.u * yb - b.u * ya) / (yb - ya);
      if (!(u > a.u && u < b.u)) break;
      const Point q = at(u);
      if (q.discriminant() >= 0) return q;
      const double g = nearing(q);
      if (g == 0) return q;
      const Point& other = g < 0 ? b : a;
      const double g_other = g < 0 ? gb : ga, miss = -q.discriminant();
      const double meet =
          (-other.discriminant() - miss - 2 * g_other * (other.u - q.u)) / (2 * (g - g_other)); // from q.u
      if (miss + 2 * g * meet > kBent * (q.p.w * q.p.w + miss)) return q;
      if (g < 0) {
        a = q, ga = g, weight_a = 1;
        weight_b *= 0.5;
      } else {
        b = q, gb = g, weight_b = 1;
        weight_a *= 0.5;
      }
    }
    return nearest_point(a, b);
  }
  bool is_closed_at(const Point& q) const {
    return (q.u == first_ && (flags_ & CurveSegment::closed_start)) ||
           (q.u == last_ && (flags_ & CurveSegment::closed_end));
  }

  void add_ribbon_hit(const Point& a, const Point& b) {
    const Point q = nearest_point(a, b);
    if (!(q.discriminant() >= 0)) return;
    if ((q.u == a.u || q.u == b.u) && nearing(q) != 0 && !is_closed_at(q)) return;
    // The ray enters the tube that is straight there before the middle by half its chord, sqrt(D) over the
    // sine to the axis. A ray that leaves the ribbon begins in the tube or a little beyond it. Nearly along
    // the axis the curve is not straight for so long.
    constexpr double kLongest = 50;
    const double across2 = q.d.x * q.d.x + q.d.y * q.d.y, speed2 = across2 + q.d.z * q.d.z;
    const double half_chord2 = q.discriminant() + 0.1 * q.p.w * q.p.w; // 5 % of the radius beyond
    const double inverse_sine2 = std::min(speed2 / across2, kLongest * kLongest);
    if (q.p.z * q.p.z <= half_chord2 * inverse_sine2) return;
    add(q.p.z, q.u);
  }

  void add_tube_hit(Point a, Point b) {
    const Point near = met_point(a, b);
    if (is_behind(near)) return;
    const double da = a.discriminant(), db = b.discriminant();
    if (!(near.discriminant() >= 0 || da >= 0 || db >= 0)) return;
    // A piece that is only almost straight may pass the ray by at two places: s begins where D is 0 between a
    // miss and a hit.
    if (da < 0 && db > 0 && nearing(a) >= 0)
      a = at(root_between([this](double u) { return at(u).discriminant(); }, a.u, da, b.u, db));
    if (da > 0 && db < 0 && nearing(b) <= 0)
      b = at(root_between([this](double u) { return -at(u).discriminant(); }, a.u, -da, b.u, -db));
    const double fa = entering(a), fb = entering(b);
    // It may rise before it falls towards an end: each end is asked for.
    if (fa == 0 || (fa > 0 && is_closed_at(a))) add_entry(a);
    if (fb == 0 || (fb < 0 && is_closed_at(b))) add_entry(b);
    if (fa >= 0 || fb <= 0) return;
    double lo = a.u, f_lo = fa, hi = b.u, f_hi = fb;
    if (near.u > lo && near.u < hi) {
      const double f = entering(near);
      if (f == 0) return add_entry(near);
      if (f < 0)
        lo = near.u, f_lo = f;
      else
        hi = near.u, f_hi = f;
    }
    double u = straight_entry(near);
    if (!(u > lo && u < hi)) u = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
    const Point first = at(u);
    if (is_behind(first)) return;
    // A root of s', so that s is off by the square of that; u becomes a float.
    constexpr double kTolerance = 1e-7;
    const auto f = [this](double v) { return entering(at(v)); };
    add_entry(at(root_between(f, lo, f_lo, hi, f_hi, u, entering(first), kTolerance)));
  }
  /// Whether the ray begins beyond its entry into the ball at q. Then it begins beyond the least value of
  /// s, too: it leaves the tube.
  bool is_behind(const Point& q) const {
    const double d = q.discriminant();
    return d >= 0 && q.p.z - std::sqrt(d) < nearest_;
  }
  /// Where the ray enters a straight tube (or cone) that is the piece's tangent at q: with D(q.u + h) =
  /// D - 2 G h - k h^2, k = |v|^2 - r'^2, the root of z' sqrt(D) - D'/2.
  double straight_entry(const Point& q) const {
    const double g = nearing(q), k = q.d.x * q.d.x + q.d.y * q.d.y - q.d.w * q.d.w;
    const double middle = -g / k, greatest = q.discriminant() + g * g / k; // of D
    return q.u + middle - q.d.z * std::sqrt(greatest / (k * (k + q.d.z * q.d.z)));
  }
  void add_entry(const Point& q) {
    const double d = q.discriminant();
    // At a root D is above 0, or 0 but for rounding where the ray grazes the tube.
    if (d >= -1e-9 * q.p.w * q.p.w) add(q.p.z - std::sqrt(std::max(d, 0.0)), q.u);
  }

  void add(double distance, double u) {
    const auto t = static_cast<float>(distance / ray_.length);
    if (!(t > ray_.t_min && t < ray_.t_max) || (best_ && !(t < best_->t))) return;
    best_ = CurveHit{t, static_cast<float>(u)};
    farthest_ = distance;
  }

  std::uint32_t flags_;
  const CurveRay& ray_;
  glm::dvec4 c0_, c1_, c2_, c3_; ///< coefficients of the powers of u
  double first_ = 0, last_ = 1;  ///< u from and to where the piece is tested
  double nearest_, farthest_;    ///< distances that may be hits
  std::optional<CurveHit> best_;
};

} // namespace

CurveRay::CurveRay(const Ray& ray, float least, float greatest)
    : origin(ray.origin), length(glm::length(glm::dvec3(ray.direction))), t_min(least), t_max(greatest) {
  along = glm::dvec3(ray.direction) / length;
  const Across across(along);
  across_x = across.x, across_y = across.y;
}

std::optional<CurveHit> intersect_curve(const CurveSegment& segment, const CurveRay& ray) {
  return SeenCurve(segment, ray).closest_hit();
}

} // namespace candela::accel_detail
