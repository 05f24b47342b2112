#include "app/lab/medium_lesson.h"

#include "core/basis.h"

#include <cmath>

namespace candela {

namespace {

const Field<MediumLessonOptions> kMediumLessonFields[] = {
    {{"optical_depth",
      FieldType::real,
      0.01,
      100,
      "",
      "Of the slab along its normal: light goes one of it on the mean",
      Invalidates::nothing,
      {},
      true},
     [](MediumLessonOptions& o) -> void* { return &o.optical_depth; }},
    {{"albedo", FieldType::real, 0, 1, "", "Share of the light that a collision scatters, not absorbs"},
     [](MediumLessonOptions& o) -> void* { return &o.albedo; }},
    {{"theta", FieldType::angle, 0, 89, "degrees", "Between the light that falls in and the normal"},
     [](MediumLessonOptions& o) -> void* { return &o.theta; }},
    {{"phase", FieldType::choice, 0, 0, "", phase_type_field().help, Invalidates::nothing,
      phase_type_field().choices},
     [](MediumLessonOptions& o) -> void* { return &o.phase; }},
    {{"g", FieldType::real, -0.999, 0.999, "", "Mean cosine of the angle by which light turns"},
     [](MediumLessonOptions& o) -> void* { return &o.g; }},
    {{"diameter", FieldType::real, 5, 50, "micrometres", "Of the drops of water"},
     [](MediumLessonOptions& o) -> void* { return &o.diameter; }},
};

PhaseDesc phase_desc(const MediumLessonOptions& options) {
  PhaseDesc phase = default_phase(options.phase);
  for (const auto& row : phase_fields(phase))
    for (const auto& own : kMediumLessonFields)
      if (row.key == own.key)
        field_copy(row, row.address(phase), own.address(const_cast<MediumLessonOptions&>(options)));
  return phase;
}

// Exponential integrals (Abramowitz & Stegun 1964, section 5.1), for x >= 0.
double e1(double x) { return -std::expint(-x); }
double e2(double x) { return x > 0 ? std::exp(-x) - x * e1(x) : 1; }
double e3(double x) { return 0.5 * (std::exp(-x) - x * e2(x)); }

/// Solves a x = b in place, by Gauss; the matrix is dominated by its diagonal.
void solve(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
}

} // namespace

std::span<const Field<MediumLessonOptions>> medium_lesson_fields() { return kMediumLessonFields; }

bool medium_lesson_uses(const MediumLessonOptions& options, std::string_view key) {
  if (key != "g" && key != "diameter") return true;
  const PhaseDesc phase = default_phase(options.phase);
  return std::ranges::any_of(phase_fields(phase), [&](const auto& row) { return row.key == key; });
}

PhaseFunction MediumLessonOptions::phase_function() const { return make_phase(phase_desc(*this)); }

SlabShares isotropic_slab(double optical_depth, double albedo, double mu0) {
  // Cells are finer towards both faces, where S is steep.
  constexpr std::size_t kCells = 240;
  std::vector<double> border, matrix(kCells * kCells), source(kCells);
  for (std::size_t i = 0; i <= kCells; ++i)
    border.push_back(0.5 * optical_depth *
                     (1 - std::cos(std::numbers::pi * static_cast<double>(i) / kCells)));
  auto middle = [&](std::size_t i) { return 0.5 * (border[i] + border[i + 1]); };
  // The integral of E1(|t - t'|) over a cell, by its antiderivative.
  auto antiderivative = [](double from, double to) {
    return to < from ? e2(from - to) - 1 : 1 - e2(to - from);
  };
  for (std::size_t i = 0; i < kCells; ++i) {
    const double t = middle(i);
    for (std::size_t j = 0; j < kCells; ++j)
      matrix[i * kCells + j] =
          (i == j ? 1 : 0) - 0.5 * albedo * (antiderivative(t, border[j + 1]) - antiderivative(t, border[j]));
    // The mean of the cell rather than the value in its middle, so that all of the light comes in.
    source[i] = albedo / (4 * std::numbers::pi) *
                (std::exp(-border[i] / mu0) - std::exp(-border[i + 1] / mu0)) / (border[i + 1] - border[i]);
  }
  solve(matrix, source);
  SlabShares out;
  out.direct = std::exp(-optical_depth / mu0);
  for (std::size_t i = 0; i < kCells; ++i) {
    const double power = 2 * std::numbers::pi * source[i];
    out.reflected += power * (e3(border[i]) - e3(border[i + 1]));
    out.transmitted += power * (e3(optical_depth - border[i + 1]) - e3(optical_depth - border[i]));
  }
  out.absorbed = 1 - out.direct - out.reflected - out.transmitted;
  return out;
}

MediumLesson::MediumLesson(const MediumLessonOptions& options, SampleSource source, std::uint64_t samples)
    : options_(options), source_(source), samples_(samples) {
  const double mu0 = std::cos(static_cast<double>(options_.theta)),
               depth = static_cast<double>(options_.optical_depth);
  const auto omega = static_cast<double>(options_.albedo);
  exact_ = std::holds_alternative<IsotropicPhase>(default_phase(options_.phase).model);
  const double g = static_cast<double>(mean_cosine(options_.phase_function()));
  theory_ = isotropic_slab(depth * (1 - omega * g), omega * (1 - g) / (1 - omega * g), mu0);
  // What the similar slab lets through, but was scattered forward in this one.
  const double direct = std::exp(-depth / mu0);
  theory_.transmitted += theory_.direct - direct;
  theory_.direct = direct;
}

void MediumLesson::advance(std::uint64_t count) {
  const PhaseFunction phase = options_.phase_function();
  const vec3 inwards(std::sin(options_.theta), 0, std::cos(options_.theta)); // z is the depth
  const std::uint64_t end = done_ + std::min(count, samples_ - done_);
  constexpr std::uint32_t kMostFlights = 1u << 20; // of an albedo of 1 in a deep slab
  Sampler sampler = source_.sampler();
  for (; done_ < end; ++done_) {
    sampler.start({0, 0}, static_cast<std::uint32_t>(done_));
    vec3 direction = inwards;
    float z = 0;
    std::uint32_t scatterings = 0;
    for (std::uint32_t flight = 1;; ++flight) {
      sampler.set_bounce(flight);
      const vec2 u = sampler.get_2d(Dimension::medium_distance);
      const float length = -std::log1p(-u.x);
      if (flight == 1) {
        flights_.add(static_cast<double>(length));
        const auto bin = static_cast<std::size_t>(length / kLongestFlight * kFlightBins);
        if (bin < kFlightBins) ++flight_counts_[bin];
      }
      z += length * direction.z;
      const std::size_t order = std::min<std::size_t>(scatterings, kOrders - 1);
      if (z < 0) {
        ++reflected_, ++reflected_by_order_[order];
        break;
      }
      if (z > options_.optical_depth) {
        ++(scatterings == 0 ? direct_ : transmitted_);
        ++transmitted_by_order_[order];
        break;
      }
      if (!(u.y < options_.albedo) || flight == kMostFlights) {
        ++absorbed_;
        break;
      }
      ++scatterings;
      const vec2 v = sampler.get_2d(Dimension::bsdf_direction);
      const Turn turn = phase_sample(phase, v.x, sampler.get_1d(Dimension::bsdf_lobe));
      const float phi = 2 * kPi * v.y;
      direction = Basis::from_normal(direction).to_world(
          {turn.sine() * std::cos(phi), turn.sine() * std::sin(phi), turn.cosine()});
      direction = glm::normalize(direction);
    }
    scatterings_.add(static_cast<double>(scatterings));
  }
}

SlabShares MediumLesson::counted() const {
  const auto all = static_cast<double>(std::max<std::uint64_t>(done_, 1));
  return {static_cast<double>(reflected_) / all, static_cast<double>(transmitted_) / all,
          static_cast<double>(direct_) / all, static_cast<double>(absorbed_) / all};
}

double MediumLesson::error(double share) const {
  return std::sqrt(share * (1 - share) / static_cast<double>(std::max<std::uint64_t>(done_, 1)));
}

Plot MediumLesson::flight_plot() const {
  Plot plot;
  plot.title = "Density of the first free flight";
  plot.x = {"optical length", false, true};
  plot.y = {"", false, true};
  PlotSeries counted{"counted", {}}, theory{"exp(-length)", {}, true};
  const double width = static_cast<double>(kLongestFlight) / kFlightBins;
  for (std::size_t i = 0; i < kFlightBins; ++i) {
    const double x = (static_cast<double>(i) + 0.5) * width;
    counted.points.push_back({x, static_cast<double>(flight_counts_[i]) / width /
                                     static_cast<double>(std::max<std::uint64_t>(done_, 1))});
    // The mean of the bin.
    theory.points.push_back({x, std::exp(-x) * 2 * std::sinh(0.5 * width) / width});
  }
  plot.series = {std::move(counted), std::move(theory)};
  return plot;
}

Plot MediumLesson::order_plot() const {
  Plot plot;
  plot.title = "Share of the light by how often it was scattered";
  plot.x = {"times scattered", false, true};
  plot.y = {"", true};
  PlotSeries back{"reflected", {}}, through{"transmitted", {}};
  for (std::size_t i = 0; i + 1 < kOrders; ++i) { // the last has all that are higher
    const auto all = static_cast<double>(std::max<std::uint64_t>(done_, 1));
    back.points.push_back({static_cast<double>(i), static_cast<double>(reflected_by_order_[i]) / all});
    through.points.push_back({static_cast<double>(i), static_cast<double>(transmitted_by_order_[i]) / all});
  }
  plot.series = {std::move(back), std::move(through)};
  return plot;
}

} // namespace candela
