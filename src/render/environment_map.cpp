#include "render/environment_map.h"

#include "core/color.h"

namespace candela {

namespace {

/// Keeps densities finite where a mapping squeezes a curve into a point; the solid angle concerned is 1e-11
/// of the sphere's.
constexpr float kMinSine = 1e-6f;

/// A cube's faces in the order of EnvironmentMapping::faces: what lies ahead, to the right and upwards.
struct FaceAxes {
  vec3 ahead, right, up;
};
const std::array<FaceAxes, 6> kFaces = {{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                         {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
                                         {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

struct FacePoint {
  int face;
  vec2 st; ///< in [-1, 1]^2, to the right and upwards
};

FacePoint face_point(vec3 d) {
  vec3 a = glm::abs(d);
  int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
  const FaceAxes& axes = kFaces[static_cast<std::size_t>(face)];
  return {face, vec2(glm::dot(d, axes.right), glm::dot(d, axes.up)) / a[axis]};
}

vec3 face_direction(int face, vec2 st) {
  const FaceAxes& axes = kFaces[static_cast<std::size_t>(face)];
  return glm::normalize(axes.ahead + st.x * axes.right + st.y * axes.up);
}

/// From the face's own square, y downwards, to st and back.
vec2 st_of_square(vec2 q) { return {2 * q.x - 1, 1 - 2 * q.y}; }
vec2 square_of_st(vec2 st) { return {0.5f * (st.x + 1), 0.5f * (1 - st.y)}; }

/// Solid angle over area of the square [-1, 1]^2 of a cube's face.
float face_steradians(vec2 st) {
  float r2 = 1 + glm::dot(st, st);
  return 1 / (r2 * std::sqrt(r2));
}

/// sin(pi r) / (pi r): how an angular map shrinks circles towards its rim.
float angular_steradians(float r) {
  float x = kPi * r;
  return x > 1e-3f ? std::max(std::sin(x) / x, kMinSine) : 1;
}

vec2 inside_unit_square(vec2 p) { return glm::clamp(p, vec2(0), vec2(kOneMinusEpsilon)); }

/// Which of `cells` a texel begins in, and the share of the texel that lies there; the rest is in the next.
struct Overlap {
  int cell;
  float share;
};
Overlap overlap(int texel, int texels, int cells) {
  auto cell = static_cast<int>(std::int64_t{texel} * cells / texels);
  double end = (cell + 1.0) * texels / cells - texel;
  return {cell, static_cast<float>(std::min(end, 1.0))};
}

} // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Panorama> panorama, EnvironmentMapping mapping)
    : panorama_(std::move(panorama)), mapping_(mapping) {
  width_ = panorama_->image.width, height_ = panorama_->image.height;
  if (mapping_ == EnvironmentMapping::cross || mapping_ == EnvironmentMapping::faces) {
    faces_ = 6;
    cut_faces();
    pad_faces();
  }
  build_distribution();
}

/// Takes the faces' texels out of a cross or a column of faces.
void EnvironmentMap::cut_faces() {
  const Image& from = panorama_->image;
  bool column = mapping_ == EnvironmentMapping::faces, upright = from.height > from.width;
  ivec2 squares = column ? ivec2(1, 6) : (upright ? ivec2(3, 4) : ivec2(4, 3));
  constexpr ivec2 kInCross[6] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {3, 1}, {1, 1}};
  width_ = std::max(from.width / squares.x, 1), height_ = std::max(from.height / squares.y, 1);
  padded_faces_ = {width_ + 2, 6 * (height_ + 2), {}};
  padded_faces_.pixels.resize(static_cast<std::size_t>(width_ + 2) *
                              static_cast<std::size_t>(6 * (height_ + 2)));
  for (int face = 0; face < 6; ++face) {
    ivec2 square = column ? ivec2(0, face) : kInCross[face];
    bool turned = !column && upright && face == 4;
    if (turned) square = {1, 3};
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        ivec2 at = turned ? ivec2(width_ - 1 - x, height_ - 1 - y) : ivec2(x, y);
        ivec2 source = glm::min(square * ivec2(width_, height_) + at, ivec2(from.width - 1, from.height - 1));
        padded_faces_.at(x + 1, face * (height_ + 2) + y + 1) = from.at(source.x, source.y);
      }
  }
}

/// The border of a face is what its neighbours have there, so that no edge shows.
void EnvironmentMap::pad_faces() {
  for (int face = 0; face < 6; ++face) // first of all its own: a neighbour's corner may look there
    for (int y = -1; y <= height_; ++y)
      for (int x = -1; x <= width_; ++x) {
        ivec2 own = glm::clamp(ivec2(x, y), ivec2(0), ivec2(width_ - 1, height_ - 1));
        if (own != ivec2(x, y))
          padded_faces_.at(x + 1, face * (height_ + 2) + y + 1) = texel(face, own.x, own.y);
      }
  Image bordered = padded_faces_;
  vec2 size(width_, height_);
  for (int face = 0; face < 6; ++face)
    for (int y = -1; y <= height_; ++y)
      for (int x = -1; x <= width_; ++x) {
        if (x >= 0 && x < width_ && y >= 0 && y < height_) continue;
        vec2 st = st_of_square((vec2(x, y) + 0.5f) / size);
        FacePoint beyond = face_point(face_direction(face, st));
        bordered.at(x + 1, face * (height_ + 2) + y + 1) = lookup(beyond.face, square_of_st(beyond.st));
      }
  padded_faces_ = std::move(bordered);
}

/// A texel of a face, or one beyond its edge as interpolation continues it.
vec3 EnvironmentMap::texel(int face, int x, int y) const {
  const Image& image = panorama_->image;
  switch (mapping_) {
  case EnvironmentMapping::latlong:
    x = x < 0 ? x + width_ : (x >= width_ ? x - width_ : x);
    return image.at(x, std::clamp(y, 0, height_ - 1));
  case EnvironmentMapping::angular:
    return image.at(std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1));
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  return padded_faces_.at(x + 1, face * (height_ + 2) + y + 1);
}

/// At q of a face's square [0, 1]^2, y downwards.
vec3 EnvironmentMap::lookup(int face, vec2 q) const {
  vec2 p = q * vec2(width_, height_) - 0.5f, base = glm::floor(p), f = p - base;
  auto x = std::clamp(static_cast<int>(base.x), -1, width_ - 1);
  auto y = std::clamp(static_cast<int>(base.y), -1, height_ - 1);
  return glm::mix(glm::mix(texel(face, x, y), texel(face, x + 1, y), f.x),
                  glm::mix(texel(face, x, y + 1), texel(face, x + 1, y + 1), f.x), f.y);
}

EnvironmentMap::ChartPoint EnvironmentMap::chart_point(vec3 d) const {
  switch (mapping_) {
  case EnvironmentMapping::latlong: {
    float sine = std::sqrt(d.x * d.x + d.z * d.z);
    float u = std::atan2(d.x, -d.z) * (0.5f * kInvPi), v = std::atan2(sine, d.y) * kInvPi;
    return {inside_unit_square({u < 0 ? u + 1 : u, v}), 0.5f * sqr(kInvPi) / std::max(sine, kMinSine)};
  }
  case EnvironmentMapping::angular: {
    float sine = std::sqrt(d.x * d.x + d.y * d.y), r = std::atan2(sine, -d.z) * kInvPi;
    vec2 around = sine > 0 ? vec2(d) / sine : vec2(1, 0);
    return {inside_unit_square(square_of_st(r * around)), 0.25f * sqr(kInvPi) / angular_steradians(r)};
  }
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  FacePoint at = face_point(d);
  vec2 q = glm::clamp(square_of_st(at.st), vec2(0), vec2(1 - 1e-6f)); // or rounding ends in the next face
  return {{q.x, (static_cast<float>(at.face) + q.y) / 6}, 1 / (24 * face_steradians(at.st))};
}

std::optional<vec3> EnvironmentMap::direction(vec2 p) const {
  switch (mapping_) {
  case EnvironmentMapping::latlong: {
    float phi = 2 * kPi * p.x, theta = kPi * p.y, sine = std::sin(theta);
    return vec3(sine * std::sin(phi), std::cos(theta), -sine * std::cos(phi));
  }
  case EnvironmentMapping::angular: {
    vec2 st = st_of_square(p);
    float r = glm::length(st);
    if (r >= 1) return std::nullopt;
    vec2 around = r > 0 ? st / r : vec2(0);
    return vec3(std::sin(kPi * r) * around, -std::cos(kPi * r));
  }
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  float y = 6 * p.y;
  int face = std::min(static_cast<int>(y), 5);
  return face_direction(face, st_of_square({p.x, y - static_cast<float>(face)}));
}

vec3 EnvironmentMap::radiance(vec3 d) const {
  vec2 p = chart_point(d).p;
  if (faces_ == 1) return lookup(0, p);
  float y = 6 * p.y;
  int face = std::min(static_cast<int>(y), 5);
  return lookup(face, {p.x, y - static_cast<float>(face)});
}

std::optional<vec3> EnvironmentMap::sample(vec2 u) const { return direction(distribution_.sample(u).p); }

float EnvironmentMap::pdf(vec3 d) const {
  ChartPoint at = chart_point(d);
  return distribution_.pdf(at.p) * at.per_steradian;
}

/// Of a texel: exact for latlong, by its centre for the others. One on the rim of an angular map is weighed
/// by its innermost point, so that none that reaches into the disc has no weight.
double EnvironmentMap::cell_solid_angle(int x, int y) const {
  vec2 size(width_, height_), q = (vec2(x, y) + 0.5f) / size;
  switch (mapping_) {
  case EnvironmentMapping::latlong: {
    double step = std::numbers::pi / height_; // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2)
    return 2 * std::numbers::pi / width_ * 2 * std::sin((y + 0.5) * step) * std::sin(0.5 * step);
  }
  case EnvironmentMapping::angular: {
    vec2 half = 1.0f / size, st = glm::abs(st_of_square(q));
    bool whole = glm::length(st + half) < 1;
    float r = glm::length(whole ? st : glm::max(st - half, vec2(0)));
    if (r >= 1) return 0;
    return static_cast<double>(4 * sqr(kPi) * angular_steradians(r) / (size.x * size.y));
  }
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  return static_cast<double>(4 * face_steradians(st_of_square(q)) / (size.x * size.y));
}

void EnvironmentMap::build_distribution() {
  int most = faces_ == 1 ? kMaxCells : kMaxCells / 2;
  int columns = std::min(width_, most), rows = std::min(height_, most);
  cells_ = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows * faces_);
  std::vector<float> weights(cells_);
  double total = 0;
  // A texel's cell sees a linear ramp to each neighbour: the mean of the interpolated radiance over it has
  // the weights 1/8, 3/4, 1/8 in either direction.
  constexpr float kShare[3] = {0.125f, 0.75f, 0.125f};
  for (int face = 0; face < faces_; ++face)
    for (int y = 0; y < height_; ++y) {
      Overlap row = overlap(y, height_, rows);
      for (int x = 0; x < width_; ++x) {
        float mean = 0;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i)
            mean += kShare[i] * kShare[j] * luminance(texel(face, x + i - 1, y + j - 1));
        double weight = static_cast<double>(mean) * cell_solid_angle(x, y);
        total += weight;
        Overlap column = overlap(x, width_, columns);
        auto add = [&](int i, int j, float share) {
          if (!(share > 0)) return;
          auto cell =
              static_cast<std::size_t>(face * rows + row.cell + j) * static_cast<std::size_t>(columns) +
              static_cast<std::size_t>(column.cell + i);
          weights[cell] += share * static_cast<float>(weight);
        };
        add(0, 0, column.share * row.share);
        add(1, 0, (1 - column.share) * row.share);
        add(0, 1, column.share * (1 - row.share));
        add(1, 1, (1 - column.share) * (1 - row.share));
      }
    }
  total_luminance_ = static_cast<float>(total);
  distribution_ = PiecewiseConstant2D(weights, static_cast<std::size_t>(columns),
                                      static_cast<std::size_t>(rows * faces_));
}

std::size_t EnvironmentMap::memory_bytes() const {
  return (panorama_->image.pixels.size() + padded_faces_.pixels.size()) * sizeof(vec3) +
         cells_ * 2 * sizeof(float); // distribution function and density
}

} // namespace candela
