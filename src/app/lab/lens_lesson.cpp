#include "app/lab/lens_lesson.h"

#include "render/camera/lens_section.h"
#include "render/camera/lenses.h"

namespace candela {

namespace {

constexpr float kFilmRadius = 17.5f; ///< millimetres: a film of 35 mm across its diagonal

std::span<const std::string_view> lens_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> keys;
    for (const LensPrescription& lens : kLenses) keys.push_back(lens.key);
    return keys;
  }();
  return names;
}

Plot blur_plot(const LensSystem& lens) {
  Plot plot;
  plot.title = "Spot of a point on the axis, mm";
  plot.x = {"distance, m", true};
  plot.y = {"", true};
  PlotSeries through{"this lens", {}}, thin{"a thin lens", {}};
  constexpr int kSteps = 96;
  const double nearest = 2e-3 * lens.focal_length(), farthest = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double metres = nearest * std::pow(farthest / nearest, static_cast<double>(i) / kSteps);
    const auto distance = static_cast<float>(1000 * metres);
    through.points.push_back({metres, static_cast<double>(lens_blur(lens, distance))});
    thin.points.push_back({metres, static_cast<double>(thin_lens_blur(lens, distance))});
  }
  plot.series = {std::move(through), std::move(thin)};
  return plot;
}

Plot vignetting_plot(const LensSystem& lens) {
  Plot plot;
  plot.title = "Light over the film's radius";
  plot.x = {"radius, mm", false, true};
  plot.y = {"", false, true};
  PlotSeries through{"this lens", {}};
  constexpr int kRadii = 16;
  for (int i = 0; i <= kRadii; ++i) {
    const float radius = kFilmRadius * static_cast<float>(i) / kRadii;
    through.points.push_back({static_cast<double>(radius), lens.relative_illumination(radius)});
  }
  // As seen from the paraxial exit pupil, without vignetting by openings.
  PlotSeries cosines{"cos^4", {}, true};
  const double distance = lens.exit_pupil().z + static_cast<double>(lens.film_distance());
  for (const PlotPoint& p : through.points) {
    const double cos2 = 1 / (1 + std::pow(p.x / distance, 2));
    cosines.points.push_back({p.x, through.points.front().y * cos2 * cos2});
  }
  plot.series = {std::move(through), std::move(cosines)};
  return plot;
}

} // namespace

std::span<const Field<LensOptions>> lens_fields() {
  static const Field<LensOptions> rows[] = {
      {{"lens", FieldType::choice, 0, 0, "", "A published design", Invalidates::nothing, lens_names()},
       [](LensOptions& o) -> void* { return &o.lens; }},
      {{"f_stop", FieldType::real, 0, 64, "",
        "Focal length over the diameter of the entrance pupil; 0: wide open"},
       [](LensOptions& o) -> void* { return &o.f_stop; }},
      {{"focus",
        FieldType::real,
        0.1,
        1000,
        "m",
        "Distance of the plane in focus from the entrance pupil",
        Invalidates::nothing,
        {},
        true},
       [](LensOptions& o) -> void* { return &o.focus; }},
      {{"film_height", FieldType::real, 0, static_cast<double>(kFilmRadius), "mm",
        "Of the film point from the axis"},
       [](LensOptions& o) -> void* { return &o.film_height; }},
  };
  return rows;
}

LensLesson::LensLesson(const LensOptions& options, SampleSource source, std::uint64_t samples)
    : options_(options), source_(source), samples_(samples) {
  const LensPrescription& lens = kLenses[static_cast<std::size_t>(options.lens)];
  lens_ = LensSystem::shared(lens.interfaces,
                             {lens.focal_length, options.f_stop, 1000 * options.focus, kFilmRadius, 0, 0});
  plots_ = std::make_shared<const Plots>(Plots{candela::blur_plot(*lens_), candela::vignetting_plot(*lens_)});
}

void LensLesson::advance(std::uint64_t count) {
  const std::uint64_t end = done_ + std::min(count, samples_ - done_);
  const vec2 film(options_.film_height, 0);
  const vec3 from(film, -lens_->film_distance());
  Sampler sampler = source_.sampler();
  for (; done_ < end; ++done_) {
    sampler.start({0, 0}, static_cast<std::uint32_t>(done_));
    const auto pupil = lens_->sample_exit_pupil(film, sampler.get_2d(Dimension::lens));
    const bool passes =
        pupil && lens_->trace_from_film({from, glm::normalize(vec3(pupil->point, 0) - from)}).has_value();
    passed_ += passes ? 1 : 0;
    weights_.add(passes ? static_cast<double>(lens_->sample_weight(film, *pupil)) : 0);
  }
}

double LensLesson::passing() const {
  return done_ > 0 ? static_cast<double>(passed_) / static_cast<double>(done_) : 0;
}

} // namespace candela
