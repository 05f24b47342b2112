// Input latency: the meter, and the script of the benchmark.

#include "app/bench/bench_script.h"
#include "app/bench/interaction_bench.h"
#include "app/cli/bench_command.h"
#include "app/harness.h"
#include "support/exit_code.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace candela::test {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

Frame frame_of(std::uint64_t generation, int coarseness, int spp) {
  Frame frame;
  frame.generation = generation;
  frame.coarseness = coarseness;
  frame.spp = spp;
  frame.first_pass_seconds = 0.5;
  return frame;
}

TEST(InteractionMeter, TimesTheFirstAndTheFullPictureOfAnInput) {
  InteractionMeter meter;
  const MeterClock::time_point start{};
  meter.submitted(2, start);
  meter.shown(frame_of(1, 1, 7), start + 5ms);
  EXPECT_TRUE(meter.waiting()) << "a picture from before the input does not count";
  meter.shown(frame_of(2, 8, 0), start + 10ms);
  meter.shown(frame_of(2, 4, 0), start + 20ms);
  ASSERT_EQ(meter.interactions().size(), 1u);
  EXPECT_FALSE(meter.waiting());
  EXPECT_DOUBLE_EQ(meter.interactions()[0].first_ms, 10);
  EXPECT_EQ(meter.interactions()[0].coarseness, 8);
  EXPECT_LT(meter.interactions()[0].full_ms, 0);
  meter.shown(frame_of(2, 1, 1), start + 90ms);
  meter.shown(frame_of(2, 1, 2), start + 150ms);
  EXPECT_DOUBLE_EQ(meter.interactions()[0].full_ms, 90);
  EXPECT_DOUBLE_EQ(meter.interactions()[0].pass_ms, 500);
}

TEST(InteractionMeter, AnInputThatIsOvertakenHasTheLaterOnesPictureAndNoFullOne) {
  InteractionMeter meter;
  const MeterClock::time_point start{};
  meter.submitted(2, start);
  meter.submitted(3, start + 4ms);
  meter.shown(frame_of(3, 8, 0), start + 10ms);
  meter.shown(frame_of(3, 1, 1), start + 50ms);
  ASSERT_EQ(meter.interactions().size(), 2u);
  EXPECT_DOUBLE_EQ(meter.interactions()[0].first_ms, 10);
  EXPECT_LT(meter.interactions()[0].full_ms, 0);
  EXPECT_DOUBLE_EQ(meter.interactions()[1].first_ms, 6);
  EXPECT_DOUBLE_EQ(meter.interactions()[1].full_ms, 46);
}

TEST(InteractionMeter, KeepsTheNewestAlone) {
  InteractionMeter meter;
  for (int i = 0; i < 5000; ++i) meter.add({0.001 * i, 0, true});
  EXPECT_EQ(meter.frames().size(), InteractionMeter::kKept);
  EXPECT_DOUBLE_EQ(meter.frames().back().seconds, 4.999);
}

TEST(CpuBill, OtherProgramsAreNotHeldAgainstTheRenderer) {
  CpuBill bill;
  bill.wall = 10;
  bill.render = 8;
  bill.process = bill.machine = 9;
  EXPECT_DOUBLE_EQ(bill.render_share(2), 0.4);
  bill.machine = 19; // ten seconds of others
  EXPECT_DOUBLE_EQ(bill.render_share(2), 0.8);
}

TEST(BenchScript, IsTheSameEveryTimeAndComesBack) {
  const Document start = test_document();
  for (InputKind kind : kInputKinds) {
    ASSERT_TRUE(can_edit(kind, start)) << to_string(kind);
    EXPECT_EQ(flight_position(7, {800, 600}), flight_position(7, {800, 600}));
    if (kind == InputKind::camera || kind == InputKind::flight) continue;
    Document once = start, again = start;
    apply_edit(kind, 0, once);
    apply_edit(kind, 0, again);
    EXPECT_EQ(compare_documents(once, again), Invalidates::nothing) << to_string(kind);
    EXPECT_GE(compare_documents(start, once), Invalidates::image) << to_string(kind);
    apply_edit(kind, 1, once);
    if (kind != InputKind::setting)
      EXPECT_EQ(compare_documents(start, once), Invalidates::nothing) << to_string(kind);
    else
      EXPECT_GE(compare_documents(again, once), Invalidates::image) << "every step restarts";
  }
}

TEST(BenchScript, EveryStepOfTheFlightMovesTheMouseInsideTheWindow) {
  const ivec2 window(1280, 720);
  for (int step = 0; step < 2000; ++step) {
    const vec2 at = flight_position(step, window), next = flight_position(step + 1, window);
    EXPECT_GT(glm::length(next - at), 0.5f) << step;
    EXPECT_GT(std::min(at.x, at.y), 0) << step;
    EXPECT_LT(at.x, 0.7f * static_cast<float>(window.x)) << step << ": under the panels";
  }
}

TEST(BenchScript, EditsWhatTheSceneHas) {
  Document empty;
  EXPECT_FALSE(can_edit(InputKind::material, empty));
  EXPECT_FALSE(can_edit(InputKind::light, empty));
  EXPECT_FALSE(can_edit(InputKind::object, empty));
  EXPECT_TRUE(can_edit(InputKind::setting, empty));
}

TEST(InteractiveBenchUi, MeasuresEveryKindOfInputAndWritesJson) {
  ScratchFolder folder;
  InteractiveBenchOptions options;
  options.short_run = options.offscreen = options.quiet = true;
  options.scene.threads = 2;
  options.json = folder / "bench.json";
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_interactive_bench(options), 0);
  std::fflush(stdout);
  const std::string table = testing::internal::GetCapturedStdout();
  EXPECT_NE(table.find("at least 85.0 %"), std::string::npos) << table;
  const json out = json::parse(std::ifstream(*options.json));
  EXPECT_EQ(out["width"], 160);
  EXPECT_EQ(out["height"], 120);
  EXPECT_GT(out["full_pass_ms"], 0);
  ASSERT_EQ(out["inputs"].size(), std::size(kInputKinds));
  for (const auto& [kind, input] : out["inputs"].items()) {
    const json& first = input["first_image_ms"];
    EXPECT_GT(first["median"], 0) << kind;
    EXPECT_LE(first["median"], first["p99"]) << kind;
    EXPECT_LE(input["first_image_block"]["median"], 32) << kind;
    if (kind == "flight") continue;
    EXPECT_EQ(first["count"], 2) << kind;
    EXPECT_EQ(input["full_image_ms"]["count"], 2) << kind;
    EXPECT_GE(input["full_image_ms"]["median"], first["median"]) << kind;
  }
  const json& refining = out["refining"];
  EXPECT_GT(refining["render_cpu_s"], 0);
  EXPECT_LE(refining["render_cpu_s"], refining["process_cpu_s"]);
  EXPECT_GT(refining["samples_per_s"], 0);
  EXPECT_EQ(out["targets"].size(), std::size(kInputKinds) + 2);
}

TEST(InteractiveBench, RefusesSizesThatAreNone) {
  InteractiveBenchOptions options;
  for (const char* size : {"wide", "12", "0x100", "100x99999", "-5x20"}) {
    options.size = size;
    EXPECT_EQ(code_of([&] { run_interactive_bench(options); }), ExitCode::usage) << size;
  }
}

TEST(InteractiveBench, RefusesAScenesThatIsNotThere) {
  InteractiveBenchOptions options;
  options.scene.path = "no/such/scene.json";
  EXPECT_EQ(code_of([&] { run_interactive_bench(options); }), ExitCode::bad_input);
}

TEST(StatisticsPanelUi, TellsHowLongTheHandWaits) {
  ViewerHarness hand;
  hand.wait_for_picture();
  EXPECT_EQ(hand.state().meter.first_ms, 0) << "there was no input that restarted";
  hand.send(DocumentEdited{[](Document& document) { document.settings.sampler.seed = 9; }});
  hand.wait_for_picture();
  hand.frame(2, 2.0); // the numbers change once a second
  EXPECT_GT(hand.state().meter.first_ms, 0);
  EXPECT_GE(hand.state().meter.full_ms, hand.state().meter.first_ms);
  hand.screenshot("statistics_hand_to_picture");
}

} // namespace
} // namespace candela::test
