#include "app/cli/bench_command.h"

#include "app/bench/interaction_bench.h"
#include "app/console/outputs.h"
#include "app/platform/streams.h"
#include "app/window/window_glfw.h"
#include "app/window/window_offscreen.h"
#include "core/error.h"
#include "io/files/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace candela {

namespace {

using nlohmann::ordered_json;

constexpr ivec2 kSize{1280, 720}, kShortSize{160, 120};
constexpr int kShortRepeats = 2;
constexpr double kShortSeconds = 0.3;

ordered_json percentiles_json(const Percentiles& s) {
  return {{"count", s.count}, {"median", s.median}, {"p90", s.p90}, {"p99", s.p99}};
}

ordered_json result_json(const BenchResult& r, const std::string& surface, const std::string& scene) {
  ordered_json j;
  j["version"] = CANDELA_VERSION;
  j["scene"] = scene;
  j["surface"] = surface;
  j["width"] = r.size.x;
  j["height"] = r.size.y;
  j["threads"] = r.threads;
  j["full_pass_ms"] = r.full_pass_ms;
  for (const KindResult& k : r.kinds) {
    ordered_json& kind = j["inputs"][to_string(k.kind)];
    kind["first_image_ms"] = percentiles_json(k.first);
    if (k.full.count > 0) kind["full_image_ms"] = percentiles_json(k.full);
    kind["first_image_block"] = percentiles_json(k.coarseness);
  }
  j["window_frames_ms"] = percentiles_json(r.frames);
  j["frames_dropped"] = r.dropped;
  const CpuBill& b = r.refining;
  j["refining"] = {{"wall_s", b.wall},
                   {"render_cpu_s", b.render},
                   {"tone_map_cpu_s", b.present},
                   {"window_cpu_s", b.window},
                   {"process_cpu_s", b.process},
                   {"machine_cpu_s", b.machine},
                   {"passes_wall_s", b.passes},
                   {"render_share", b.render_share(r.threads)},
                   {"samples_per_s", r.samples_per_second}};
  j["load_average"] = r.load;
  for (const Target& t : targets(r))
    j["targets"].push_back({{"name", t.name},
                            {"measured", t.measured},
                            {"limit", t.limit},
                            {"unit", t.unit},
                            {"at_least", t.at_least},
                            {"met", t.met()}});
  return j;
}

std::string table_text(const BenchResult& r, const std::string& surface, const std::string& scene) {
  std::string out;
  auto print = [&out]<class... T>(fmt::format_string<T...> format, T&&... values) {
    out += fmt::format(format, std::forward<T>(values)...);
  };
  print("{}, {} x {}, {}, {} threads, load {:.1f} to {:.1f}\n\n", scene, r.size.x, r.size.y, surface,
        r.threads, r.load[0], r.load[1]);
  print("{:<28}{:>10}{:>10}{:>10}\n", "input latency, ms", "median", "90 %", "99 %");
  auto row = [&](const std::string& name, const Percentiles& s) {
    print("{:<28}{:>10.1f}{:>10.1f}{:>10.1f}\n", name, s.median, s.p90, s.p99);
  };
  for (const KindResult& k : r.kinds) {
    row(fmt::format("{}, first ({:.0f} px blocks)", to_string(k.kind), k.coarseness.median), k.first);
    if (k.full.count > 0) row(fmt::format("{}, full", to_string(k.kind)), k.full);
  }
  row("frame of the window", r.frames);
  const CpuBill& b = r.refining;
  auto share = [&](double seconds) { return 100 * seconds / (b.wall * r.threads); };
  print("\n{} of {} frames dropped; a pass over all pixels takes {:.0f} ms\n", r.dropped, r.frames.count,
        r.full_pass_ms);
  print("refining, of {} cores: rendering {:.0f} %, tone mapping {:.1f} %, the window {:.1f} %, drawing it "
        "and the rest {:.1f} %, other programs {:.0f} %\n",
        r.threads, share(b.render), share(b.present), share(b.window),
        share(std::max(b.process - b.render - b.present - b.window, 0.0)),
        share(std::max(b.machine - b.process, 0.0)));
  print("refining, of the time: {:.0f} % within passes; {:.2f} Msamples/s\n\n", 100 * b.passes / b.wall,
        r.samples_per_second / 1e6);
  for (const Target& t : targets(r))
    print("{:<28}{:>10.1f} {:<3} {} {:.1f} {:<3} {}\n", t.name, t.measured, t.unit,
          t.at_least ? "at least" : "at most ", t.limit, t.unit, t.met() ? "met" : "missed");
  return out;
}

} // namespace

int run_interactive_bench(const InteractiveBenchOptions& o) {
  const std::string scene = o.scene.path.empty() ? "Cornell box" : o.scene.path;
  check_stdout();
  if (o.json) check_outputs({{"--json", *o.json}}, {o.scene.path});
  LoadedScene loaded = load_scene(o.scene);
  ivec2 size = o.short_run ? kShortSize : kSize;
  if (o.size) {
    const std::vector<int> parts = integers(*o.size, 'x', 2, "--size", "WxH, such as 1280x720");
    size = {parts[0], parts[1]};
    if (size.x < 16 || size.y < 16 || size.x > 16384 || size.y > 16384)
      throw usage_error(fmt::format("--size {}", *o.size), "a window has from 16 to 16384 pixels a side",
                        "write WxH, such as 1280x720");
  }
  BenchPlan plan;
  plan.repeats = o.repeats.value_or(o.short_run ? kShortRepeats : plan.repeats);
  plan.seconds = o.seconds.value_or(o.short_run ? kShortSeconds : plan.seconds);
  plan.quiet = o.quiet;

  ViewerOptions viewer;
  viewer.document = std::move(loaded.document);
  viewer.document.settings.stop = {.spp = 0, .time = 0, .noise = 0}; // it never stops refining
  viewer.scene_path = o.scene.path;
  viewer.threads = o.scene.threads;
  viewer.reading = {o.scene.allow_outside};
  viewer.preferences.window = size;

  InteractionBench bench(plan, o.scene.threads);
  const bool window = !o.offscreen && display_available();
  if (window)
    run_window(std::move(viewer), &bench);
  else
    run_offscreen(std::move(viewer), size, bench);
  if (!bench.done())
    throw Error(ExitCode::interrupted, "bench: the window was closed before all was measured: run it again");
  const std::string surface = window ? "in a window" : "without a display";
  OutputWriter writer;
  if (o.json)
    writer.attempt(*o.json, [&] {
      write_file_atomically(*o.json, result_json(bench.result(), surface, scene).dump(2) + "\n");
    });
  print_result(table_text(bench.result(), surface, scene));
  return static_cast<int>(writer.code());
}

} // namespace candela
