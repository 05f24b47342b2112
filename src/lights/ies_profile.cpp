#include "lights/ies_profile.h"

namespace candela {

namespace {

struct PolarAngles {
  float vertical, horizontal;
};

PolarAngles polar_angles(PhotometricType type, vec3 d) {
  // The arc tangents keep their digits near the poles, where an arc cosine loses them.
  switch (type) {
  case PhotometricType::c: break;
  case PhotometricType::a: return {std::atan2(std::hypot(d.x, d.y), -d.z), std::atan2(-d.y, d.x)};
  case PhotometricType::b: return {std::atan2(std::hypot(d.y, d.z), -d.x), std::atan2(-d.y, -d.z)};
  }
  return {std::atan2(std::hypot(d.x, d.y), -d.z), std::atan2(d.y, d.x)};
}

/// Between which two of the ascending angles x lies, and how far.
struct Segment {
  std::size_t first = 0, second = 0;
  float f = 0;
  bool inside = false;
};
Segment segment(const std::vector<float>& angles, float x) {
  constexpr float kRounding = 1e-5f;
  Segment s;
  if (!(x >= angles.front() - kRounding && x <= angles.back() + kRounding)) return s;
  s.inside = true;
  const auto above = std::ranges::upper_bound(angles, x);
  s.second = std::min(static_cast<std::size_t>(above - angles.begin()), angles.size() - 1);
  s.first = s.second > 0 ? s.second - 1 : 0;
  const float step = angles[s.second] - angles[s.first];
  s.f = step > 0 ? std::clamp((x - angles[s.first]) / step, 0.0f, 1.0f) : 0;
  return s;
}

} // namespace

float IesProfile::intensity(vec3 direction_local) const {
  const PolarAngles at = polar_angles(type, direction_local);
  const Segment v = segment(vertical, at.vertical);
  if (!v.inside) return 0;
  auto along = [&](std::size_t row) {
    const float* values = &candela[row * vertical.size()];
    return glm::mix(values[v.first], values[v.second], v.f);
  };
  if (horizontal.size() == 1) return along(0);
  float turn = at.horizontal;
  // Into the turn that begins at the first angle; what lies just before that belongs to it.
  constexpr float kTurn = 2 * kPi, kRounding = 1e-5f;
  while (turn < horizontal.front() - kRounding) turn += kTurn;
  while (turn >= horizontal.front() + kTurn) turn -= kTurn;
  const Segment h = segment(horizontal, turn);
  return h.inside ? glm::mix(along(h.first), along(h.second), h.f) : 0;
}

float IesProfile::maximum() const { return *std::ranges::max_element(candela); }

float IesProfile::relative_intensity(vec3 direction_local) const {
  const float most = maximum();
  return most > 0 ? intensity(direction_local) / most : 0;
}

/// In the vertical angle t the intensity is a + b t between two nodes: the integral of that times sin t is
/// that of parts. In the horizontal angle it is the trapezoid.
double IesProfile::flux() const {
  auto meridian = [&](std::size_t row) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < vertical.size(); ++i) {
      const double t0 = static_cast<double>(vertical[i]), t1 = static_cast<double>(vertical[i + 1]);
      const double y0 = static_cast<double>(candela[row * vertical.size() + i]);
      const double y1 = static_cast<double>(candela[row * vertical.size() + i + 1]);
      sum += y0 * std::cos(t0) - y1 * std::cos(t1) + (y1 - y0) / (t1 - t0) * (std::sin(t1) - std::sin(t0));
    }
    return sum;
  };
  if (horizontal.size() == 1) return 2 * std::numbers::pi * meridian(0);
  double sum = 0, before = meridian(0);
  for (std::size_t i = 1; i < horizontal.size(); ++i) {
    const double here = meridian(i);
    sum += 0.5 * (before + here) * static_cast<double>(horizontal[i] - horizontal[i - 1]);
    before = here;
  }
  return sum;
}

const char* ies_profile_problem(const IesProfile& p) {
  constexpr float kRounding = 1e-4f;
  if (p.vertical.empty() || p.horizontal.empty()) return "it has no angles";
  if (p.candela.size() != p.vertical.size() * p.horizontal.size()) return "its values do not fit its angles";
  auto ascend = [](const std::vector<float>& angles) {
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (!std::isfinite(angles[i]) || (i > 0 && !(angles[i] > angles[i - 1]))) return false;
    return true;
  };
  if (!ascend(p.vertical) || !ascend(p.horizontal)) return "its angles do not ascend";
  if (p.vertical.front() < -kRounding || p.vertical.back() > kPi + kRounding ||
      p.horizontal.back() - p.horizontal.front() > 2 * kPi + kRounding || std::abs(p.horizontal.front()) > 10)
    return "its angles are out of range";
  for (float value : p.candela)
    if (!(value >= 0 && value < kInfinity)) return "a value is no intensity";
  return "";
}

} // namespace candela
