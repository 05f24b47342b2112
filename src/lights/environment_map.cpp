#include "lights/environment_map.h"

#include "core/color.h"
#include "sampling/warp.h"

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

/// Below this share of the whole light, what is brighter than the mean is noise rather than lamps.
constexpr float kLeastBright = 1e-3f;

/// Between the corners upper left, upper right, lower left, lower right.
template <class T>
T mix_square(const std::array<T, 4>& at, vec2 f) {
  return glm::mix(glm::mix(at[0], at[1], f.x), glm::mix(at[2], at[3], f.x), f.y);
}

vec2 inside_unit_square(vec2 p) { return glm::clamp(p, vec2(0), vec2(kOneMinusEpsilon)); }

} // namespace

EnvironmentMap::EnvironmentMap(std::shared_ptr<const Panorama> panorama, EnvironmentMapping mapping,
                               const Progress* progress)
    : panorama_(std::move(panorama)), mapping_(mapping) {
  width_ = panorama_->image.width, height_ = panorama_->image.height;
  if (mapping_ == EnvironmentMapping::cross || mapping_ == EnvironmentMapping::faces) {
    faces_ = 6;
    cut_faces(progress);
    pad_faces();
  }
  full_ = make_density(0, progress);
  compensated_ = make_density(full_.total / (4 * kPi), progress);
  if (!(compensated_.total > kLeastBright * full_.total)) compensated_ = {};
}

/// Takes the faces' texels out of a cross or a column of faces.
void EnvironmentMap::cut_faces(const Progress* progress) {
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
    for (int y = 0; y < height_; ++y) {
      if (progress != nullptr) progress->check();
      for (int x = 0; x < width_; ++x) {
        ivec2 at = turned ? ivec2(width_ - 1 - x, height_ - 1 - y) : ivec2(x, y);
        ivec2 source = glm::min(square * ivec2(width_, height_) + at, ivec2(from.width - 1, from.height - 1));
        padded_faces_.at(x + 1, face * (height_ + 2) + y + 1) = from.at(source.x, source.y);
      }
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
        bordered.at(x + 1, face * (height_ + 2) + y + 1) = bilinear(beyond.face, square_of_st(beyond.st));
      }
  padded_faces_ = std::move(bordered);
}

/// Of a texel, or of one beyond the edge as interpolation continues it.
int EnvironmentMap::column(int x) const {
  if (faces_ == 6) return x + 1;
  if (mapping_ == EnvironmentMapping::latlong) return x < 0 ? x + width_ : (x >= width_ ? x - width_ : x);
  return std::clamp(x, 0, width_ - 1);
}

const vec3* EnvironmentMap::row(int face, int y) const {
  const Image& image = faces_ == 6 ? padded_faces_ : panorama_->image;
  const int line = faces_ == 6 ? face * (height_ + 2) + y + 1 : std::clamp(y, 0, height_ - 1);
  return image.pixels.data() + static_cast<std::ptrdiff_t>(line) * image.width;
}

/// About q of a face's square [0, 1]^2, y downwards.
EnvironmentMap::Corners EnvironmentMap::corners(int face, vec2 q) const {
  vec2 p = q * vec2(width_, height_) - 0.5f, base = glm::floor(p);
  const auto x = std::clamp(static_cast<int>(base.x), -1, width_ - 1);
  const auto y = std::clamp(static_cast<int>(base.y), -1, height_ - 1);
  return {row(face, y), row(face, y + 1), column(x), column(x + 1), p - base};
}

EnvironmentMap::Footprint EnvironmentMap::footprint(int face, vec2 q) const {
  Corners at = corners(face, q);
  return {{at.above[at.left], at.above[at.right], at.below[at.left], at.below[at.right]}, at.f};
}

Spectrum EnvironmentMap::bilinear(int face, vec2 q) const {
  Footprint at = footprint(face, q);
  return mix_square(at.texels, at.f);
}

EnvironmentMap::ChartPoint EnvironmentMap::chart_point(vec3 d) const {
  switch (mapping_) {
  case EnvironmentMapping::latlong: {
    float sine = std::sqrt(d.x * d.x + d.z * d.z);
    float u = std::atan2(d.x, -d.z) * (0.5f * kInvPi), v = std::atan2(sine, d.y) * kInvPi;
    return {0, inside_unit_square({u < 0 ? u + 1 : u, v})};
  }
  case EnvironmentMapping::angular: {
    float sine = std::sqrt(d.x * d.x + d.y * d.y), r = std::atan2(sine, -d.z) * kInvPi;
    vec2 around = sine > 0 ? vec2(d) / sine : vec2(1, 0);
    return {0, inside_unit_square(square_of_st(r * around))};
  }
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  FacePoint at = face_point(d);
  return {at.face, inside_unit_square(square_of_st(at.st))};
}

std::optional<vec3> EnvironmentMap::direction(ChartPoint at) const {
  switch (mapping_) {
  case EnvironmentMapping::latlong: {
    float phi = 2 * kPi * at.q.x, theta = kPi * at.q.y, sine = std::sin(theta);
    return vec3(sine * std::sin(phi), std::cos(theta), -sine * std::cos(phi));
  }
  case EnvironmentMapping::angular: {
    vec2 st = st_of_square(at.q);
    float r = glm::length(st);
    if (r >= 1) return std::nullopt;
    vec2 around = r > 0 ? st / r : vec2(0);
    return vec3(std::sin(kPi * r) * around, -std::cos(kPi * r));
  }
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  return face_direction(at.face, st_of_square(at.q));
}

/// Area of the chart, of which each face is 1 / faces_, over solid angle, at a point and its direction.
float EnvironmentMap::per_steradian(ChartPoint at, vec3 d) const {
  switch (mapping_) {
  case EnvironmentMapping::latlong:
    return 0.5f * sqr(kInvPi) / std::max(std::sqrt(d.x * d.x + d.z * d.z), kMinSine);
  case EnvironmentMapping::angular:
    return 0.25f * sqr(kInvPi) / angular_steradians(glm::length(st_of_square(at.q)));
  case EnvironmentMapping::cross:
  case EnvironmentMapping::faces: break;
  }
  return 1 / (24 * face_steradians(st_of_square(at.q)));
}

Spectrum EnvironmentMap::radiance(vec3 d) const {
  ChartPoint at = chart_point(d);
  return bilinear(at.face, at.q);
}

namespace {

/// What a texel has above the mean, or all that it has.
float weight(vec3 texel, float dark) { return std::max(luminance(texel) - dark, 0.0f); }

float mix_weights(const std::array<vec3, 4>& texels, vec2 f, float dark) {
  return mix_square(std::array{weight(texels[0], dark), weight(texels[1], dark), weight(texels[2], dark),
                               weight(texels[3], dark)},
                    f);
}

} // namespace

EnvironmentMap::Place EnvironmentMap::locate(vec3 d) const {
  ChartPoint point = chart_point(d);
  Corners at = corners(point.face, point.q);
  __builtin_prefetch(at.above + at.left);
  __builtin_prefetch(at.below + at.left);
  return {d, point.face, point.q};
}

EnvironmentMap::RadianceSample EnvironmentMap::lookup(const Place& at, EnvironmentDensity of) const {
  const Density& by = density(of);
  Footprint seen = footprint(at.face, at.q);
  vec2 p = at.q * vec2(width_, height_);
  const int x = std::min(static_cast<int>(p.x), width_ - 1), y = std::min(static_cast<int>(p.y), height_ - 1);
  return {at.direction, mix_square(seen.texels, seen.f),
          mix_weights(seen.texels, seen.f, by.dark) * factor(by, x, y) *
              per_steradian({at.face, at.q}, at.direction)};
}

/// A texel by what it sends, then a place in it: the weight is linear in x and in y between its centre and
/// its edges.
std::optional<EnvironmentMap::RadianceSample> EnvironmentMap::sample(vec2 u, EnvironmentDensity of) const {
  const Density& by = density(of);
  WeightedGrid::Sample cell = by.texels.sample(u);
  const auto x = static_cast<int>(cell.column), line = static_cast<int>(cell.row);
  const int face = line / height_, y = line % height_;
  float at_rows[3][3]; // weights at the edges and the centre of the texel along x, at the rows' centres
  for (int j = 0; j < 3; ++j) {
    const vec3* texels = row(face, y + j - 1);
    const float left = weight(texels[column(x - 1)], by.dark), middle = weight(texels[column(x)], by.dark),
                right = weight(texels[column(x + 1)], by.dark);
    at_rows[j][0] = 0.5f * (left + middle), at_rows[j][1] = middle, at_rows[j][2] = 0.5f * (middle + right);
  }
  float top[3], bottom[3];
  for (int i = 0; i < 3; ++i) {
    top[i] = 0.5f * (at_rows[0][i] + at_rows[1][i]);
    bottom[i] = 0.5f * (at_rows[1][i] + at_rows[2][i]);
  }
  const float* center = at_rows[1];
  auto along_x = [](const float* l) { return l[0] + 2 * l[1] + l[2]; }; // four times the mean
  vec2 p;
  p.y = sample_linear(cell.u.y, along_x(top), along_x(center), along_x(bottom));
  const bool upper = p.y < 0.5f;
  const float down = upper ? 2 * p.y : 2 * p.y - 1;
  float l[3];
  for (int i = 0; i < 3; ++i)
    l[i] = upper ? glm::mix(top[i], center[i], down) : glm::mix(center[i], bottom[i], down);
  p.x = sample_linear(cell.u.x, l[0], l[1], l[2]);

  ChartPoint at{face, inside_unit_square((vec2(x, y) + p) / vec2(width_, height_))};
  auto d = direction(at);
  if (!d) return std::nullopt;
  Footprint seen = footprint(face, at.q);
  const float pdf = mix_weights(seen.texels, seen.f, by.dark) * factor(by, x, y) * per_steradian(at, *d);
  if (!(pdf > 0)) return std::nullopt; // the very end of a ramp that begins at nothing
  return RadianceSample{*d, mix_square(seen.texels, seen.f), pdf};
}

/// Of a texel: exact for latlong, by its centre for the others. One on the rim of an angular map is weighed
/// by its current point, so that none that reaches into the disc has no weight.
double EnvironmentMap::texel_solid_angle(int x, int y) const {
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

/// What makes weights a density on the chart.
float EnvironmentMap::factor(const Density& by, int x, int y) const {
  if (!by.row_factor.empty()) return by.row_factor[static_cast<std::size_t>(y)];
  return by.total > 0 ? static_cast<float>(texel_solid_angle(x, y)) * by.per_luminance : 0;
}

EnvironmentMap::Density EnvironmentMap::make_density(float dark, const Progress* progress) const {
  Density made;
  made.dark = dark;
  std::vector<float> weights;
  weights.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_ * faces_));
  double total = 0;
  // Between centres the weight is a ramp: its mean over a texel has the weights 1/8, 3/4, 1/8 in either
  // direction.
  constexpr float kShare[3] = {0.125f, 0.75f, 0.125f};
  const bool same_in_row = mapping_ == EnvironmentMapping::latlong; // and two sines a texel take longest
  for (int face = 0; face < faces_; ++face)
    for (int y = 0; y < height_; ++y) {
      if (progress != nullptr) progress->check();
      double solid_angle = texel_solid_angle(0, y);
      for (int x = 0; x < width_; ++x) {
        if (!same_in_row) solid_angle = texel_solid_angle(x, y);
        float mean = 0;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i)
            mean += kShare[i] * kShare[j] * weight(texel(face, x + i - 1, y + j - 1), dark);
        double sent = static_cast<double>(mean) * solid_angle;
        total += sent;
        weights.push_back(static_cast<float>(sent));
      }
    }
  made.total = static_cast<float>(total);
  made.texels = WeightedGrid(weights, static_cast<std::size_t>(width_), progress);
  if (!(total > 0)) return made;
  made.per_luminance = static_cast<float>(static_cast<double>(weights.size()) / total);
  if (mapping_ == EnvironmentMapping::latlong)
    for (int y = 0; y < height_; ++y)
      made.row_factor.push_back(static_cast<float>(texel_solid_angle(0, y)) * made.per_luminance);
  return made;
}

std::size_t EnvironmentMap::memory_bytes() const {
  return (panorama_->image.pixels.size() + padded_faces_.pixels.size()) * sizeof(vec3) +
         full_.texels.memory_bytes() + compensated_.texels.memory_bytes();
}

} // namespace candela
