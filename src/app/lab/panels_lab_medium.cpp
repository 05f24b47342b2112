// The lab's page on light in matter: a slab, its phase function in polar coordinates, and free flights.

#include "app/lab/lab_drawing.h"
#include "app/lab/lab_job.h"
#include "app/lab/lab_pages.h"
#include "app/lab/medium_lesson.h"
#include "app/ui/plot_widget.h"

#include <fmt/format.h>

#include <optional>

namespace candela {

namespace {

struct WalkSamples {
  int samples = 200000;
};
const Field<WalkSamples> kWalkSamplesField = {
    {"samples", FieldType::integer, 1, 1e9, "", "Walks through the slab"},
    [](WalkSamples& o) -> void* { return &o.samples; }};

class MediumPage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    const MediumLessonOptions defaults;
    for (const auto& row : medium_lesson_fields())
      if (medium_lesson_uses(options_, row.key)) lab_field(ui, row, options_, defaults);
    sampler_fields(ui, sampler);
    lab_field(ui, kWalkSamplesField, samples_, WalkSamples{});
    restart_what_changed(sample_source(sampler.settings.sampler));
    draw_phase(ui);
    const MediumLesson* lesson = job_.shown();
    if (lesson == nullptr) return;
    const SlabShares counted = lesson->counted(), &theory = lesson->theory();
    const char* help = lesson->theory_is_exact()
                           ? "Counted, and by the integral equation of radiative transfer"
                           : "Counted, and that of an isotropic slab that is similar: an approximation";
    auto share = [&](const char* label, double found, double known, bool exact) {
      ui.readout(label,
                 fmt::format("{:.4f} ± {:.1g}, theory {}{:.4f}", found, lesson->error(found),
                             exact ? "" : "~", known),
                 help);
    };
    const bool exact = lesson->theory_is_exact();
    share("reflected", counted.reflected, theory.reflected, exact);
    share("transmitted", counted.transmitted, theory.transmitted, exact);
    share("direct", counted.direct, theory.direct, true);
    share("absorbed", counted.absorbed, theory.absorbed, exact);
    ui.readout("scattered", fmt::format("{:.3g} times on the mean; {} of {} walks",
                                        lesson->mean_scatterings(), lesson->done(), lesson->samples()));
    plot_widget(ui, "lab.flights", lesson->flight_plot(), 200);
    plot_widget(ui, "lab.orders", lesson->order_plot(), 200);
  }
  void step(TaskThread& worker) override { job_.step(worker); }
  bool busy() const override { return job_.busy(); }

private:
  struct Inputs {
    SampleSource source;
    std::uint64_t samples;
    MediumLessonOptions options;
    bool operator==(const Inputs&) const = default;
  };

  void restart_what_changed(const SampleSource& source) {
    const Inputs inputs{source, static_cast<std::uint64_t>(samples_.samples), options_};
    if (inputs_ == inputs) return;
    inputs_ = inputs;
    job_.start([inputs] { return MediumLesson(inputs.options, inputs.source, inputs.samples); });
  }

  /// Light comes from the left; the radius is the density's root, so that what is rare can be seen.
  void draw_phase(Ui& ui) const {
    ImGui::TextDisabled("The phase function: light comes from the left; radius: square root of the density");
    const PhaseFunction phase = options_.phase_function();
    constexpr int kSteps = 360;
    std::vector<vec2> outline;
    float most = 0;
    for (int i = 0; i <= kSteps; ++i) {
      // Denser towards both ends, where peaks are.
      const float x = 2 * static_cast<float>(i) / kSteps - 1, theta = kPi * x * std::abs(x);
      const float half = std::sin(0.5f * theta);
      const float radius = std::sqrt(phase_eval(phase, Turn::from_forward(2 * half * half)));
      outline.push_back(radius * vec2(std::cos(theta), std::sin(theta)));
      most = std::max(most, radius);
    }
    const float width = ImGui::GetContentRegionAvail().x, height = std::min(0.4f * width, 200 * ui.scale());
    const float aspect = width / height;
    const LabCanvas canvas =
        begin_canvas(ui, "lab.phase", {width, height}, vec2(-aspect, -1) * 1.1f, vec2(aspect, 1) * 1.1f);
    canvas.line({-aspect, 0}, {0, 0}, kLabMiss, 2 * ui.scale());
    canvas.circle({0, 0}, std::sqrt(0.25f * kInvPi) / most, kLabGrid); // of isotropic scattering
    for (vec2& p : outline) p /= most;
    canvas.curve(outline, kLabHit, 2 * ui.scale());
    end_canvas(canvas);
    ui.readout("mean cosine", fmt::format("{:.4f}", mean_cosine(phase)), "Also called g");
  }

  WalkSamples samples_;
  MediumLessonOptions options_;
  LabJob<MediumLesson> job_;
  std::optional<Inputs> inputs_;
};

} // namespace

std::unique_ptr<LabPage> make_medium_page() { return std::make_unique<MediumPage>(); }

} // namespace candela
