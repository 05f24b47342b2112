#pragma once
// Runs work that cannot be interrupted in a thread that can be abandoned.

#include "core/progress.h"
#include "io/files/warning_list.h"

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <type_traits>
#include <utility>

namespace candela {

/// Counts these threads. Abandoned ones are told to stop, and the program's end waits for them a short time,
/// so that libraries are not unloaded while they run.
class ApartThread {
public:
  ApartThread();
  ApartThread(ApartThread&& other) noexcept : counts_(std::exchange(other.counts_, false)) {}
  ApartThread& operator=(ApartThread&&) = delete;
  ~ApartThread();

private:
  bool counts_ = true;
};

/// Runs `work` in a thread of its own and returns its result or rethrows its exception. Meanwhile check() is
/// called repeatedly; if it throws, the exception is rethrown at once and the thread is abandoned. So `work`
/// must own everything that it uses.
template <class Work, class Check>
auto run_while(Work work, Check check) {
  std::packaged_task<std::invoke_result_t<Work&>()> task(std::move(work));
  auto result = task.get_future();
  std::thread([task = std::move(task), count = ApartThread()]() mutable { task(); }).detach();
  while (result.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) check();
  return result.get();
}

/// Calls work(progress, warnings) in this way, with objects of its own; throws Cancelled when `progress` is
/// cancelled. Without `progress` the work runs on the calling thread.
template <class Work>
auto run_apart(ProgressPart* progress, WarningList* warnings, Work work) {
  if (!progress) return work(static_cast<ProgressPart*>(nullptr), warnings);
  constexpr std::uint64_t kUnits = 1 << 20;
  auto own = std::make_shared<Progress>();
  auto said = std::make_shared<WarningList>(own);
  own->expect(kUnits);
  auto result = run_while(
      [own, said, work = std::move(work)]() mutable {
        ProgressPart part(*own, kUnits);
        return work(&part, said.get());
      },
      [&] {
        if (progress->cancelled()) own->cancel();
        progress->reach(own->share());
      });
  if (warnings) warnings->add(*said);
  return result;
}

} // namespace candela
