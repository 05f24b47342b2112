#include "render/camera/lens_system.h"

#include "render/camera/paraxial.h"
#include "sampling/warp.h"

#include <fmt/format.h>

#include <array>
#include <mutex>
#include <stdexcept>

namespace candela {

namespace {

constexpr double kGreatestMagnification = 0.5; ///< to which a lens is focused

using Surfaces = std::vector<LensSurface<double>>;

/// From the film to the scene; the last vertex is at 0.
Surfaces place_surfaces(std::span<const LensInterface> table, double scale) {
  Surfaces surfaces;
  double z = 0;
  for (std::size_t i = table.size(); i-- > 0;) {
    const LensInterface& row = table[i];
    if (i + 1 < table.size()) z += scale * static_cast<double>(row.thickness);
    const double eta_film = static_cast<double>(row.eta),
                 eta_scene = i > 0 ? static_cast<double>(table[i - 1].eta) : 1;
    const double radius = scale * static_cast<double>(row.curvature_radius);
    surfaces.push_back({z, radius == 0 ? 0 : -1 / radius, eta_film, eta_scene,
                        0.5 * scale * static_cast<double>(row.aperture_diameter),
                        radius == 0 && eta_film == eta_scene});
  }
  return surfaces;
}

std::size_t stop_index(const Surfaces& surfaces) {
  std::size_t i = 0;
  while (i < surfaces.size() && !surfaces[i].stop) ++i;
  return i;
}

LensSystem::CardinalPoints cardinal_points_of(const Surfaces& surfaces) {
  const double front = surfaces.back().z;
  const ParaxialRay to_film = trace_paraxial(surfaces, {1, 0, front + 1}, false);
  const ParaxialRay to_scene = trace_paraxial(surfaces, {1, 0, -1}, true);
  LensSystem::CardinalPoints c;
  c.focal_length = -1 / to_film.slope;
  c.rear_focus = to_film.axis_crossing(false);
  c.front_focus = to_scene.axis_crossing(true);
  c.rear_principal = c.rear_focus + c.focal_length;
  c.front_principal = c.front_focus - c.focal_length;
  return c;
}

/// The image of the stop through what lies on its one side; a ray from its middle of slope 1 leaves with the
/// inverse of the magnification.
LensSystem::Pupil pupil_of(const Surfaces& surfaces, bool to_scene) {
  const std::size_t stop = stop_index(surfaces);
  const std::span<const LensSurface<double>> all(surfaces);
  const ParaxialRay ray =
      trace_paraxial(to_scene ? all.subspan(stop + 1) : all.first(stop), {0, 1, surfaces[stop].z}, to_scene);
  return {ray.axis_crossing(to_scene), surfaces[stop].radius / std::abs(ray.slope)};
}

/// Where the rays of a point of the axis come closest together (the smallest mean square of their heights
/// over the film, uniform over the entrance pupil), so that a lens with spherical aberration is sharp, too.
/// `thick` is what the thick lens says; it stays where too few rays pass.
double best_film_distance(const Surfaces& surfaces, const LensSystem::Pupil& pupil, double object_z,
                          double thick) {
  constexpr int kRays = 64;
  double covariance = 0, variance = 0;
  int passed = 0;
  for (int i = 0; i < kRays; ++i) {
    const double height = pupil.radius * std::sqrt((i + 0.5) / kRays);
    const double before = surfaces.back().z + surfaces.back().radius; // in front of the lens
    glm::dvec3 d(0, 0, -1), p(height, 0, before);
    if (std::isfinite(object_z)) {
      d = glm::normalize(glm::dvec3(height, 0, pupil.z - object_z));
      p = glm::dvec3(0, 0, object_z);
    }
    bool lost = false;
    for (std::size_t k = surfaces.size(); k-- > 0 && !lost;)
      lost = !cross_lens_surface<false>(surfaces[k], p, d);
    if (lost) continue;
    ++passed;
    const double slope = d.x / -d.z, at_rear = p.x + slope * p.z;
    covariance += at_rear * slope;
    variance += slope * slope;
  }
  const double best = -covariance / variance;
  return passed >= kRays / 4 && best > 0 ? best : thick;
}

/// Sine of the angle at which the outermost ray of a point on the axis leaves for the film's middle.
double marginal_sine(const Surfaces& surfaces, double film_distance) {
  auto passes = [&](double height) {
    glm::dvec3 p(0, 0, -film_distance), d = glm::normalize(glm::dvec3(height, 0, film_distance));
    for (const LensSurface<double>& s : surfaces)
      if (!cross_lens_surface<true>(s, p, d)) return false;
    return true;
  };
  double inside = 0, outside = 2 * surfaces.front().radius;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (passes(middle) ? inside : outside) = middle;
  }
  return inside / std::hypot(inside, film_distance);
}

template <class Real>
bool positive(Real x) {
  return std::isfinite(x) && x > 0;
}

} // namespace

std::string lens_problem(std::span<const LensInterface> table) {
  constexpr std::size_t kMaxInterfaces = 128;
  if (table.size() < 2 || table.size() > kMaxInterfaces)
    return fmt::format("{} interfaces; a lens has 2 to {}", table.size(), kMaxInterfaces);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const LensInterface& row = table[i];
    const char* wrong = !std::isfinite(row.curvature_radius)                 ? "curvature radius"
                        : !std::isfinite(row.thickness) || row.thickness < 0 ? "thickness"
                        : !std::isfinite(row.eta) || row.eta < 1             ? "refractive index"
                        : !positive(row.aperture_diameter)                   ? "aperture diameter"
                                                                             : nullptr;
    if (wrong != nullptr) return fmt::format("interface {}: {} out of range", i, wrong);
    if (row.curvature_radius != 0 && row.aperture_diameter > 2 * std::abs(row.curvature_radius))
      return fmt::format("interface {}: its opening is wider than its sphere", i);
  }
  if (table.back().eta != 1) return "the film is not in air: the last interface has another index than 1";
  const Surfaces surfaces = place_surfaces(table, 1);
  if (std::count_if(surfaces.begin(), surfaces.end(), [](const auto& s) { return s.stop; }) != 1)
    return "it has not one aperture stop (a flat interface, in air)";
  const LensSystem::CardinalPoints c = cardinal_points_of(surfaces);
  if (!positive(c.focal_length) || !positive(-c.rear_focus)) return "it forms no real image behind itself";
  const LensSystem::Pupil entrance = pupil_of(surfaces, true);
  if (!std::isfinite(entrance.z) || !positive(entrance.radius)) return "its entrance pupil is at infinity";
  return {};
}

LensSystem::LensSystem(std::span<const LensInterface> table, const LensSetup& setup)
    : film_radius_(setup.film_radius) {
  if (const std::string problem = lens_problem(table); !problem.empty())
    throw std::invalid_argument("lens: " + problem);
  double scale = 1;
  if (setup.focal_length > 0)
    scale =
        static_cast<double>(setup.focal_length) / cardinal_points_of(place_surfaces(table, 1)).focal_length;
  Surfaces surfaces = place_surfaces(table, scale);
  cardinal_ = cardinal_points_of(surfaces);
  front_vertex_ = static_cast<float>(surfaces.back().z);

  LensSurface<double>& stop = surfaces[stop_index(surfaces)];
  const double widest = 0.5 * cardinal_.focal_length / pupil_of(surfaces, true).radius;
  const double f_number = std::max(widest, static_cast<double>(setup.f_stop));
  stop.radius *= widest / f_number;
  stop_radius_ = static_cast<float>(stop.radius);
  widest_f_number_ = static_cast<float>(widest);
  f_number_ = static_cast<float>(f_number);
  entrance_pupil_ = pupil_of(surfaces, true);
  exit_pupil_ = pupil_of(surfaces, false);

  // 1 / image + 1 / object = 1 / f, from the principal planes.
  const double nearest = (1 + 1 / kGreatestMagnification) * cardinal_.focal_length;
  const double object_z = std::max(entrance_pupil_.z + static_cast<double>(setup.focus_distance),
                                   cardinal_.front_principal + nearest);
  focus_distance_ = static_cast<float>(object_z - entrance_pupil_.z);
  const double image = 1 / (1 / cardinal_.focal_length - 1 / (object_z - cardinal_.front_principal));
  const double at_infinity = best_film_distance(
      surfaces, entrance_pupil_, std::numeric_limits<double>::infinity(), -cardinal_.rear_focus);
  film_distance_ =
      static_cast<float>(std::isfinite(object_z) ? best_film_distance(surfaces, entrance_pupil_, object_z,
                                                                      image - cardinal_.rear_principal)
                                                 : at_infinity);

  for (const LensSurface<double>& s : surfaces)
    surfaces_.push_back({static_cast<float>(s.z), static_cast<float>(s.curvature),
                         static_cast<float>(s.eta_film), static_cast<float>(s.eta_scene),
                         static_cast<float>(s.radius), s.stop});
  pupils_ = ExitPupils(surfaces_, {film_distance_, film_radius_, static_cast<float>(exit_pupil_.z)});

  double opening = std::numbers::pi; // of a stop of radius 1
  if (setup.blades >= 3) {
    const double n = setup.blades;
    opening = 0.5 * n * std::sin(2 * std::numbers::pi / n);
    blade_distance_ = stop_radius_ * static_cast<float>(std::cos(std::numbers::pi / n));
    for (int i = 0; i < setup.blades;
         ++i) { // to the middles of the sides; a corner is at +y (class Aperture)
      const double angle =
          static_cast<double>(setup.blade_rotation) + 2 * std::numbers::pi * ((i + 0.5) / n + 0.25);
      blade_normals_.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    }
  }
  axial_exposure_ = static_cast<float>(opening * std::pow(marginal_sine(surfaces, at_infinity), 2));
}

bool LensSystem::through_blades(float x, float y) const {
  for (const vec2& n : blade_normals_)
    if (n.x * x + n.y * y > blade_distance_) return false;
  return true;
}

template <bool to_scene>
std::optional<LensRay> LensSystem::trace(LensRay ray, std::vector<vec3>* path) const {
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const LensSurface<float>& s = surfaces_[to_scene ? i : surfaces_.size() - 1 - i];
    const bool passed = cross_lens_surface<to_scene>(s, ray.origin, ray.direction);
    if (path != nullptr && is_finite(ray.origin)) path->push_back(ray.origin);
    if (!passed || (s.stop && !through_blades(ray.origin.x, ray.origin.y))) return std::nullopt;
  }
  ray.direction = glm::normalize(ray.direction);
  return ray;
}

std::optional<LensRay> LensSystem::trace_from_film(const LensRay& ray) const {
  return trace<true>(ray, nullptr);
}

std::optional<LensRay> LensSystem::trace_from_scene(const LensRay& ray) const {
  return trace<false>(ray, nullptr);
}

std::vector<vec3> LensSystem::path_from_film(const LensRay& ray) const {
  std::vector<vec3> path;
  trace<true>(ray, &path);
  return path;
}

std::optional<LensSystem::PupilSample> LensSystem::sample_exit_pupil(vec2 film, vec2 u) const {
  const float radius = glm::length(film);
  const PupilEllipse pupil = pupils_.at(radius);
  if (!(pupil.semi_axes.x > 0)) return std::nullopt;
  const vec2 p = sample_uniform_disc(u) * pupil.semi_axes + vec2(pupil.center, 0);
  const vec2 axis = radius > 0 ? film / radius : vec2(1, 0); // turns +x to the film point
  return PupilSample{{axis.x * p.x - axis.y * p.y, axis.y * p.x + axis.x * p.y},
                     kPi * pupil.semi_axes.x * pupil.semi_axes.y};
}

double LensSystem::relative_illumination(float film_radius) const {
  constexpr int kSamples = 1 << 14;
  const vec2 film(film_radius, 0);
  const vec3 from(film, -film_distance_);
  double sum = 0;
  for (int i = 0; i < kSamples;
       ++i) { // the R2 sequence (Roberts 2018): no rows that lie along the pupil's rim
    const double x = 0.5 + 0.7548776662466927 * i, y = 0.5 + 0.5698402909980532 * i;
    const vec2 u(std::min(static_cast<float>(x - std::floor(x)), kOneMinusEpsilon),
                 std::min(static_cast<float>(y - std::floor(y)), kOneMinusEpsilon));
    const auto sample = sample_exit_pupil(film, u);
    if (!sample) return 0;
    if (trace_from_film({from, glm::normalize(vec3(sample->point, 0) - from)}))
      sum += static_cast<double>(sample_weight(film, *sample));
  }
  return sum / kSamples;
}

std::shared_ptr<const LensSystem> LensSystem::shared(std::span<const LensInterface> table,
                                                     const LensSetup& setup) {
  struct Entry {
    std::vector<LensInterface> table;
    LensSetup setup;
    std::shared_ptr<const LensSystem> lens;
  };
  static std::mutex mutex;
  static std::array<Entry, 4> recent; // two cameras beside each other, and the undone edit of each
  static std::size_t next = 0;
  const std::scoped_lock lock(mutex);
  for (const Entry& e : recent)
    if (e.lens && e.setup == setup && std::ranges::equal(e.table, table)) return e.lens;
  Entry& e = recent[next++ % recent.size()];
  e = {{table.begin(), table.end()}, setup, std::make_shared<const LensSystem>(table, setup)};
  return e.lens;
}

} // namespace candela
