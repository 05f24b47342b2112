#include "session/render_session.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <thread>

namespace candela {
namespace {

using Fairness = RenderTurns::Fairness;

/// Threads that take turns; each turn adds the variant's portion.
struct Comparison {
  explicit Comparison(const std::vector<int>& groups) : turns(groups) {
    for (std::size_t variant = 0; variant < groups.size();
         ++variant) { // all take part before any thread gets ahead
      turns.begin(static_cast<int>(variant), {}, stop);
      turns.end(static_cast<int>(variant));
    }
  }
  std::atomic<bool> stop{false};
  RenderTurns turns;
  std::atomic<int> inside{0};
  std::atomic<bool> overlapped{false};

  void run(int variant, double samples_a_turn, double seconds_a_turn, double target,
           std::vector<double>* gaps, const std::atomic<double>* other, std::atomic<double>* mine) {
    double samples = 0, seconds = 0;
    while (samples < target) {
      const auto turn = turns.begin(variant, {samples, seconds}, stop);
      if (!turn.granted) break;
      if (inside.fetch_add(1) != 0) overlapped = true;
      const double step =
          turn.most_samples > 0 ? std::min(samples_a_turn, double{1} * turn.most_samples) : samples_a_turn;
      samples += step;
      seconds += seconds_a_turn * step / samples_a_turn;
      *mine = turns_by_time ? seconds : samples;
      if (gaps != nullptr && *other > 0) gaps->push_back(*mine - *other);
      std::this_thread::yield();
      inside.fetch_sub(1);
      turns.end(variant);
    }
    turns.leave(variant);
  }
  bool turns_by_time = false;
};

TEST(RenderTurns, OneAtATimeAndNoneRunsAhead) {
  Comparison group({0, 0});
  std::atomic<double> a{0}, b{0};
  std::vector<double> gaps;
  std::jthread other([&] { group.run(1, 1, 0.03, 100, nullptr, &a, &b); });
  group.run(0, 16, 0.01, 100, &gaps, &b, &a);
  other.join();
  EXPECT_FALSE(group.overlapped);
  EXPECT_GE(a, 100);
  EXPECT_GE(b, 100);
  ASSERT_FALSE(gaps.empty());
  for (double gap : gaps) EXPECT_LE(gap, 16) << "a turn ahead at most";
}

TEST(RenderTurns, EqualTimeGivesTheQuickerMoreSamples) {
  Comparison group({0, 0});
  group.turns.set_fairness(Fairness::time);
  group.turns_by_time = true;
  std::atomic<double> a{0}, b{0};
  std::vector<double> gaps;
  std::jthread other([&] { group.run(1, 1, 0.5, 1e9, nullptr, &a, &b); });
  group.run(0, 10, 0.5, 1000, &gaps, &b, &a);
  group.stop = true;
  group.turns.wake();
  other.join();
  EXPECT_FALSE(group.overlapped);
  for (double gap : gaps) EXPECT_LE(gap, 0.5 + 1e-9);
  EXPECT_GE(b, 40) << "of 50 seconds";
}

TEST(RenderTurns, WhoLeavesIsNotWaitedFor) {
  RenderTurns turns({0, 0});
  const std::atomic<bool> never{false}, at_once{true};
  ASSERT_TRUE(turns.begin(1, {0, 0}, never).granted);
  turns.end(1);
  // Variant 1 is active with nothing done: variant 0 must wait for it, so it is told to give up.
  EXPECT_FALSE(turns.begin(0, {5, 0}, at_once).granted);
  turns.leave(1);
  ASSERT_TRUE(turns.begin(0, {5, 0}, never).granted);
  turns.end(0);
}

TEST(RenderTurns, GroupsAlternate) {
  Comparison group({0, 0, 1});
  std::atomic<double> a{0}, b{0}, c{0};
  std::vector<double> gaps;
  std::jthread first([&] { group.run(0, 1, 0.1, 200, nullptr, &b, &a); });
  std::jthread second([&] { group.run(1, 1, 0.1, 200, nullptr, &a, &b); });
  group.run(2, 1, 0.1, 100, nullptr, &a, &c);
  first.join();
  second.join();
  EXPECT_FALSE(group.overlapped);
  EXPECT_GE(a, 200);
  EXPECT_GE(c, 100);
}

TEST(RenderTurnsRender, SessionsStayLevelAndGiveTheSamePictures) {
  test::SceneMaker scene = test::cornell_flush(48, 48, 40, true);
  Document a = scene.document, b = scene.document;
  b.settings.sampler.type = SamplerType::independent;
  auto turns = std::make_shared<RenderTurns>(std::vector<int>{0, 0});
  SessionOptions options;
  options.threads = 2;
  options.turns = turns;
  RenderSession first(options);
  first.submit(a);
  options.variant = 1;
  options.geometry_of = first.scene();
  RenderSession second(options);
  second.submit(b);
  for (int i = 0; i < 2000; ++i) {
    const SessionStatus x = first.status(), y = second.status();
    if (x.phase == SessionPhase::finished && y.phase == SessionPhase::finished) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(first.wait_finished(240));
  ASSERT_TRUE(second.wait_finished(240));
  EXPECT_EQ(first.status().spp, 40);
  EXPECT_EQ(second.status().spp, 40);

  SessionOptions without_turns;
  without_turns.threads = 2;
  RenderSession alone(without_turns);
  alone.submit(b);
  ASSERT_TRUE(alone.wait_finished(240));
  EXPECT_EQ(alone.latest()->linear, second.latest()->linear) << "taking turns changes no sample";
}

TEST(RenderTurnsRender, EditsDoNotWaitForTheOther) {
  test::SceneMaker scene = test::cornell_flush(48, 48, 0, true); // endless
  auto turns = std::make_shared<RenderTurns>(std::vector<int>{0, 0});
  SessionOptions options;
  options.threads = 2;
  options.turns = turns;
  RenderSession first(options);
  options.variant = 1;
  auto second = std::make_unique<RenderSession>(options);
  first.submit(scene.document);
  second->submit(scene.document);
  for (int i = 0; i < 20; ++i) { // as when a slider is dragged
    scene.document.settings.path.max_depth = 2 + i % 3;
    first.submit(scene.document);
    second->submit(scene.document);
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  auto reaches = [](const RenderSession& session, int spp) {
    for (int i = 0; i < 10000 && session.status().spp < spp; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return session.status().spp >= spp;
  };
  EXPECT_TRUE(reaches(first, 8));
  EXPECT_TRUE(reaches(*second, 8));
  first.pause(true); // then the other continues alone
  const int spp = second->status().spp;
  EXPECT_TRUE(reaches(*second, spp + 100));
  first.pause(false);
  second.reset();
  first.take_turns(nullptr, 0);
  EXPECT_TRUE(reaches(first, first.status().spp + 100));
}

} // namespace
} // namespace candela
