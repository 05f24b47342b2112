#include "session/denoise_thread.h"

#include "core/error.h"

#include <new>
#include <sys/resource.h>
#include <unistd.h>

namespace candela {

namespace {

/// Lower priority than rendering (10), but not idle priority, which would delay the picture too long: next to
/// busy render threads it gets about 40 % of a core.
constexpr int kDenoiseNiceness = 12;

} // namespace

DenoiseThread::DenoiseThread(int threads, Done done, Failed failed)
    : threads_(threads), done_(std::move(done)), failed_(std::move(failed)), thread_([this] { run(); }) {}

DenoiseThread::~DenoiseThread() {
  {
    std::lock_guard lock(mutex_);
    quit_ = true;
    stop_ = true;
  }
  posted_.notify_one();
  thread_.join();
}

std::unique_ptr<DenoiseJob> DenoiseThread::post(std::unique_ptr<DenoiseJob> job) {
  {
    std::lock_guard lock(mutex_);
    waiting_.swap(job);
  }
  posted_.notify_one();
  return job;
}

std::unique_ptr<DenoiseJob> DenoiseThread::cancel() {
  std::lock_guard lock(mutex_);
  stop_ = true;
  return std::move(waiting_);
}

void DenoiseThread::run() {
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kDenoiseNiceness); // its OpenMP workers inherit it
  FeatureFilm features;
  std::uint64_t features_of = 0;                      // accumulation
  BuildQuality features_quality = BuildQuality::high; // of its geometry, which affects rounding
  for (;;) {
    std::unique_ptr<DenoiseJob> job;
    {
      std::unique_lock lock(mutex_);
      posted_.wait(lock, [this] { return quit_ || waiting_; });
      if (quit_) return;
      job = std::move(waiting_);
      stop_ = false;
    }
    try {
      const int width = job->color.variance.width, height = job->color.variance.height;
      const BuildQuality quality = job->scene->geometry().quality();
      if (features_of != job->accumulation || features_quality != quality) {
        features = FeatureFilm(width, height);
        features_of = job->accumulation;
        features_quality = quality;
      }
      auto image = denoise_render(std::move(job->color), job->spp, *job->scene, *job->document, features,
                                  {threads_, &stop_});
      if (!image) {
        features_of = 0; // the features may be incomplete
        continue;
      }
      auto made = std::make_shared<DenoisedImage>();
      made->accumulation = job->accumulation;
      made->samples = job->samples;
      made->spp = job->spp;
      made->mix = std::move(job->mix);
      made->width = width;
      made->height = height;
      made->linear = std::move(image->pixels);
      done_(std::move(made));
    } catch (const std::bad_alloc&) { // the noisy picture stays
      features = FeatureFilm();
      features_of = 0;
      failed_("not denoised: out of memory");
    } catch (const Error& e) { // from Open Image Denoise
      failed_(e.what());
    }
  }
}

} // namespace candela
