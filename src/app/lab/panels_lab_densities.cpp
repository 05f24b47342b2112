// The lab's pages on densities: the maps of the square, and the lobes of materials.

#include "app/lab/lab_drawing.h"
#include "app/lab/lab_job.h"
#include "app/lab/lab_pages.h"
#include "app/lab/lab_report.h"
#include "core/basis.h"
#include "core/color.h"
#include "render/world/render_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace candela {

namespace {

struct DensitySamples {
  int samples = 1000000;
};
const Field<DensitySamples> kDensitySamplesField = {
    {"samples", FieldType::integer, 1, 1e9, "", "Samples to draw"},
    [](DensitySamples& o) -> void* { return &o.samples; }};

/// The test's numbers, and the counts next to those expected of the density. They are divided by `measure`, a
/// cell's area or solid angle, to show densities. Only the first `rows` rows are shown.
template <class Measure>
void histogram_maps(Ui& ui, const Histogram& h, int rows, const Measure& measure) {
  const ChiSquareResult test = h.chi_square();
  ui.readout("integral of pdf", fmt::format("{:.5f}", h.integral()));
  ui.readout("chi-square", fmt::format("{:.0f} of {:.0f} degrees of freedom, p = {:.2g}", test.statistic,
                                       test.degrees_of_freedom, test.p_value));
  ui.readout("", verdict(test)); // of the chi-square
  std::vector<double> seen, claimed;
  double most = 1e-30;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < h.grid.columns; ++column) {
      const auto i = static_cast<std::size_t>(row * h.grid.columns + column);
      const vec2 middle((static_cast<float>(column) + 0.5f) / static_cast<float>(h.grid.columns),
                        (static_cast<float>(row) + 0.5f) / static_cast<float>(h.grid.rows));
      const double area = std::max(measure(middle), 1e-12);
      seen.push_back(h.counts[i] / std::max(h.total, 1.0) / area);
      claimed.push_back(h.expected[i] / area);
      most = std::max(most, claimed.back());
    }
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = std::floor(0.5f * (ImGui::GetContentRegionAvail().x - gap));
  const float height = std::min(width, 150 * ui.scale());
  number_map(ui, "lab.observed", "histogram of the samples", seen, h.grid.columns, rows, most,
             {width, height});
  ImGui::SameLine(0, gap);
  number_map(ui, "lab.expected", "the pdf", claimed, h.grid.columns, rows, most, {width, height});
}

class WarpsPage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    sampler_fields(ui, sampler);
    lab_field(ui, kDensitySamplesField, samples_, DensitySamples{});
    const WarpOptions defaults;
    for (const auto& row : warp_fields())
      if (warp_uses(options_.warp, row.key)) lab_field(ui, row, options_, defaults);
    restart_what_changed(sample_source(sampler.settings.sampler));
    const WarpLesson* lesson = job_.shown();
    if (lesson == nullptr) return;

    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float side =
        std::min(std::floor(0.5f * (ImGui::GetContentRegionAvail().x - gap)), 300 * ui.scale());
    draw_square(ui, *lesson, side);
    ImGui::SameLine(0, gap);
    draw_domain(ui, *lesson, side);
    ui.readout("samples", fmt::format("{} of {}", lesson->done(), lesson->samples()));
    histogram_maps(ui, lesson->histogram(), lesson->histogram().grid.rows,
                   [&](vec2 q) { return lesson->warp().chart_measure(q); });
    ImGui::TextDisabled("%s", lesson->warp().on_sphere() ? "Left to right: azimuth; downwards: from the axis"
                                                         : "The same cells on both sides");
  }
  void step(TaskThread& worker) override { job_.step(worker); }
  bool busy() const override { return job_.busy(); }

private:
  struct Inputs {
    SampleSource source;
    std::uint64_t samples;
    WarpOptions options;
    bool operator==(const Inputs&) const = default;
  };
  static constexpr int kLines = 8;               // grid lines in each direction
  static constexpr std::uint64_t kPoints = 1024; // shown points

  void restart_what_changed(const SampleSource& source) {
    const Inputs inputs{source, static_cast<std::uint64_t>(samples_.samples), options_};
    if (inputs_ == inputs) return;
    inputs_ = inputs;
    job_.start([inputs] { return WarpLesson(inputs.options, inputs.source, inputs.samples); });
  }

  static void draw_square(Ui& ui, const WarpLesson& lesson, float side) {
    ImGui::BeginGroup();
    ImGui::TextDisabled("the square");
    const LabCanvas canvas = begin_canvas(ui, "lab.square", vec2(side), vec2(-0.05f), vec2(1.05f));
    for (int i = 0; i <= kLines; ++i) {
      const float t = static_cast<float>(i) / kLines;
      canvas.line({t, 0}, {t, 1}, kLabMiss);
      canvas.line({0, t}, {1, t}, kLabHit);
    }
    Sampler sampler = lesson.source().sampler();
    for (std::uint64_t i = 0; i < std::min(lesson.done(), kPoints); ++i) {
      sampler.start({0, 0}, static_cast<std::uint32_t>(i));
      canvas.dot(sampler.get_2d(Dimension::film), 2 * ui.scale(), kLabInk);
    }
    end_canvas(canvas);
    ImGui::EndGroup();
  }

  void draw_domain(Ui& ui, const WarpLesson& lesson, float side) {
    const bool turns = lesson.warp().on_sphere() || options_.warp == Warp::spherical_rectangle;
    ImGui::BeginGroup();
    ImGui::TextDisabled("%s", turns ? "mapped points (drag to rotate)" : "mapped points");
    vec2 lo(-1.1f), hi(1.1f);
    if (options_.warp == Warp::triangle) lo = {-0.05f, -0.12f}, hi = {1.05f, 0.98f};
    const LabCanvas canvas = begin_canvas(ui, "lab.domain", vec2(side), lo, hi);
    if (turns) {
      view_.drag();
      draw_globe(canvas, view_, options_.warp != Warp::sphere && options_.warp != Warp::cone);
    }
    // Show the directions to the rectangle, since the sampling is uniform in them.
    auto place = [&](vec3 p) {
      if (options_.warp == Warp::spherical_rectangle) p = glm::normalize(p);
      return turns ? view_.to_view(p) : p;
    };
    auto faces_away = [&](vec3 placed) { return turns && placed.z < 0; };
    for (int i = 0; i <= kLines; ++i)
      for (bool vertical : {false, true}) {
        constexpr int kSteps = 64;
        std::optional<vec3> last;
        for (int step = 0; step <= kSteps; ++step) {
          const float t = std::min(static_cast<float>(i) / kLines, kOneMinusEpsilon);
          const float s = std::min(static_cast<float>(step) / kSteps, kOneMinusEpsilon);
          const vec3 p = place(lesson.warp().map(vertical ? vec2(t, s) : vec2(s, t)));
          const bool jumps = last && glm::length(p - *last) > 0.5f; // a discontinuity of the map
          if (last && !jumps) {
            const ImU32 color = vertical ? kLabMiss : kLabHit;
            const ImU32 faint = (color & ~IM_COL32_A_MASK) | (70u << IM_COL32_A_SHIFT);
            canvas.line(vec2(*last), vec2(p), faces_away(p) ? faint : color);
          }
          last = p;
        }
      }
    for (std::uint64_t i = 0; i < std::min(lesson.done(), kPoints); ++i) {
      const vec3 p = place(lesson.replay(i));
      canvas.dot(vec2(p), 2 * ui.scale(), faces_away(p) ? IM_COL32(235, 235, 235, 60) : kLabInk);
    }
    end_canvas(canvas);
    ImGui::EndGroup();
  }

  DensitySamples samples_;
  WarpOptions options_;
  OrbitView view_;
  LabJob<WarpLesson> job_;
  std::optional<Inputs> inputs_;
};

class BrdfPage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    const MaterialChoice initial_material = lab_material();
    for (const auto& row : scattering_rows())
      if (scattering_uses(material_.type, row.key))
        lab_field(ui, row, material_, initial_material, row.key == "type" ? "material" : "");
    const BrdfOptions defaults;
    for (const auto& row : brdf_fields()) lab_field(ui, row, options_, defaults);
    sampler_fields(ui, sampler);
    lab_field(ui, kDensitySamplesField, samples_, DensitySamples{});
    restart_what_changed(sample_source(sampler.settings.sampler));

    ImGui::TextDisabled("f cos in every direction: drag to rotate, right-drag to tilt wo");
    const float width = ImGui::GetContentRegionAvail().x, height = std::min(0.72f * width, 320 * ui.scale());
    const float aspect = width / height;
    const LabCanvas canvas = begin_canvas(ui, "lab.lobe", {width, height}, vec2(-1.15f * aspect, -1.0f),
                                          vec2(1.15f * aspect, 1.3f));
    view_.drag();
    if (ImGui::IsItemHovered() && ImGui::IsMouseDown(ImGuiMouseButton_Right))
      options_.theta =
          std::clamp(options_.theta - 0.008f * ImGui::GetIO().MouseDelta.y, 0.0f, radians(89.9f));
    draw_lobe(canvas, ui.scale());
    end_canvas(canvas);

    const BrdfLesson* lesson = job_.shown();
    if (lesson == nullptr) return;
    const vec3 albedo = lesson->albedo(), error = lesson->albedo_error();
    ui.readout(
        "albedo",
        fmt::format("{:.4f} {:.4f} {:.4f}  ± {:.1g}", albedo.x, albedo.y, albedo.z, max_component(error)),
        "Directional-hemispherical reflectance by Monte Carlo (with what is transmitted), and its "
        "standard error as if the samples were independent");
    ui.readout("samples", fmt::format("{} of {}, {} carried no light", lesson->done(), lesson->samples(),
                                      lesson->failed()));
    constexpr ChartGrid kGrid = BrdfLesson::kGrid;
    const auto& h = lesson->histogram();
    const auto upper = static_cast<std::ptrdiff_t>(kGrid.size() / 2);
    const bool below = std::any_of(h.counts.begin() + upper, h.counts.end(), [](double c) { return c > 0; });
    histogram_maps(ui, h, below ? kGrid.rows : kGrid.rows / 2,
                   [](vec2 q) { return std::sin(std::numbers::pi * static_cast<double>(q.y)); });
    ImGui::TextDisabled("Left to right: azimuth, wo's at both ends; downwards: from the normal");
  }
  void step(TaskThread& worker) override { job_.step(worker); }
  bool busy() const override { return job_.busy(); }

private:
  struct Inputs {
    SampleSource source;
    std::uint64_t samples;
    MaterialChoice material;
    BrdfOptions options;
    bool operator==(const Inputs&) const = default;
  };

  void restart_what_changed(const SampleSource& source) {
    const Inputs inputs{source, static_cast<std::uint64_t>(samples_.samples), material_, options_};
    if (inputs_ == inputs) return;
    inputs_ = inputs;
    job_.start([inputs] {
      return BrdfLesson(lab_bsdf(inputs.material), inputs.options, inputs.source, inputs.samples);
    });
  }

  void draw_lobe(const LabCanvas& canvas, float unit) const {
    draw_ground(canvas, view_);
    draw_arrow(canvas, view_, vec3(0), {0, 0, 1.15f}, IM_COL32(150, 150, 150, 255), 1.2f * unit);
    const Bsdf bsdf = lab_bsdf(material_);
    const vec3 wo = options_.wo();
    // The surface r(wi) = f cos, scaled to a maximum of 1, over polar coordinates about the mirror direction,
    // with denser rows there because lobes may be narrow.
    constexpr int kColumns = 64, kRows = 44;
    const Basis about = Basis::from_normal(reflect_about_normal(wo));
    std::vector<vec3> values, directions;
    float most = 0;
    for (int row = 0; row <= kRows; ++row)
      for (int column = 0; column <= kColumns; ++column) {
        const float away = sqr(static_cast<float>(row) / kRows);
        const vec3 wi = about.to_world(direction_from_chart({static_cast<float>(column) / kColumns, away}));
        directions.push_back(wi);
        values.push_back(bsdf_eval(bsdf, wo, wi));
        most = std::max(most, luminance(values.back()));
      }
    struct Quad {
      float depth;
      std::array<ImVec2, 4> corners;
      ImU32 color;
    };
    std::vector<Quad> quads;
    if (most > 0)
      for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
          const auto a = static_cast<std::size_t>(row * (kColumns + 1) + column);
          const std::array<std::size_t, 4> index = {a, a + 1, a + kColumns + 2, a + kColumns + 1};
          std::array<vec3, 4> p;
          vec3 middle(0), f(0);
          for (std::size_t k = 0; k < 4; ++k) {
            p[k] = view_.to_view(directions[index[k]] * (luminance(values[index[k]]) / most));
            middle += 0.25f * p[k];
            f += 0.25f * values[index[k]];
          }
          if (luminance(f) < 1e-4f * most) continue;
          const vec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
          const float length = glm::length(normal);
          const float shade =
              length > 0 ? 0.35f + 0.65f * std::abs(glm::dot(normal, vec3(0.3f, 0.5f, 0.81f))) / length : 1;
          const vec3 tint = f / std::max(max_component(f), 1e-30f) * shade;
          Quad& quad = quads.emplace_back();
          quad.depth = middle.z;
          for (std::size_t k = 0; k < 4; ++k) quad.corners[k] = canvas.at(vec2(p[k]));
          quad.color = IM_COL32(static_cast<int>(225 * tint.x), static_cast<int>(225 * tint.y),
                                static_cast<int>(225 * tint.z), 255);
        }
    std::ranges::sort(quads, {}, &Quad::depth); // the nearest is drawn last
    const ImDrawListFlags flags = canvas.list->Flags;
    canvas.list->Flags &= ~ImDrawListFlags_AntiAliasedFill; // it would leave seams between the quads
    for (const Quad& q : quads)
      canvas.list->AddQuadFilled(q.corners[0], q.corners[1], q.corners[2], q.corners[3], q.color);
    canvas.list->Flags = flags;

    draw_arrow(canvas, view_, vec3(0), 1.1f * wo, kLabHit, 2 * unit);
    const BrdfLesson* lesson = job_.shown();
    if (lesson == nullptr) return;
    for (const DeltaLobe& lobe : lesson->delta_lobes()) {
      const float share =
          luminance(lobe.weight_sum) / static_cast<float>(std::max<std::uint64_t>(lesson->done(), 1));
      draw_arrow(canvas, view_, vec3(0), lobe.wi * std::max(share, 0.05f), kLabMiss, 3 * unit);
    }
  }

  DensitySamples samples_;
  MaterialChoice material_ = lab_material();
  BrdfOptions options_;
  OrbitView view_;
  LabJob<BrdfLesson> job_;
  std::optional<Inputs> inputs_;
};

} // namespace

std::unique_ptr<LabPage> make_warps_page() { return std::make_unique<WarpsPage>(); }
std::unique_ptr<LabPage> make_brdf_page() { return std::make_unique<BrdfPage>(); }

} // namespace candela
