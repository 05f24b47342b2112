#include "session/urgent_thread.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace candela {
namespace {

TEST(UrgentThread, RunsWorkOnAThreadOfItsOwnAndWaits) {
  std::thread::id prepared, ran;
  UrgentThread urgent([&] { prepared = std::this_thread::get_id(); });
  for (int i = 0; i < 100; ++i) {
    ran = {};
    urgent.run([&] { ran = std::this_thread::get_id(); });
    ASSERT_EQ(ran, prepared);
  }
  EXPECT_NE(ran, std::this_thread::get_id());
}

TEST(UrgentThread, RethrowsWhatTheWorkThrowsAndContinues) {
  UrgentThread urgent([] {});
  EXPECT_THROW(urgent.run([] { throw std::runtime_error("full"); }), std::runtime_error);
  int done = 0;
  urgent.run([&] { ++done; });
  EXPECT_EQ(done, 1);
}

} // namespace
} // namespace candela
