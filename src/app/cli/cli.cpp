#include "app/cli/cli.h"

#include "app/cli/bench_command.h"
#include "app/cli/compare_command.h"
#include "app/cli/convert_command.h"
#include "app/cli/gallery_command.h"
#include "app/cli/info_command.h"
#include "app/cli/lab_command.h"
#include "app/cli/render_command.h"
#include "app/cli/scale_command.h"
#include "app/cli/settings_command.h"
#include "app/cli/view_command.h"
#include "app/console/number_option.h"
#include "app/platform/streams.h"
#include "core/error.h"
#include "io/scene_formats.h"
#include "scene/document.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <new>
#include <sstream>

namespace candela {

namespace {

void add_threads(CLI::App& command, int& threads,
                 const std::string& help = "Threads to render with; 0: every core") {
  add_number(command, "--threads", threads, range(0, 1024), help);
}

/// The option that names a file for the measurements.
void add_json(CLI::App& command, const std::string& name, std::optional<std::string>& path) {
  command.add_option_function<std::string>(
      name, [&path](const std::string& given) { path = given == "-" ? "/dev/stdout" : given; },
      "Write the measurements to this file (JSON); -: stdout");
}

/// An option for one setting, with the setting's range.
template <class T>
void add_setting(CLI::App& command, const std::string& name, T& target, std::string_view key,
                 const std::string& help) {
  add_number(command, name, target, *find_setting(key), help);
}

/// Options for single settings are applied like `--set`, in the order given.
void add_common_options(CLI::App& command, SceneOptions& o) {
  command.add_option("scene", o.path, fmt::format("Scene file ({} {})", scene_endings(" "), kJobEnding));
  command.add_option("--set", o.settings, "Change a setting, KEY=VALUE; see `candela settings`")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--bookmark", o.bookmark, "Use the camera of this bookmark of the scene");
  command.add_flag("--allow-outside", o.allow_outside,
                   "Let the scene read files outside its own folder tree");
  add_threads(command, o.threads);
}

/// The innermost subcommand on the command line.
const CLI::App& chosen(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : chosen(*commands.front());
}

/// "candela bench scale".
std::string full_name(const CLI::App& command) {
  return command.get_parent() == nullptr ? command.get_name()
                                         : full_name(*command.get_parent()) + " " + command.get_name();
}

/// The error for an argument that the command does not have.
Error unexpected(const CLI::App& app) {
  const CLI::App& command = chosen(app);
  const std::string argument = app.remaining(true).front(), name = full_name(command);
  const bool option = argument.starts_with('-');
  std::vector<std::string> known;
  for (const CLI::Option* o : command.get_options())
    for (const std::string& long_name : o->get_lnames()) known.push_back("--" + long_name);
  std::string near =
      option ? nearest_name(argument, std::vector<std::string_view>(known.begin(), known.end())) : "";
  // `candela rendr box.json`: the mistyped command was parsed as the scene.
  if (&command == &app && app.count("scene") > 0) {
    std::vector<std::string_view> commands;
    const auto all = app.get_subcommands([](const CLI::App*) { return true; });
    for (const CLI::App* c : all) commands.push_back(c->get_name());
    const std::string typed = app.get_option("scene")->as<std::string>();
    if (const std::string meant = nearest_name(typed, commands); !meant.empty())
      return usage_error("candela " + typed, "there is no such command",
                         fmt::format("did you mean {}?", meant));
  }
  return usage_error(name, option ? "it has no option " + argument : argument + " is more than it takes",
                     near.empty() ? fmt::format("see `{} --help`", name)
                                  : fmt::format("did you mean {}?", near));
}

int run(int argc, char** argv) {
  CLI::App app{"Candela, an interactive progressive path tracer", "candela"};
  app.set_version_flag("--version", "candela " CANDELA_VERSION);
  app.require_subcommand(0, 1);
  app.option_defaults()->multi_option_policy(
      CLI::MultiOptionPolicy::TakeLast); // so that shell aliases can be overridden

  SceneOptions view_options;
  add_common_options(app, view_options); // `candela SCENE` is `candela view SCENE`
  auto* view = app.add_subcommand("view", "Open the window (the default)");
  add_common_options(*view, view_options);
  bool no_preferences = false;
  for (CLI::App* command : {static_cast<CLI::App*>(&app), view})
    command->add_flag("--no-preferences", no_preferences, "Neither read nor write the preferences file");

  RenderOptions render_options;
  auto* render = app.add_subcommand("render", "Render a scene to files");
  add_common_options(*render, render_options.scene);
  render->get_option("scene")->required();
  render
      ->add_option("-o,--output", render_options.outputs,
                   "Picture to write: PNG JPG PPM EXR HDR PFM; may repeat")
      ->take_all()
      ->allow_extra_args(false);
  add_setting(*render, "--spp", render_options.spp, "stop.spp", "Samples a pixel to stop at; 0: never");
  add_setting(*render, "--time", render_options.time, "stop.time",
              "Seconds of rendering to stop at; 0: never");
  add_setting(*render, "--noise", render_options.noise, "stop.noise",
              "Relative error of the image to stop at; 0: never");
  render
      ->add_option(
          "--aov", render_options.aovs,
          "Also write this view, or emitted, direct or indirect light, as OUTPUT.NAME.EXT, or light_groups, "
          "an EXR with a layer each; may repeat")
      ->take_all()
      ->allow_extra_args(false);
  render->add_option("--size", render_options.size, "Size of the image, WxH");
  add_setting(*render, "--seed", render_options.seed, "sampler.seed", "Seed of the random numbers");
  render->add_option("--crop", render_options.crop, "Render only this window of the image: X,Y,W,H");
  render->add_option("--reference", render_options.reference,
                     "Compare with this picture; the result goes to stdout");
  add_json(*render, "--stats", render_options.stats);
  render->add_flag("--no-state", render_options.no_state,
                   "Do not keep the scene in PNG and EXR, from which they can be rendered again");
  render->add_flag("--quiet", render_options.quiet, "Say nothing but warnings and errors");

  std::string compare_a, compare_b;
  std::optional<std::string> diff;
  auto* compare = app.add_subcommand("compare", "Measure how two pictures differ, as JSON");
  compare->add_option("a", compare_a, "Picture")->required();
  compare->add_option("b", compare_b, "Reference")->required();
  compare->add_option("--diff", diff, "Write a picture of the differences");

  SceneOptions info_options;
  auto* info = app.add_subcommand("info", "Describe a scene, as JSON");
  add_common_options(*info, info_options);
  info->get_option("scene")->required();

  GalleryOptions gallery_options;
  auto* gallery = app.add_subcommand("gallery", "Render the figures of a gallery file");
  gallery->add_option("name", gallery_options.names, "Figures to render; none: all");
  gallery->add_option("-o,--output", gallery_options.folder, "Folder that the pictures go to");
  gallery->add_option("--file", gallery_options.file, "Gallery file; else the one that comes with Candela");
  add_number(*gallery, "--spp-scale", gallery_options.spp_scale, range(1e-6, 1e6),
             "Multiplies all samples a pixel");
  add_threads(*gallery, gallery_options.threads);
  gallery->add_flag("--quick", gallery_options.quick, "Render half the size with a sixteenth of the samples");
  gallery->add_flag("--list", gallery_options.list, "Only list the figures");
  gallery->add_flag("--quiet", gallery_options.quiet, "Say nothing but warnings and errors");

  SceneOptions convert_options;
  std::string converted;
  auto* convert = app.add_subcommand("convert", "Write any scene as Candela JSON, or a volume as .cvol");
  add_common_options(*convert, convert_options);
  convert->get_option("scene")->required();
  convert->add_option("output", converted, "File to write, .json or .cvol")->required();

  bool json = false, markdown = false;
  auto* settings = app.add_subcommand("settings", "List every setting");
  settings->add_flag("--json", json, "As JSON");
  settings->add_flag("--markdown", markdown, "As a Markdown table")->excludes("--json");

  auto* help = app.add_subcommand("help", "Print this help");

  LabCommand lab(app);

  InteractiveBenchOptions bench_options;
  auto* bench = app.add_subcommand("bench", "Measure this machine with this program");
  bench->require_subcommand(1);
  auto* interactive = bench->add_subcommand(
      "interactive",
      "Input latency: a scripted flight and edits in a real window (in memory where there is no "
      "display); ms to the first image, frames, shares of the cores");
  add_common_options(*interactive, bench_options.scene);
  interactive->add_option("--size", bench_options.size, "Size of the window, WxH; else 1280x720");
  add_number(*interactive, "--repeats", bench_options.repeats, range(1, 1000), "Inputs of each kind");
  add_number(*interactive, "--seconds", bench_options.seconds, range(0.1, 600, "s"),
             "Seconds of flight, and of refining without input");
  add_json(*interactive, "--json", bench_options.json);
  interactive->add_flag("--short", bench_options.short_run,
                        "A small window and few inputs, to test that it works");
  interactive->add_flag("--offscreen", bench_options.offscreen, "Draw off screen even if there is a display");
  interactive->add_flag("--quiet", bench_options.quiet, "Say nothing but warnings and errors");

  ScaleBenchOptions scale_options;
  auto* scale = bench->add_subcommand(
      "scale", "Large scenes: seconds to read, build and show, memory, samples a second by one thread and by "
               "all. It writes them (but for two that come with Candela) as files that can be opened");
  scale->add_option("scene", scale_options.scenes, "Measure these scene files instead");
  scale->add_option("-o,--output", scale_options.folder,
                    "Folder to keep the scenes in; else they are removed");
  scale->add_option("--only", scale_options.only, "Parts to run; none: all")
      ->check(CLI::IsMember(scale_parts()))
      ->take_all()
      ->allow_extra_args(false);
  scale->add_option("--size", scale_options.size, "Size of the measured pictures, WxH; else 960x540");
  add_number(*scale, "--rounds", scale_options.rounds, range(1, 1000),
             "Passes by one thread and by all, in turn");
  add_threads(*scale, scale_options.threads, "Threads of the parallel passes; 0: every core");
  scale->add_option("--plot", scale_options.plot, "Draw samples a second over the triangles to this PNG");
  scale->add_option("--picture", scale_options.picture,
                    "Render the landscape to this file, without a denoiser; seconds and relMSE");
  scale->add_option("--picture-size", scale_options.picture_size, "Its size, WxH; else 3840x2160");
  add_number(*scale, "--picture-spp", scale_options.picture_spp, range(2, 1000000, "samples"),
             "Its samples a pixel; else 64");
  add_json(*scale, "--json", scale_options.json);
  scale->add_flag("--markdown", scale_options.markdown, "The tables in Markdown");
  scale->add_flag("--short", scale_options.short_run, "Tiny scenes and pictures, to test that it works");
  scale->add_flag("--quiet", scale_options.quiet, "Say nothing but warnings and errors");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) { // --help, --version
    std::ostringstream out, err;
    const int code = app.exit(e, out, err);
    print_result(out.str());
    return code;
  } catch (const CLI::ExtrasError&) { throw unexpected(app); } catch (const CLI::ParseError& e) {
    throw usage_error("command line", e.what(), fmt::format("see `{} --help`", full_name(chosen(app))));
  }
  // An empty name would mean the Cornell box, as in `candela view`.
  for (const auto& [command, options] :
       {std::pair{render, &render_options.scene}, {info, &info_options}, {convert, &convert_options}})
    if (command->parsed() && options->path.empty())
      throw usage_error(full_name(*command), "the scene's name is empty", "name a scene file");
  if (help->parsed()) {
    print_result(app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
    return 0;
  }
  if (render->parsed()) return run_render(render_options);
  if (compare->parsed()) return run_compare(compare_a, compare_b, diff);
  if (gallery->parsed()) return run_gallery(gallery_options);
  if (info->parsed()) return run_info(info_options);
  if (convert->parsed()) return run_convert(convert_options, converted);
  if (settings->parsed()) return run_settings(json, markdown);
  if (lab.parsed()) return lab.run();
  if (interactive->parsed()) return run_interactive_bench(bench_options);
  if (scale->parsed()) return run_scale_bench(scale_options);
  return run_view(view_options, !no_preferences);
}

} // namespace

int run_program(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& e) {
    say("candela: {}\n", e.what());
    return static_cast<int>(e.code());
  } catch (const std::bad_alloc&) {
    say("candela: memory: there is not enough: close other programs or make the scene or the film "
        "smaller\n");
    return static_cast<int>(ExitCode::limit);
  }
}

} // namespace candela
