// The lab's page on the samplers' points.

#include "app/lab/lab_drawing.h"
#include "app/lab/lab_job.h"
#include "app/lab/lab_pages.h"
#include "app/ui/plot_widget.h"
#include "lab/points.h"

#include <fmt/format.h>

#include <deque>
#include <optional>

namespace candela {

namespace {

/// The coordinates of a bounce, as a choice: "film.x", "film.y" (of a 2D dimension), "film" (of a 1D one), …
struct CoordinateNames {
  std::vector<std::string> texts;
  std::vector<std::string_view> views;
  CoordinateNames() {
    for (std::string_view name : dimension_names())
      for (const char* part : {".x", ".y", ""}) texts.push_back(fmt::format("{}{}", name, part));
    views.assign(texts.begin(), texts.end());
  }
};
std::span<const std::string_view> coordinate_names() {
  static const CoordinateNames names;
  return names.views;
}

struct Inputs {
  int count = 256;
  int x = 0, y = 1; ///< index into coordinate_names()
  int bounce_x = 0, bounce_y = 0;
  int pixel_x = 0, pixel_y = 0;
  int columns = 16, rows = 16;
  bool operator==(const Inputs&) const = default;

  PointsOptions options() const {
    auto coordinate = [](int name, int bounce) {
      Coordinate c = parse_coordinate("", coordinate_names()[static_cast<std::size_t>(name)]);
      c.bounce = static_cast<std::uint32_t>(bounce);
      return c;
    };
    return {coordinate(x, bounce_x), coordinate(y, bounce_y),
            uvec2(static_cast<std::uint32_t>(pixel_x), static_cast<std::uint32_t>(pixel_y))};
  }
};

std::span<const Field<Inputs>> fields() {
  using I = Inputs;
  static const Field<Inputs> kFields[] = {
      {{"points", FieldType::integer, 1, 16384, "", "How many, from sample 0"},
       [](I& i) -> void* { return &i.count; }},
      {{"x", FieldType::choice, 0, 0, "", "The horizontal coordinate", Invalidates::nothing,
        coordinate_names()},
       [](I& i) -> void* { return &i.x; }},
      {{"x_bounce", FieldType::integer, 0, 64, "", "At which bounce of the path"},
       [](I& i) -> void* { return &i.bounce_x; }},
      {{"y", FieldType::choice, 0, 0, "", "The vertical coordinate", Invalidates::nothing,
        coordinate_names()},
       [](I& i) -> void* { return &i.y; }},
      {{"y_bounce", FieldType::integer, 0, 64, "", "At which bounce of the path"},
       [](I& i) -> void* { return &i.bounce_y; }},
      {{"pixel_x", FieldType::integer, 0, 16383, "", "Column of the pixel whose points they are"},
       [](I& i) -> void* { return &i.pixel_x; }},
      {{"pixel_y", FieldType::integer, 0, 16383, "", "Row of the pixel whose points they are"},
       [](I& i) -> void* { return &i.pixel_y; }},
      {{"columns", FieldType::integer, 1, 256, "",
        "Of the boxes; empty boxes are shaded red, crowded ones lit"},
       [](I& i) -> void* { return &i.columns; }},
      {{"rows", FieldType::integer, 1, 256, "",
        "Of the boxes: columns x rows = points is a (0,2)-net's test"},
       [](I& i) -> void* { return &i.rows; }},
  };
  return kFields;
}

class PointsPage : public LabPage {
public:
  void draw(Ui& ui, Document& sampler) override {
    sampler_fields(ui, sampler);
    const Inputs defaults;
    for (const auto& row : fields()) lab_field(ui, row, inputs_, defaults);
    const SampleSource source = sample_source(sampler.settings.sampler);
    if (!drawn_source_ || *drawn_source_ != source || drawn_inputs_ != inputs_) {
      points_ = sampler_points(inputs_.options(), source, 0, static_cast<std::uint32_t>(inputs_.count));
      drawn_source_ = source;
      drawn_inputs_ = inputs_;
    }
    restart_curves(source);
    draw_points(ui);
    plot_widget(ui, "lab.plot", discrepancy_plot(), 340);
  }

  void step(TaskThread& worker) override {
    for (auto& curve : curves_) curve.step(worker);
  }
  bool busy() const override {
    return std::ranges::any_of(curves_, [](const auto& curve) { return curve.busy(); });
  }

private:
  static constexpr std::uint32_t kCurvePoints = 4096;

  /// The curves are of every sampler type, for the shown pixel and coordinates.
  void restart_curves(SampleSource source) {
    source.type = SamplerType::independent;
    const PointsOptions options = inputs_.options();
    if (curve_options_ == options && curve_source_ == source) return;
    curve_options_ = options;
    curve_source_ = source;
    curves_.resize(sampler_names().size());
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      source.type = static_cast<SamplerType>(i);
      curves_[i].start([options, source] { return DiscrepancyCurve(options, source, kCurvePoints); });
    }
  }

  void draw_points(Ui& ui) {
    const int columns = inputs_.columns, rows = inputs_.rows;
    std::vector<int> counts(static_cast<std::size_t>(columns * rows));
    for (vec2 p : points_) {
      const int column = static_cast<int>(p.x * static_cast<float>(columns));
      const int row = static_cast<int>(p.y * static_cast<float>(rows));
      ++counts[static_cast<std::size_t>(row * columns + column)];
    }
    const auto empty = std::ranges::count(counts, 0);
    ui.readout("boxes",
               fmt::format("{} empty of {}, {} points in the fullest", empty, counts.size(),
                           *std::ranges::max_element(counts)),
               "An elementary interval of a (0,2)-net with as many points as boxes holds exactly one");
    const float side = std::min(ImGui::GetContentRegionAvail().x, 380 * ui.scale());
    const LabCanvas canvas = begin_canvas(ui, "lab.picture", vec2(side), vec2(0), vec2(1));
    const vec2 box = 1.0f / vec2(columns, rows);
    const double share = static_cast<double>(points_.size()) / static_cast<double>(counts.size());
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const int count = counts[static_cast<std::size_t>(row * columns + column)];
        const bool missing = count<std::floor(share), crowded = count> std::ceil(share);
        if (!missing && !crowded) continue;
        const ImVec2 a = canvas.at(box * vec2(column, row + 1)), b = canvas.at(box * vec2(column + 1, row));
        canvas.list->AddRectFilled(a, b, missing ? IM_COL32(150, 50, 40, 90) : IM_COL32(230, 210, 140, 60));
      }
    const float pixels = side / static_cast<float>(std::max(columns, rows));
    if (pixels > 4) { // finer lines would hide the points
      for (int i = 1; i < columns; ++i)
        canvas.line({box.x * static_cast<float>(i), 0}, {box.x * static_cast<float>(i), 1}, kLabGrid);
      for (int i = 1; i < rows; ++i)
        canvas.line({0, box.y * static_cast<float>(i)}, {1, box.y * static_cast<float>(i)}, kLabGrid);
    }
    const float dot = std::clamp(60 / std::sqrt(static_cast<float>(points_.size())), 1.5f, 5.0f) * ui.scale();
    for (vec2 p : points_) canvas.dot(p, dot, kLabHit);
    end_canvas(canvas);
  }

  Plot discrepancy_plot() const {
    Plot plot;
    plot.title = "L2 star discrepancy over N";
    plot.x = {"points N", true};
    plot.y = {"", true};
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      const DiscrepancyCurve* curve = curves_[i].shown();
      if (curve == nullptr) continue;
      PlotSeries& series = plot.series.emplace_back();
      series.label = sampler_names()[i];
      for (const auto& value : curve->values())
        series.points.push_back({static_cast<double>(value.count), value.discrepancy});
    }
    PlotSeries guide{"sqrt(5/36) / sqrt N", {}, true}; // root mean square of independent points
    for (std::uint32_t n = 1; n <= kCurvePoints; n *= 2)
      guide.points.push_back({static_cast<double>(n), std::sqrt(5.0 / 36 / n)});
    plot.series.push_back(std::move(guide));
    return plot;
  }

  Inputs inputs_;
  std::vector<vec2> points_;
  std::optional<SampleSource> drawn_source_; // of points_
  Inputs drawn_inputs_;
  std::optional<PointsOptions> curve_options_;
  std::optional<SampleSource> curve_source_;
  std::deque<LabJob<DiscrepancyCurve>> curves_; // one for each sampler; a deque keeps their addresses
};

} // namespace

std::unique_ptr<LabPage> make_points_page() { return std::make_unique<PointsPage>(); }

} // namespace candela
