// Work in a thread that may be abandoned.

#include "core/error.h"
#include "io/files/apart.h"

#include <gtest/gtest.h>

#include <semaphore>

namespace candela {
namespace {

struct Apart : ::testing::Test {
  Progress progress;
  WarningList warnings;
};

TEST_F(Apart, GivesWhatTheWorkGives) {
  progress.expect(100);
  {
    ProgressPart part(progress, 100);
    const auto here = std::this_thread::get_id();
    const int given = run_apart(&part, &warnings, [here](ProgressPart* own, WarningList* said) {
      EXPECT_NE(std::this_thread::get_id(), here);
      own->reach(0.5);
      said->add({"a"}, "one");
      said->add({"a"}, "one");
      return 7;
    });
    EXPECT_EQ(given, 7);
  }
  EXPECT_EQ(progress.share(), 1);
  ASSERT_EQ(warnings.warnings().size(), 1u);
  EXPECT_EQ(warnings.warnings()[0], (Warning{"a: one", 2}));
  auto fail = [](ProgressPart*, WarningList*) -> int { throw usage_error("a", "b", "c"); };
  ProgressPart part(progress, 0);
  EXPECT_THROW(run_apart(&part, &warnings, fail), Error);
}

TEST_F(Apart, WithoutProgressItIsDoneHere) {
  const auto here = std::this_thread::get_id();
  EXPECT_TRUE(run_apart(nullptr, &warnings, [&](ProgressPart* own, WarningList* said) {
    return own == nullptr && said == &warnings && std::this_thread::get_id() == here;
  }));
}

// The work ends only when the test lets it, after the caller has been cancelled.
TEST_F(Apart, WorkThatDoesNotListenIsLeftAlone) {
  struct Signals {
    std::binary_semaphore started{0}, may_end{0}, ended{0};
    std::atomic<bool> told{false};
  };
  auto signals = std::make_shared<Signals>();
  std::thread hand([&] {
    signals->started.acquire();
    progress.cancel();
  });
  ProgressPart part(progress, 1);
  EXPECT_THROW(run_apart(&part, &warnings,
                         [signals](ProgressPart* own, WarningList* said) {
                           signals->started.release();
                           signals->may_end.acquire();
                           said->add({"a"}, "its own list is still there");
                           signals->told = own->cancelled();
                           signals->ended.release();
                           return 0;
                         }),
               Cancelled);
  hand.join();
  signals->may_end.release();
  signals->ended.acquire();
  EXPECT_TRUE(signals->told) << "so that it ends where it can";
  EXPECT_TRUE(warnings.warnings().empty());
}

} // namespace
} // namespace candela
