#include "app/lab/lab_job.h"
#include "lab/experiments.h"

#include <gtest/gtest.h>

#include <thread>

namespace candela::test {
namespace {

using Lesson = Estimation<PiExperiment>;

Lesson lesson_of(std::uint64_t samples, std::uint64_t seed) {
  return Lesson({}, {SamplerType::sobol, seed}, samples);
}

template <class Condition>
void step_until(LabJob<Lesson>& job, TaskThread& worker, Condition done) {
  while (!done()) {
    job.step(worker);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    worker.run_completions();
  }
}

TEST(LabJob, ComesToWhatTheLessonComesToAtOnce) {
  LabJob<Lesson> job;
  TaskThread worker({});
  EXPECT_FALSE(job.busy());
  EXPECT_EQ(job.shown(), nullptr);
  job.start([] { return lesson_of(3000000, 5); }); // more than a slice
  EXPECT_TRUE(job.busy());
  step_until(job, worker, [&] { return !job.busy(); });
  Lesson whole = lesson_of(3000000, 5);
  whole.advance(3000000);
  ASSERT_NE(job.shown(), nullptr);
  EXPECT_EQ(job.shown()->estimate(), whole.estimate());
  EXPECT_EQ(job.shown()->trace().size(), whole.trace().size());
}

TEST(LabJob, TheLatestStartWins) {
  LabJob<Lesson> job;
  TaskThread worker({});
  job.start([] { return lesson_of(1000000000, 1); });
  job.step(worker);
  job.start([] { return lesson_of(100, 2); });
  step_until(job, worker, [&] { return !job.busy(); });
  EXPECT_EQ(job.shown()->samples(), 100u);
  EXPECT_EQ(job.shown()->source().seed, 2u);
}

TEST(LabJob, DoesNothingUnlessItIsStepped) {
  LabJob<Lesson> job;
  TaskThread worker({});
  job.start([] { return lesson_of(1000000000, 1); });
  step_until(job, worker, [&] { return job.shown() != nullptr; });
  const std::uint64_t done = job.shown()->done();
  EXPECT_GT(done, 0u);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(worker.pending(), 0);
  EXPECT_EQ(job.shown()->done(), done);
}

} // namespace
} // namespace candela::test
