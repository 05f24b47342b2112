// The lab's pages on estimates: the samples, the estimate, and how its error falls.

#include "app/lab/lab_drawing.h"
#include "app/lab/lab_job.h"
#include "app/lab/lab_pages.h"
#include "app/ui/plot_widget.h"
#include "lab/experiments.h"

#include <fmt/format.h>

#include <deque>
#include <optional>

namespace candela {

namespace {

struct Run {
  int samples = 1000000;
  int streams = 1;
  bool every_sampler = false;
  bool operator==(const Run&) const = default;
};

const Field<Run> kRunFields[] = {
    {{"samples", FieldType::integer, 1, 1e9, "", "Samples to draw of each stream"},
     [](Run& o) -> void* { return &o.samples; }},
    {{"streams", FieldType::integer, 1, 256, "",
      "Independent repetitions, each a pixel of its own: the plot shows the root of their mean squared "
      "error"},
     [](Run& o) -> void* { return &o.streams; }},
    {{"every_sampler", FieldType::boolean, 0, 0, "", "Run every sampler, to compare their errors"},
     [](Run& o) -> void* { return &o.every_sampler; }},
};

constexpr std::uint64_t kShownDraws = 6000; // more would overlap

void draw_experiment(const LabCanvas& canvas, const Estimation<PiExperiment>& lesson, float unit) {
  for (std::uint64_t i = 0; i < std::min(lesson.done(), kShownDraws); ++i) {
    const Draw draw = lesson.replay(i);
    canvas.dot(draw.position, 1.5f * unit, draw.hit ? kLabHit : kLabMiss);
  }
  canvas.circle(vec2(0), 1, kLabInk, 1.5f * unit);
}

void draw_experiment(const LabCanvas& canvas, const Estimation<SolidAngleExperiment>& lesson, float unit) {
  for (std::uint64_t i = 0; i < std::min(lesson.done(), kShownDraws); ++i) {
    const Draw draw = lesson.replay(i);
    canvas.dot(draw.position, 1.5f * unit, draw.hit ? kLabHit : kLabMiss);
  }
  canvas.circle(vec2(0), 1, kLabGrid, unit);                                      // the horizon
  canvas.circle(vec2(0), std::numbers::sqrt2_v<float> / 2, kLabInk, 1.5f * unit); // the disc's edge
}

void draw_experiment(const LabCanvas& canvas, const Estimation<IntegralExperiment>& lesson, float unit) {
  const IntegralExperiment& experiment = lesson.experiment();
  constexpr int kSteps = 400;
  std::vector<vec2> curve, density;
  for (int i = 0; i < kSteps; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / kSteps;
    curve.emplace_back(x, static_cast<float>(experiment.value(static_cast<double>(x))));
    // Scaled by the integral: where the curve equals f, f / pdf is constant.
    density.emplace_back(x, static_cast<float>(experiment.pdf(x) * experiment.expected()));
  }
  for (std::uint64_t i = 0; i < std::min<std::uint64_t>(lesson.done(), 400); ++i) {
    const Draw draw = lesson.replay(i);
    canvas.line({draw.position.x, 0}, draw.position, IM_COL32(86, 180, 233, 70));
    canvas.dot(draw.position, 2 * unit, kLabHit);
  }
  canvas.curve(density, kLabMiss, 1.5f * unit);
  canvas.curve(curve, kLabInk, 1.5f * unit);
}

struct Picture {
  vec2 lo, hi;
  float aspect; ///< width over height
  const char* caption;
};
Picture picture_of(const PiExperiment&) {
  return {vec2(-1.02f), vec2(1.02f), 1, "The first 6000 points: hits in blue, misses in orange"};
}
Picture picture_of(const SolidAngleExperiment&) {
  return {vec2(-1.02f), vec2(1.02f), 1, "Directions from above; the inner circle is the disc's edge"};
}
Picture picture_of(const IntegralExperiment&) {
  return {{0, -0.02f}, {1, 1.06f}, 2, "White: f. Orange: the pdf times the integral. Blue: draws"};
}

template <class E>
class EstimatePage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    sampler_fields(ui, sampler);
    const Run default_run;
    for (const auto& row : kRunFields) lab_field(ui, row, run_, default_run);
    const typename E::Options default_options{};
    for (const auto& row : E::fields()) lab_field(ui, row, options_, default_options);
    restart_what_changed(sample_source(sampler.settings.sampler));

    chosen_ = static_cast<std::size_t>(sampler.settings.sampler.type);
    const Estimation<E>* lesson = jobs_[chosen_].shown();
    if (lesson == nullptr) return;
    const Picture picture = picture_of(lesson->experiment());
    ImGui::TextDisabled("%s", picture.caption);
    const float width = ImGui::GetContentRegionAvail().x;
    const float side = std::min(width / picture.aspect, 250 * ui.scale());
    const LabCanvas canvas =
        begin_canvas(ui, "lab.picture", vec2(side * picture.aspect, side), picture.lo, picture.hi);
    draw_experiment(canvas, *lesson, ui.scale());
    end_canvas(canvas);
    numbers(ui, *lesson);
    plot_widget(ui, "lab.plot", error_plot(*lesson), run_.every_sampler ? 340.0f : 220.0f);
  }

  void step(TaskThread& worker) override {
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (is_wanted(i)) jobs_[i].step(worker);
  }
  bool busy() const override {
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      if (is_wanted(i) && jobs_[i].busy()) return true;
    return false;
  }

private:
  struct Inputs {
    SampleSource source;
    std::uint64_t samples;
    int streams;
    typename E::Options options;
    bool operator==(const Inputs&) const = default;
  };

  bool is_wanted(std::size_t sampler) const { return run_.every_sampler || sampler == chosen_; }

  void restart_what_changed(SampleSource source) {
    jobs_.resize(sampler_names().size());
    inputs_.resize(jobs_.size());
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      source.type = static_cast<SamplerType>(i);
      const Inputs inputs{source, static_cast<std::uint64_t>(run_.samples), run_.streams, options_};
      if (inputs_[i] == inputs) continue;
      inputs_[i] = inputs;
      jobs_[i].start([inputs] {
        return Estimation<E>(E(inputs.options), inputs.source, inputs.samples, inputs.streams);
      });
    }
  }

  static void numbers(Ui& ui, const Estimation<E>& lesson) {
    const double expected = lesson.experiment().expected();
    ui.readout("samples", fmt::format("{} of {}", lesson.done(), lesson.samples()));
    if constexpr (!std::is_same_v<E, IntegralExperiment>)
      ui.readout("hits, misses", fmt::format("{}, {}", lesson.hits(), lesson.misses()));
    ui.readout("estimate", fmt::format("{:.7f}   expected {:.7f}", lesson.estimate(), expected));
    ui.readout("error", fmt::format("{:+.2e}", lesson.estimate() - expected));
    ui.readout("standard error", fmt::format("{:.2e}", lesson.standard_error()),
               lesson.streams() == 1 ? "As if the samples were independent; more streams measure it"
                                     : "From how the streams' estimates scatter");
  }

  Plot error_plot(const Estimation<E>& lesson) const {
    Plot plot;
    plot.title = lesson.streams() == 1 ? "Error over N" : "Root mean squared error over N";
    plot.x = {"samples N", true};
    plot.y = {"", true};
    PlotSeries guide{fmt::format("{:.3g} / sqrt N", lesson.experiment().standard_deviation()), {}, true};
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      const Estimation<E>* shown = jobs_[i].shown();
      if (!is_wanted(i) || shown == nullptr) continue;
      PlotSeries& series = plot.series.emplace_back();
      series.label = sampler_names()[i];
      for (const TracePoint& point : shown->trace())
        series.points.push_back({static_cast<double>(point.count), point.rms_error});
      if (i != chosen_) continue;
      for (const TracePoint& point : shown->trace())
        guide.points.push_back({static_cast<double>(point.count), point.expected_error});
    }
    plot.series.push_back(std::move(guide));
    return plot;
  }

  Run run_;
  typename E::Options options_{};
  std::size_t chosen_ = 0;
  std::deque<LabJob<Estimation<E>>> jobs_;    // one for each sampler; a deque keeps their addresses
  std::vector<std::optional<Inputs>> inputs_; // of the jobs
};

} // namespace

std::unique_ptr<LabPage> make_pi_page() { return std::make_unique<EstimatePage<PiExperiment>>(); }
std::unique_ptr<LabPage> make_solid_angle_page() {
  return std::make_unique<EstimatePage<SolidAngleExperiment>>();
}
std::unique_ptr<LabPage> make_integral_page() { return std::make_unique<EstimatePage<IntegralExperiment>>(); }

} // namespace candela
