#pragma once
// Denoises snapshots of an accumulation on a thread of its own.

#include "render/denoise/denoise_film.h"
#include "scene/light_layers.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace candela {

/// A snapshot of an accumulation for the denoiser.
struct DenoiseJob {
  std::uint64_t accumulation = 0; ///< Frame::generation of its frames
  std::uint64_t samples = 0;      ///< camera paths in it
  int spp = 0;
  LightMix mix; ///< Frame::mix
  NoisyImage color;
  std::shared_ptr<const RenderScene> scene;
  std::shared_ptr<const Document> document;
};

struct DenoisedImage {
  std::uint64_t accumulation = 0;
  std::uint64_t samples = 0;
  int spp = 0;
  LightMix mix; ///< Frame::mix
  int width = 0, height = 0;
  std::vector<vec3> linear; ///< row 0 is the top
};

class DenoiseThread {
public:
  using Done = std::function<void(std::shared_ptr<const DenoisedImage>)>;
  using Failed = std::function<void(std::string why)>;

  /// Called from the thread: `done` with every image that was not cancelled, `failed` if there is none.
  DenoiseThread(int threads, Done done, Failed failed);
  ~DenoiseThread(); ///< cancels and joins
  DenoiseThread(const DenoiseThread&) = delete;
  DenoiseThread& operator=(const DenoiseThread&) = delete;

  /// Submits a job, which replaces one that was not begun. The one in work continues, so that pictures appear
  /// even if samples arrive faster than they can be denoised. Returns the replaced job, so that its memory
  /// need not be freed under a lock.
  std::unique_ptr<DenoiseJob> post(std::unique_ptr<DenoiseJob> job);
  /// Drops the job in work and the waiting one, which is returned.
  std::unique_ptr<DenoiseJob> cancel();

private:
  void run();

  int threads_;
  Done done_;
  Failed failed_;
  std::mutex mutex_; // held for moves of pointers only
  std::condition_variable posted_;
  std::unique_ptr<DenoiseJob> waiting_;
  bool quit_ = false;
  std::atomic<bool> stop_{false}; ///< the job in work is out of date
  std::thread thread_;
};

} // namespace candela
