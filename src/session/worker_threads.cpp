#include "session/worker_threads.h"

#include <omp.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

namespace candela {

clockid_t thread_cpu_clock() {
  clockid_t clock{};
  pthread_getcpuclockid(pthread_self(), &clock);
  return clock;
}

double cpu_seconds(clockid_t clock) {
  timespec time{};
  if (clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

int WorkerThreads::count() const { return threads_ > 0 ? threads_ : omp_get_num_procs(); }

void WorkerThreads::start(int niceness) {
  if (niceness > 0) setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness);
  omp_set_num_threads(count()); // the same workers for every region
#pragma omp parallel
  {
    const clockid_t clock = thread_cpu_clock();
    std::lock_guard lock(mutex_);
    clocks_.push_back(clock);
  }
}

double WorkerThreads::cpu_seconds() const {
  std::lock_guard lock(mutex_);
  double seconds = 0;
  for (clockid_t clock : clocks_) seconds += candela::cpu_seconds(clock);
  return seconds;
}

} // namespace candela
