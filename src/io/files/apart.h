#pragma once
// Work that cannot be interrupted, in a thread that can be left alone.

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

/// Counts the threads that run apart. Those that were left alone are told to stop, and the end of the program
/// waits a little for them, so that they find the libraries that they use.
class ApartThread {
public:
  ApartThread();
  ApartThread(ApartThread&& other) noexcept : counts_(std::exchange(other.counts_, false)) {}
  ApartThread& operator=(ApartThread&&) = delete;
  ~ApartThread();

private:
  bool counts_ = true;
};

/// Does the work in a thread of its own, and gives what it gives or throws. check() is called again and again
/// meanwhile; what it throws is thrown at once, and the thread is left to end alone: so `work` must own all
/// that it uses.
template <class Work, class Check>
auto run_while(Work work, Check check) {
  std::packaged_task<std::invoke_result_t<Work&>()> task(std::move(work));
  auto result = task.get_future();
  std::thread([task = std::move(task), count = ApartThread()]() mutable { task(); }).detach();
  while (result.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) check();
  return result.get();
}

/// Calls work(progress, warnings) like that until `progress` says that it is to end, which throws Cancelled.
/// What the work is handed is its own, too. Without `progress` the work is done here.
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
