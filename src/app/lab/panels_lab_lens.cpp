// The lab's page on lenses: the cross-section with rays, and what a thin lens would do.

#include "app/lab/lab_drawing.h"
#include "app/lab/lab_job.h"
#include "app/lab/lab_pages.h"
#include "app/lab/lens_lesson.h"
#include "app/ui/plot_widget.h"
#include "render/camera/lens_section.h"

#include <fmt/format.h>

#include <optional>

namespace candela {

namespace {

struct RaySamples {
  int samples = 100000;
};
const Field<RaySamples> kRaySamplesField = {{"samples", FieldType::integer, 1, 1e9, "", "Rays to sample"},
                                            [](RaySamples& o) -> void* { return &o.samples; }};

class LensPage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    const LensOptions defaults;
    for (const auto& row : lens_fields()) lab_field(ui, row, options_, defaults);
    sampler_fields(ui, sampler);
    lab_field(ui, kRaySamplesField, samples_, RaySamples{});
    restart_what_changed(sample_source(sampler.settings.sampler));
    const LensLesson* lesson = job_.shown();
    if (lesson == nullptr) return;

    draw_section(ui, *lesson);
    const LensSystem& lens = lesson->lens();
    ui.readout("focal length", fmt::format("{:.2f} mm, f/{:.2f} (f/{:.2f} wide open)", lens.focal_length(),
                                           lens.f_number(), lens.widest_f_number()));
    ui.readout("film", fmt::format("{:.2f} mm behind the last glass", lens.film_distance()),
               "Where a point at the distance of focus has its smallest spot");
    ui.readout("light",
               fmt::format("{:.4f} ± {:.1g} at the film point", lesson->illumination(),
                           lesson->illumination_error()),
               "Irradiance under a uniform scene, over that of the film's middle focused at infinity");
    ui.readout(
        "samples",
        fmt::format("{} of {}, {:.1f} % pass", lesson->done(), lesson->samples(), 100 * lesson->passing()),
        "Drawn over an ellipse around the exit pupil as this film point sees it");
    plot_widget(ui, "lab.blur", lesson->blur_plot(), 240);
    plot_widget(ui, "lab.vignetting", lesson->vignetting_plot(), 200);
  }
  void step(TaskThread& worker) override { job_.step(worker); }
  bool busy() const override { return job_.busy(); }

private:
  struct Inputs {
    SampleSource source;
    std::uint64_t samples;
    LensOptions options;
    bool operator==(const Inputs&) const = default;
  };

  void restart_what_changed(const SampleSource& source) {
    const Inputs inputs{source, static_cast<std::uint64_t>(samples_.samples), options_};
    if (inputs_ == inputs) return;
    inputs_ = inputs;
    job_.start([inputs] { return LensLesson(inputs.options, inputs.source, inputs.samples); });
  }

  /// The scene is to the right, the film to the left.
  static void draw_section(Ui& ui, const LensLesson& lesson) {
    constexpr int kRays = 25;
    const LensSystem& lens = lesson.lens();
    const LensSection section = lens_section(lens);
    const float length = lens.front_vertex() - section.film_z, beyond = 0.35f * length;
    const float rim = 1.15f * std::max(section.stop_rim, section.film_radius);
    ImGui::TextDisabled("Rays from the film point; orange ones are stopped");
    const float width = ImGui::GetContentRegionAvail().x;
    const vec2 lo(section.film_z - 0.06f * length, -rim), hi(lens.front_vertex() + beyond, rim);
    const float height = std::min(width * (hi.y - lo.y) / (hi.x - lo.x), 320 * ui.scale());
    // One scale for both axes.
    const float scale = std::min(width / (hi.x - lo.x), height / (hi.y - lo.y));
    const vec2 middle = 0.5f * (lo + hi), half = 0.5f * vec2(width, height) / scale;
    const LabCanvas canvas = begin_canvas(ui, "lab.section", {width, height}, middle - half, middle + half);
    canvas.line({lo.x, 0}, {hi.x, 0}, kLabGrid);
    for (const LensPath& path : lens_paths(lens, lesson.options().film_height, kRays, 2 * beyond))
      canvas.curve(path.points,
                   path.passes ? kLabHit : (kLabMiss & ~IM_COL32_A_MASK) | IM_COL32(0, 0, 0, 110));
    for (const auto& outline : section.elements) canvas.curve(outline, kLabInk, 1.5f * ui.scale());
    for (float side : {-1.0f, 1.0f})
      canvas.line({section.stop_z, side * section.stop_radius}, {section.stop_z, side * section.stop_rim},
                  kLabInk, 3 * ui.scale());
    canvas.line({section.film_z, -section.film_radius}, {section.film_z, section.film_radius}, kLabInk,
                3 * ui.scale());
    end_canvas(canvas);
  }

  RaySamples samples_;
  LensOptions options_;
  LabJob<LensLesson> job_;
  std::optional<Inputs> inputs_;
};

} // namespace

std::unique_ptr<LabPage> make_lens_page() { return std::make_unique<LensPage>(); }

} // namespace candela
