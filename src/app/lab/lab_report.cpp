#include "app/lab/lab_report.h"

#include "app/lab/lab_inputs.h"
#include "lab/lessons.h"
#include "sampling/discrepancy.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <bit>

namespace candela {

namespace {

using nlohmann::ordered_json;

std::string_view sampler_name(SamplerType type) {
  return find_setting("sampler.type")->choices[static_cast<std::size_t>(type)];
}

/// Collects lines of the text and members of the JSON.
class Writer {
public:
  explicit Writer(std::string_view lesson_name) {
    const LessonInfo& info = lesson(lesson_name);
    text_ = fmt::format("{}\n{}\n\n", info.title, info.look_at);
    json_["lesson"] = info.name;
  }
  void line(std::string_view label, std::string_view value) {
    text_ += fmt::format("{:<20}{}\n", label, value);
  }
  void text(std::string_view lines) { text_ += lines; }
  ordered_json& json(std::string_view key) { return json_[std::string(key)]; }

  void source(const SampleSource& source) {
    json("sampler") = sampler_name(source.type);
    json("seed") = source.seed;
    if (source.type == SamplerType::stratified) json("strata") = source.strata;
    line("sampler", fmt::format("{}, seed {}", sampler_name(source.type), source.seed));
  }
  template <class Owner>
  void fields(std::span<const Field<Owner>> rows, const Owner& owner) {
    for (const auto& row : rows) field(row, field_text(row, owner));
  }
  void field(const FieldInfo& row, const std::string& value) {
    line(row.key, value);
    // Numbers are valid JSON as they are; names and vectors become strings.
    const bool number =
        row.type == FieldType::integer || row.type == FieldType::real || row.type == FieldType::angle;
    json(row.key) = number ? ordered_json::parse(value) : ordered_json(value);
  }
  LabReport done() const { return {text_, json_.dump(2) + "\n"}; }

private:
  std::string text_;
  ordered_json json_;
};

template <class E>
LabReport finish_estimation(Writer out, const Estimation<E>& lesson, bool counts_hits) {
  const double expected = lesson.experiment().expected(), error = lesson.estimate() - expected;
  const double deviation = lesson.experiment().standard_deviation();
  const double true_error =
      deviation / std::sqrt(static_cast<double>(lesson.done()) * static_cast<double>(lesson.streams()));
  out.source(lesson.source());
  out.json("samples") = lesson.done();
  out.json("streams") = lesson.streams();
  out.line("samples", lesson.streams() == 1
                          ? fmt::format("{}", lesson.done())
                          : fmt::format("{} in each of {} streams", lesson.done(), lesson.streams()));
  if (counts_hits) {
    out.line("hits", fmt::format("{}", lesson.hits()));
    out.line("misses", fmt::format("{}", lesson.misses()));
    out.json("hits") = lesson.hits();
    out.json("misses") = lesson.misses();
  }
  const bool spread = lesson.streams() == 1 && lesson.source().type != SamplerType::independent;
  out.line("estimate", fmt::format("{:.9g}", lesson.estimate()));
  out.line("expected", fmt::format("{:.9g}", expected));
  out.line("error", fmt::format("{:.3g}", error));
  out.line("standard error",
           fmt::format("{:.3g}{}", lesson.standard_error(),
                       spread ? " if the samples were independent; with --streams it is measured" : ""));
  out.line("known", fmt::format("{:.3g} = {:.4g} / sqrt(N), for independent samples", true_error, deviation));
  out.json("estimate") = lesson.estimate();
  out.json("expected") = expected;
  out.json("error") = error;
  out.json("standard_error") = lesson.standard_error();
  out.json("standard_deviation") = deviation;
  out.text(fmt::format("\n{:>12} {:>14} {:>12} {:>12}\n", "N", "estimate",
                       lesson.streams() == 1 ? "|error|" : "rms error", "sigma/sqrt N"));
  auto& trace = out.json("trace") = ordered_json::array();
  for (const TracePoint& point : lesson.trace()) {
    trace.push_back({{"n", point.count},
                     {"estimate", point.estimate},
                     {"rms_error", point.rms_error},
                     {"expected_error", point.expected_error}});
    const bool power_of_four = std::has_single_bit(point.count) && std::countr_zero(point.count) % 2 == 0;
    if (power_of_four || point.count == lesson.done())
      out.text(fmt::format("{:>12} {:>14.9f} {:>12.3g} {:>12.3g}\n", point.count, point.estimate,
                           point.rms_error, point.expected_error));
  }
  return out.done();
}

void histogram(Writer& out, const Histogram& h) {
  const ChiSquareResult test = h.chi_square();
  out.line("integral of pdf", fmt::format("{:.6f}", h.integral()));
  out.line("chi-square", fmt::format("{:.1f} with {:.0f} degrees of freedom, p = {:.3g}", test.statistic,
                                     test.degrees_of_freedom, test.p_value));
  out.line("", verdict(test));
  out.json("pdf_integral") = h.integral();
  out.json("chi_square") = {{"statistic", test.statistic},
                            {"degrees_of_freedom", test.degrees_of_freedom},
                            {"p_value", test.p_value}};
  std::vector<double> expected = h.expected;
  for (double& share : expected) share *= h.total;
  out.json("histogram") = {{"columns", h.grid.columns},
                           {"rows", h.grid.rows},
                           {"observed", h.counts},
                           {"expected", expected},
                           {"outside", h.outside}};
}

/// The curves of plots, whose points have the same x.
void plot_tables(Writer& out, const std::vector<std::pair<std::string_view, Plot>>& plots) {
  for (const auto& [key, plot] : plots) {
    auto& curves = out.json(key);
    out.text(fmt::format("\n{}\n{:>14}", plot.title, plot.x.label));
    for (const PlotSeries& series : plot.series) out.text(fmt::format(" {:>14}", series.label));
    out.text("\n");
    const std::size_t count = plot.series.front().points.size();
    for (std::size_t i = 0; i < count; ++i) {
      out.text(fmt::format("{:>14.4g}", plot.series.front().points[i].x));
      for (const PlotSeries& series : plot.series) {
        out.text(fmt::format(" {:>14.5g}", series.points[i].y));
        curves[series.label].push_back({series.points[i].x, series.points[i].y});
      }
      out.text("\n");
    }
  }
}

void coordinates(ordered_json& json, const PointsOptions& options) {
  json["x"] = to_string(options.x);
  json["y"] = to_string(options.y);
  json["pixel"] = {options.pixel.x, options.pixel.y};
}

} // namespace

std::string verdict(const ChiSquareResult& test) {
  const double p = test.p_value;
  if (test.degrees_of_freedom == 0 && p > 0) return "no density to test, or too few samples";
  if (p < 1e-6) return "the samples do not follow the pdf";
  if (p < 1e-3) return "doubtful: try other seeds";
  if (p > 1 - 1e-3) return "fits; samples more even than independent ones";
  return "the pdf fits";
}

LabReport report(const Estimation<PiExperiment>& lesson) {
  return finish_estimation(Writer("pi"), lesson, true);
}

LabReport report(const Estimation<SolidAngleExperiment>& lesson) {
  Writer out("solid-angle");
  out.fields(solid_angle_fields(), lesson.experiment().options());
  return finish_estimation(std::move(out), lesson, true);
}

LabReport report(const Estimation<IntegralExperiment>& lesson) {
  Writer out("integral");
  out.fields(integral_fields(), lesson.experiment().options());
  return finish_estimation(std::move(out), lesson, false);
}

LabReport report(const WarpLesson& lesson) {
  Writer out("warps");
  for (const auto& row : warp_fields())
    if (warp_uses(lesson.options().warp, row.key)) out.field(row, field_text(row, lesson.options()));
  out.source(lesson.source());
  out.line("samples", fmt::format("{}", lesson.done()));
  out.json("samples") = lesson.done();
  histogram(out, lesson.histogram());
  return out.done();
}

LabReport report(const BrdfLesson& lesson, const MaterialChoice& material) {
  Writer out("brdf");
  for (const auto& row : scattering_rows())
    if (scattering_uses(material.type, row.key)) out.field(row, field_text(row, material));
  out.fields(brdf_fields(), lesson.options());
  out.source(lesson.source());
  out.line("samples", fmt::format("{}", lesson.done()));
  out.json("samples") = lesson.done();
  const vec3 albedo = lesson.albedo(), error = lesson.albedo_error();
  out.line("albedo", fmt::format("{:.5f} {:.5f} {:.5f}", albedo.x, albedo.y, albedo.z));
  out.line("standard error", fmt::format("{:.1g} {:.1g} {:.1g}", error.x, error.y, error.z));
  out.line("without light", fmt::format("{} samples", lesson.failed()));
  out.json("albedo") = {albedo.x, albedo.y, albedo.z};
  out.json("standard_error") = {error.x, error.y, error.z};
  out.json("failed") = lesson.failed();
  auto& deltas = out.json("delta_lobes") = ordered_json::array();
  for (const DeltaLobe& lobe : lesson.delta_lobes()) {
    const vec3 share = lobe.weight_sum / static_cast<float>(lesson.done());
    out.line("delta lobe", fmt::format("towards {:.4f} {:.4f} {:.4f}: {:.5f} {:.5f} {:.5f}", lobe.wi.x,
                                       lobe.wi.y, lobe.wi.z, share.x, share.y, share.z));
    deltas.push_back({{"wi", {lobe.wi.x, lobe.wi.y, lobe.wi.z}},
                      {"samples", lobe.count},
                      {"albedo", {share.x, share.y, share.z}}});
  }
  histogram(out, lesson.histogram());
  return out.done();
}

LabReport report(const MediumLesson& lesson) {
  Writer out("medium");
  for (const auto& row : medium_lesson_fields())
    if (medium_lesson_uses(lesson.options(), row.key)) out.field(row, field_text(row, lesson.options()));
  out.source(lesson.source());
  out.line("samples", fmt::format("{}", lesson.done()));
  const SlabShares counted = lesson.counted(), &theory = lesson.theory();
  const bool exact = lesson.theory_is_exact();
  auto share = [&](const char* name, double found, double known, bool is_exact) {
    out.line(name, fmt::format("{:.6f} +- {:.1g}, theory {:.6f}{}", found, lesson.error(found), known,
                               is_exact ? "" : " (of a similar isotropic slab)"));
    out.json(name) = {
        {"counted", found}, {"standard_error", lesson.error(found)}, {"theory", known}, {"exact", is_exact}};
  };
  share("reflected", counted.reflected, theory.reflected, exact);
  share("transmitted", counted.transmitted, theory.transmitted, exact);
  share("direct", counted.direct, theory.direct, true);
  share("absorbed", counted.absorbed, theory.absorbed, exact);
  const double cosine = static_cast<double>(mean_cosine(lesson.options().phase_function()));
  out.line("mean cosine", fmt::format("{:.5f}", cosine));
  out.line("mean flight", fmt::format("{:.5f}, of the first; theory 1", lesson.mean_flight()));
  out.line("scattered", fmt::format("{:.4g} times on the mean", lesson.mean_scatterings()));
  out.json("samples") = lesson.done();
  out.json("mean_cosine") = cosine;
  out.json("mean_flight") = lesson.mean_flight();
  out.json("mean_scatterings") = lesson.mean_scatterings();
  plot_tables(out, {{"flights", lesson.flight_plot()}, {"orders", lesson.order_plot()}});
  return out.done();
}

LabReport report(const LensLesson& lesson) {
  Writer out("lens");
  out.fields(lens_fields(), lesson.options());
  out.source(lesson.source());
  out.line("samples", fmt::format("{}, {:.1f} % passed", lesson.done(), 100 * lesson.passing()));
  const LensSystem& lens = lesson.lens();
  out.line("focal length", fmt::format("{:.3f} mm", lens.focal_length()));
  out.line("f-number", fmt::format("{:.3f}, wide open {:.3f}", lens.f_number(), lens.widest_f_number()));
  out.line("film distance", fmt::format("{:.3f} mm", lens.film_distance()));
  out.line("light", fmt::format("{:.5f} at the film point", lesson.illumination()));
  out.line("standard error", fmt::format("{:.1g}", lesson.illumination_error()));
  out.json("samples") = lesson.done();
  out.json("passing") = lesson.passing();
  out.json("focal_length") = lens.focal_length();
  out.json("f_number") = lens.f_number();
  out.json("film_distance") = lens.film_distance();
  out.json("illumination") = lesson.illumination();
  out.json("standard_error") = lesson.illumination_error();
  plot_tables(out, {{"blur", lesson.blur_plot()}, {"vignetting", lesson.vignetting_plot()}});
  return out.done();
}

LabReport report_points(const PointsOptions& options, const SampleSource& source, std::uint32_t count) {
  const std::vector<vec2> points = sampler_points(options, source, 0, count);
  LabReport out;
  out.text = fmt::format("{},{}\n", to_string(options.x), to_string(options.y));
  ordered_json json = {{"lesson", "points"}, {"sampler", sampler_name(source.type)}, {"seed", source.seed}};
  if (source.type == SamplerType::stratified) json["strata"] = source.strata;
  coordinates(json, options);
  json["discrepancy"] = l2_star_discrepancy(points);
  auto& list = json["points"] = ordered_json::array();
  for (vec2 p : points) {
    out.text += fmt::format("{},{}\n", p.x, p.y);
    list.push_back({p.x, p.y});
  }
  out.json = json.dump() + "\n";
  return out;
}

LabReport report_discrepancies(std::span<const DiscrepancyCurve> curves) {
  const SampleSource& source = curves[0].source();
  ordered_json json = {{"lesson", "points"}, {"seed", source.seed}, {"strata", source.strata}};
  coordinates(json, curves[0].options());
  std::string header = "n";
  for (const DiscrepancyCurve& curve : curves) {
    header += fmt::format(",{}", sampler_name(curve.source().type));
    auto& values = json["discrepancy"][std::string(sampler_name(curve.source().type))] =
        ordered_json::array();
    for (const auto& value : curve.values()) values.push_back({value.count, value.discrepancy});
  }
  LabReport out{header + "\n", json.dump() + "\n"};
  for (std::size_t i = 0; i < curves[0].values().size(); ++i) {
    out.text += fmt::format("{}", curves[0].values()[i].count);
    for (const DiscrepancyCurve& curve : curves)
      out.text += fmt::format(",{:.6g}", curve.values()[i].discrepancy);
    out.text += "\n";
  }
  return out;
}

} // namespace candela
