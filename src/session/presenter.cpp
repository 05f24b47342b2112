#include "session/presenter.h"

#include "render/film/film_view.h"

#include <algorithm>

namespace candela {

namespace {

/// Largest share of the render thread's time for copying snapshots.
constexpr double kPublishShare = 0.05;

double seconds_between(Presenter::Clock::time_point a, Presenter::Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

/// display_rgba8() of a picture of constant blocks, at a lower cost.
void tone_map_blocks(std::span<const vec3> linear, int width, int block, const DisplayTransform& transform,
                     std::span<std::uint8_t> rgba) {
  if (block == 1) {
    display_rgba8(linear, {width}, transform, rgba);
    return;
  }
  const auto columns = static_cast<std::size_t>(width), side = static_cast<std::size_t>(block);
  const std::size_t rows = linear.size() / columns;
  std::vector<vec3> corners;
  for (std::size_t y = 0; y < rows; y += side)
    for (std::size_t x = 0; x < columns; x += side) corners.push_back(linear[y * columns + x]);
  std::vector<std::uint8_t> mapped(4 * corners.size());
  display_rgba8(corners, {(width + block - 1) / block}, transform, mapped);
  const std::uint8_t* from = mapped.data();
  for (std::size_t y = 0; y < rows; y += side) {
    const auto row = rgba.begin() + static_cast<std::ptrdiff_t>(4 * y * columns);
    for (std::size_t x = 0; x < columns; ++x)
      std::copy_n(from + 4 * (x / side), 4, row + static_cast<std::ptrdiff_t>(4 * x));
    from += 4 * ((columns + side - 1) / side);
    for (std::size_t below = y + 1; below < std::min(y + side, rows); ++below)
      std::copy_n(row, 4 * columns, rgba.begin() + static_cast<std::ptrdiff_t>(4 * below * columns));
  }
}

} // namespace

Presenter::Presenter(SessionMonitor& monitor, int threads, double interval, OnPublish on_publish)
    : monitor_(monitor), on_publish_(std::move(on_publish)), interval_(interval),
      denoiser_(
          threads, [this](std::shared_ptr<const DenoisedImage> made) { receive(std::move(made)); },
          [this](std::string why) { receive_error(std::move(why)); }),
      thread_([this] { run(); }) {}

std::unique_ptr<DenoiseJob> Presenter::outdate(Locked) {
  denoise_error_.clear();
  return denoiser_.cancel();
}

double Presenter::cpu_seconds(Locked) const { return clock_ ? candela::cpu_seconds(*clock_) : 0; }

bool Presenter::shows_newest(Locked, std::uint64_t samples) const {
  if (!picture_ || picture_->frame != frame_ || picture_->display != display_) return false;
  if (!denoises(*frame_) || frame_->spp < 2 || !denoise_error_.empty()) return true;
  return picture_->denoised && picture_->denoised->accumulation == frame_->generation &&
         picture_->denoised->samples == samples && picture_->denoised->mix == frame_->mix;
}

void Presenter::await_first_image(Locked, std::uint64_t generation, Clock::time_point submitted) {
  first_image_ms_ = -1;
  awaited_ = generation;
  awaited_submitted_ = submitted;
}

void Presenter::begin_accumulation(std::uint64_t keep_until) {
  keep_until_ = keep_until;
  published_samples_ = 0;
  denoised_samples_ = 0;
}

std::shared_ptr<const Frame> Presenter::snapshot(const Source& source, bool force) {
  const Accumulation& from = source.accumulation;
  const auto start = Clock::now();
  const double interval = std::max(interval_.load(), publish_cost_ / kPublishShare);
  const bool due = force || seconds_between(published_at_, start) >= interval;
  if (!due || from.rays().samples < keep_until_) return nullptr;
  const std::shared_ptr<Frame> frame = frames_.take();
  frame->generation = source.generation;
  frame->width = from.film().width();
  frame->height = from.film().height();
  frame->coarseness = from.coarseness();
  frame->spp = from.spp();
  frame->document = source.built.document;
  frame->view = source.document.settings.view;
  frame->mix = from.mix();
  const Film& picture = from.picture(mixed_);
  resolve_view(picture, frame->view, frame->coarseness, frame->linear);
  frame->variance.clear();
  frame->samples.clear();
  if (frame->spp > 0) resolve_statistics(picture, frame->variance, frame->samples);
  frame->display_scale = display_scale(*source.built.scene, source.document.settings);
  frame->rays = from.rays();
  frame->render_seconds = from.seconds();
  frame->first_pass_seconds = from.first_pass_seconds();
  frame->nonfinite = from.nonfinite();
  published_samples_ = from.rays().samples;
  published_view_ = frame->view;
  published_mix_ = frame->mix;
  published_at_ = Clock::now();
  publish_cost_ = seconds_between(start, published_at_);
  return frame;
}

std::unique_ptr<DenoiseJob> Presenter::denoise_job(const Source& source, bool settled) {
  const RenderSettings& settings = source.document.settings;
  const Accumulation& from = source.accumulation;
  const std::uint64_t samples = from.rays().samples;
  if (!settings.display.denoise || settings.view != View::radiance || from.spp() < 2) return nullptr;
  if (samples < keep_until_) return nullptr;
  const bool due = samples >= 2 * denoised_samples_ || (settled && samples != denoised_samples_);
  if (!due) return nullptr;
  auto job = std::make_unique<DenoiseJob>();
  job->accumulation = source.generation;
  job->samples = samples;
  job->spp = from.spp();
  job->mix = from.mix();
  job->color = noisy_image(from.picture(mixed_));
  job->scene = source.built.scene;
  job->document = source.built.document;
  return job;
}

std::unique_ptr<DenoiseJob> Presenter::denoise(Locked, std::unique_ptr<DenoiseJob> job) {
  denoised_samples_ = job->samples;
  return denoiser_.post(std::move(job));
}

/// Called on the denoiser's thread.
void Presenter::receive(std::shared_ptr<const DenoisedImage> made) {
  {
    const auto lock = monitor_.lock();
    denoised_ = std::move(made);
    denoise_error_.clear();
  }
  monitor_.changed.notify_all();
}

void Presenter::receive_error(std::string why) {
  {
    const auto lock = monitor_.lock();
    denoise_error_ = std::move(why);
  }
  monitor_.changed.notify_all();
  if (on_publish_) on_publish_();
}

/// The newest frame's denoised image, if it is to be shown. The mutex must be held.
std::shared_ptr<const DenoisedImage> Presenter::denoised_to_show() const {
  const bool fits = frame_ && denoises(*frame_) && denoised_ &&
                    denoised_->accumulation == frame_->generation && denoised_->mix == frame_->mix;
  return fits ? denoised_ : nullptr;
}

void Presenter::run() {
  Recycler<DisplayImage> images;
  {
    const auto lock = monitor_.lock();
    clock_ = thread_cpu_clock();
  }
  while (true) {
    std::shared_ptr<const Frame> frame;
    std::shared_ptr<const DenoisedImage> denoised;
    DisplaySettings display;
    {
      auto lock = monitor_.lock();
      monitor_.changed.wait(lock, [&] {
        return closed_ ||
               (frame_ && (!picture_ || picture_->frame != frame_ || picture_->display != display_ ||
                           picture_->denoised != denoised_to_show()));
      });
      if (closed_) return;
      frame = frame_;
      denoised = denoised_to_show();
      display = display_;
    }
    const std::shared_ptr<DisplayImage> made = images.take();
    made->frame = frame;
    made->denoised = denoised;
    made->display = display;
    const Frame& source = *frame;
    const std::vector<vec3>& linear = made->linear();
    made->width = source.width;
    made->height = source.height;
    made->rgba.resize(4 * linear.size());
    made->transform =
        display_transform(linear, source.width, source.height, display, source.view, source.display_scale);
    tone_map_blocks(linear, made->width, denoised ? 1 : source.coarseness, made->transform, made->rgba);
    {
      const auto lock = monitor_.lock();
      picture_ = made;
      if (awaited_ != 0 && source.generation >= awaited_) {
        first_image_ms_ = 1000 * seconds_between(awaited_submitted_, Clock::now());
        awaited_ = 0;
      }
    }
    monitor_.changed.notify_all();
    if (on_publish_) on_publish_();
  }
}

} // namespace candela
