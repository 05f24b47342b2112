#include "app/cli/lab_command.h"

#include "app/console/progress_bar.h"
#include "app/lab/lab_inputs.h"
#include "app/lab/lab_report.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "lab/lessons.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <map>

namespace candela {

namespace {

/// How long a lesson runs.
struct RunOptions {
  int samples = 1000000;
  int streams = 1;
};
const Field<RunOptions> kSamplesField = {
    {"samples", FieldType::integer, 1, 1e9, "", "Samples to draw (of each stream)"},
    [](RunOptions& o) -> void* { return &o.samples; }};
const Field<RunOptions> kPointsField = {{"samples", FieldType::integer, 1, 65536, "", "Points of each set"},
                                        [](RunOptions& o) -> void* { return &o.samples; }};
const Field<RunOptions> kStreamsField = {
    {"streams", FieldType::integer, 1, 4096, "",
     "Independent repetitions, each a pixel of its own; the standard error is then from how they scatter"},
    [](RunOptions& o) -> void* { return &o.streams; }};

/// Values given for rows of field tables, by option name ("--cone-angle").
using Texts = std::map<std::string, std::string>;

std::string option_name(std::string_view key) {
  std::string name = fmt::format("--{}", key.substr(key.rfind('.') + 1)); // npos + 1 is 0
  std::ranges::replace(name, '_', '-');
  return name;
}

void add_field(CLI::App& command, const FieldInfo& row, Texts& texts, const std::string& name) {
  command.add_option(name, texts[name], fmt::format("{}: {}", row.help, field_domain(row)));
}

template <class Owner>
void read_field(const Field<Owner>& row, Owner& owner, const Texts& texts, const std::string& name) {
  const std::string& text = texts.at(name);
  if (text.empty()) return;
  FieldInfo named = row; // messages show the key as it was typed
  named.key = name;
  field_from_text(named, row.address(owner), text);
}

std::string sampler_option(const FieldInfo& row) {
  return row.key == "sampler.type" ? "--sampler" : option_name(row.key);
}
std::string material_option(const FieldInfo& row) {
  return row.key == "type" ? "--material" : option_name(row.key);
}

/// Runs a lesson to its end with a progress bar.
template <class Lesson>
void run_to_end(Lesson& lesson) {
  constexpr std::uint64_t kSlice = 1 << 16; // some milliseconds
  ProgressBar bar(false);
  const auto began = std::chrono::steady_clock::now();
  while (!lesson.finished()) {
    lesson.advance(kSlice);
    bar.update(static_cast<double>(lesson.done()) / static_cast<double>(lesson.samples()),
               fmt::format("{} of {} samples", lesson.done(), lesson.samples()));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - began;
  bar.finish(fmt::format("{} samples in {:.3f} s", lesson.done(), seconds.count()));
}

/// The error for a missing or unknown lesson name.
Error unknown_lesson(const std::vector<std::string>& named) {
  std::vector<std::string_view> names;
  for (const LessonInfo& info : lessons()) names.push_back(info.name);
  std::string near = named.empty() ? "" : nearest_name(named.front(), names);
  std::string remedy =
      fmt::format("name one of {}; `candela lab NAME --help` tells its options", fmt::join(names, ", "));
  if (!near.empty()) remedy = fmt::format("did you mean {}? Or {}", near, remedy);
  if (named.empty()) return usage_error("lab", "no lesson is named", remedy);
  return usage_error(fmt::format("lab {}", named.front()), "there is no such lesson", remedy);
}

/// The discrepancy of every sampler.
std::vector<DiscrepancyCurve> discrepancy_curves(const PointsOptions& options, SampleSource source,
                                                 std::uint32_t count) {
  const auto samplers = find_setting("sampler.type")->choices;
  ProgressBar bar(false);
  std::vector<DiscrepancyCurve> curves;
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    source.type = static_cast<SamplerType>(i);
    DiscrepancyCurve& curve = curves.emplace_back(options, source, count);
    while (!curve.finished()) curve.advance();
    bar.update(static_cast<double>(i + 1) / static_cast<double>(samplers.size()), std::string(samplers[i]));
  }
  bar.finish(fmt::format("{} points of {} samplers", count, samplers.size()));
  return curves;
}

} // namespace

struct LabCommand::Options {
  CLI::App* lab = nullptr;
  struct Lesson {
    CLI::App* command = nullptr;
    Texts texts;
  };
  std::map<std::string_view, Lesson> lessons;
  bool json = false;
  bool curve = false;                     // points
  std::string x = "film.x", y = "film.y"; // points

  const Texts& texts(std::string_view name) const { return lessons.at(name).texts; }
  bool asks_for(std::string_view name) const { return lessons.at(name).command->parsed(); }

  RunOptions run_options(std::string_view name, RunOptions initial = {}) const {
    const auto& samples = name == "points" ? kPointsField : kSamplesField;
    read_field(samples, initial, texts(name), "--samples");
    if (texts(name).contains("--streams")) read_field(kStreamsField, initial, texts(name), "--streams");
    return initial;
  }
  SampleSource source(std::string_view name) const {
    Document document;
    for (const auto* row : sampler_rows()) read_field(*row, document, texts(name), sampler_option(*row));
    return sample_source(document.settings.sampler);
  }
  template <class Owner>
  Owner read(std::string_view name, std::span<const Field<Owner>> rows) const {
    Owner owner;
    for (const auto& row : rows) read_field(row, owner, texts(name), option_name(row.key));
    return owner;
  }

  void print(const LabReport& report) const { print_result(json ? report.json : report.text); }

  template <class E>
  void estimate(std::string_view name, E experiment) const {
    const RunOptions run = run_options(name);
    Estimation<E> lesson(std::move(experiment), source(name), static_cast<std::uint64_t>(run.samples),
                         run.streams);
    run_to_end(lesson);
    print(report(lesson));
  }
  void points() const {
    PointsOptions options;
    options.x = parse_coordinate("--x", x);
    options.y = parse_coordinate("--y", y);
    options.pixel = read<PixelOptions>("points", kPixelFields).pixel();
    const auto count = static_cast<std::uint32_t>(run_options("points", {256, 1}).samples);
    const SampleSource from = source("points");
    print(curve ? report_discrepancies(discrepancy_curves(options, from, count))
                : report_points(options, from, count));
  }
  void warps() const {
    WarpLesson lesson(read<WarpOptions>("warps", warp_fields()), source("warps"),
                      static_cast<std::uint64_t>(run_options("warps").samples));
    run_to_end(lesson);
    print(report(lesson));
  }
  void brdf() const {
    MaterialChoice material = lab_material();
    for (const auto& row : scattering_rows()) read_field(row, material, texts("brdf"), material_option(row));
    BrdfLesson lesson(lab_bsdf(material), read<BrdfOptions>("brdf", brdf_fields()), source("brdf"),
                      static_cast<std::uint64_t>(run_options("brdf").samples));
    run_to_end(lesson);
    print(report(lesson, material));
  }

  void medium() const {
    MediumLesson lesson(read<MediumLessonOptions>("medium", medium_lesson_fields()), source("medium"),
                        static_cast<std::uint64_t>(run_options("medium", {200000, 1}).samples));
    run_to_end(lesson);
    print(report(lesson));
  }
  void lens() const {
    LensLesson lesson(read<LensOptions>("lens", lens_fields()), source("lens"),
                      static_cast<std::uint64_t>(run_options("lens", {100000, 1}).samples));
    run_to_end(lesson);
    print(report(lesson));
  }

  struct PixelOptions {
    int x = 0, y = 0;
    uvec2 pixel() const { return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}; }
  };
  static constexpr int kLargestPixel = 16383;
  static inline const Field<PixelOptions> kPixelFields[] = {
      {{"pixel_x", FieldType::integer, 0, kLargestPixel, "", "Column of the pixel whose points they are"},
       [](PixelOptions& o) -> void* { return &o.x; }},
      {{"pixel_y", FieldType::integer, 0, kLargestPixel, "", "Row of the pixel whose points they are"},
       [](PixelOptions& o) -> void* { return &o.y; }},
  };
};

LabCommand::LabCommand(CLI::App& program) : options_(std::make_unique<Options>()) {
  Options& o = *options_;
  o.lab = program.add_subcommand("lab", "Monte Carlo lessons on the renderer's own samplers and densities");
  o.lab->require_subcommand(0, 1);
  o.lab->allow_extras(); // so that the error for a mistyped lesson can list all names
  for (const LessonInfo& info : lessons()) {
    Options::Lesson& lesson = o.lessons[info.name];
    lesson.command = o.lab->add_subcommand(std::string(info.name), std::string(info.title));
    lesson.command->footer(std::string(info.look_at));
    auto add = [&](const FieldInfo& row, const std::string& name) {
      add_field(*lesson.command, row, lesson.texts, name);
    };
    add(info.name == "points" ? kPointsField : kSamplesField, "--samples");
    for (const auto* row : sampler_rows()) add(*row, sampler_option(*row));
    lesson.command->add_flag("--json", o.json, "As JSON");
    if (info.name == "pi" || info.name == "solid-angle" || info.name == "integral")
      add(kStreamsField, "--streams");
    if (info.name == "solid-angle")
      for (const auto& row : solid_angle_fields()) add(row, option_name(row.key));
    if (info.name == "integral")
      for (const auto& row : integral_fields()) add(row, option_name(row.key));
    if (info.name == "points") {
      lesson.command->add_option("--x", o.x, "Horizontal coordinate: NAME, NAME.x or NAME.y, then @BOUNCE");
      lesson.command->add_option("--y", o.y, "Vertical coordinate, likewise");
      lesson.command->add_flag("--curve", o.curve,
                               "Instead of the points, their discrepancy over N for every sampler");
      for (const auto& row : Options::kPixelFields) add(row, option_name(row.key));
    }
    if (info.name == "warps")
      for (const auto& row : warp_fields()) add(row, option_name(row.key));
    if (info.name == "medium")
      for (const auto& row : medium_lesson_fields()) add(row, option_name(row.key));
    if (info.name == "lens")
      for (const auto& row : lens_fields()) add(row, option_name(row.key));
    if (info.name == "brdf") {
      for (const auto& row : brdf_fields()) add(row, option_name(row.key));
      for (const auto& row : scattering_rows()) add(row, material_option(row));
    }
  }
}

LabCommand::~LabCommand() = default;

bool LabCommand::parsed() const { return options_->lab->parsed(); }

int LabCommand::run() const {
  check_stdout();
  const Options& o = *options_;
  const std::vector<std::string> left = o.lab->remaining(true);
  if (!left.empty() && !o.lab->get_subcommands().empty())
    throw usage_error(fmt::format("lab {}", o.lab->get_subcommands().front()->get_name()),
                      fmt::format("'{}' is none of its options", left.front()),
                      "`candela lab NAME --help` lists them");
  if (o.asks_for("pi"))
    o.estimate("pi", PiExperiment{});
  else if (o.asks_for("solid-angle"))
    o.estimate("solid-angle",
               SolidAngleExperiment(o.read<SolidAngleOptions>("solid-angle", solid_angle_fields())));
  else if (o.asks_for("integral"))
    o.estimate("integral", IntegralExperiment(o.read<IntegralOptions>("integral", integral_fields())));
  else if (o.asks_for("points"))
    o.points();
  else if (o.asks_for("warps"))
    o.warps();
  else if (o.asks_for("brdf"))
    o.brdf();
  else if (o.asks_for("medium"))
    o.medium();
  else if (o.asks_for("lens"))
    o.lens();
  else
    throw unknown_lesson(left);
  return 0;
}

} // namespace candela
