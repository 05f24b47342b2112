// From the film to the screen: snapshots for the denoiser and the presenter, and the pictures that they make.

#include "render/film/film_view.h"
#include "session/session_state.h"

namespace candela {

namespace {

/// display_rgba8() of a picture that is made of blocks, which costs less than one that is not.
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

/// Copying a frame out must not take more of the render thread than this share.
constexpr double kPublishShare = 0.05;

} // namespace

/// Hands a snapshot to the presenter; between full images only so often that copying costs little.
void RenderSession::State::publish(bool force) {
  auto start = Clock::now();
  double interval = std::max(publish_interval.load(), publish_cost / kPublishShare);
  bool due = (force || seconds_between(published_at, start) >= interval) && rays.samples >= samples_to_show;
  std::shared_ptr<Frame> snapshot;
  if (due) {
    snapshot = frames.take();
    snapshot->generation = accumulation;
    snapshot->width = film.width();
    snapshot->height = film.height();
    snapshot->coarseness = spp > 0 ? 1 : kCoarseLevels[level - 1];
    snapshot->spp = spp;
    snapshot->document = scene_document;
    snapshot->view = current.settings.view;
    resolve_view(film, snapshot->view, snapshot->coarseness, snapshot->linear);
    snapshot->variance.clear();
    snapshot->samples.clear();
    if (spp > 0) resolve_statistics(film, snapshot->variance, snapshot->samples);
    snapshot->display_scale = display_scale(*scene, current.settings);
    snapshot->rays = rays;
    snapshot->render_seconds = render_seconds;
    snapshot->first_pass_seconds = spp > 0 ? first_pass_seconds : 0;
    snapshot->nonfinite = nonfinite;
    published_samples = rays.samples;
    published_view = snapshot->view;
    published_at = Clock::now();
    publish_cost = seconds_between(start, published_at);
  }
  std::lock_guard lock(mutex);
  if (snapshot) frame = std::move(snapshot);
  status.spp = spp;
  status.rays = rays;
  status.render_seconds = render_seconds;
  status.nonfinite = nonfinite.count;
  const StopSettings& until = current.settings.stop;
  double by_spp = until.spp > 0 ? static_cast<double>(spp) / until.spp : 0;
  double by_time = until.time > 0 ? render_seconds / static_cast<double>(until.time) : 0;
  status.progress = std::min(std::max(by_spp, by_time), 1.0);
  changed.notify_all();
}

/// Takes a snapshot for the denoiser whenever the samples have doubled, which costs the render thread ever
/// less, and when no more come.
void RenderSession::State::feed_denoiser(bool settled) {
  if (!current.settings.display.denoise || current.settings.view != View::radiance || spp < 2) return;
  if (rays.samples < samples_to_show) return;
  const bool due = rays.samples >= 2 * denoised_samples || (settled && rays.samples != denoised_samples);
  if (!due) return;
  auto job = std::make_unique<DenoiseJob>();
  job->accumulation = accumulation;
  job->samples = rays.samples;
  job->spp = spp;
  job->color = noisy_image(film);
  std::unique_ptr<DenoiseJob> replaced;
  std::lock_guard lock(mutex);
  if (pending && pending_worst >= Invalidates::image) return; // it is out of date already
  job->scene = scene;
  job->document = scene_document;
  replaced = denoiser.post(std::move(job));
  denoised_samples = rays.samples;
}

void RenderSession::State::show_denoised(std::shared_ptr<const DenoisedImage> made) {
  {
    std::lock_guard lock(mutex);
    denoised = std::move(made);
    status.denoise_error.clear();
  }
  changed.notify_all();
}

void RenderSession::State::show_denoise_error(std::string why) {
  {
    std::lock_guard lock(mutex);
    status.denoise_error = std::move(why);
  }
  changed.notify_all();
  if (options.on_publish) options.on_publish();
}

std::shared_ptr<const DenoisedImage> RenderSession::State::denoised_to_show() const {
  const bool fits = newest.settings.display.denoise && frame && frame->view == View::radiance && denoised &&
                    denoised->accumulation == frame->generation;
  return fits ? denoised : nullptr;
}

void RenderSession::State::present_loop() {
  Recycler<DisplayImage> images;
  {
    std::lock_guard lock(mutex);
    presenter_clock = thread_cpu_clock();
  }
  while (true) {
    std::shared_ptr<const Frame> source;
    std::shared_ptr<const DenoisedImage> clean;
    DisplaySettings display;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [&] {
        return quit || (frame &&
                        (!picture || picture->frame != frame || picture->display != newest.settings.display ||
                         picture->denoised != denoised_to_show()));
      });
      if (quit) return;
      source = frame;
      clean = denoised_to_show();
      display = newest.settings.display;
    }
    const std::shared_ptr<DisplayImage> made = images.take();
    made->frame = source;
    made->denoised = clean;
    const std::vector<vec3>& linear = made->linear();
    made->display = display;
    made->width = source->width;
    made->height = source->height;
    made->rgba.resize(4 * linear.size());
    made->transform = display_transform(linear, source->width, source->height, display, source->view,
                                        source->display_scale);
    tone_map_blocks(linear, made->width, clean ? 1 : source->coarseness, made->transform, made->rgba);
    {
      std::lock_guard lock(mutex);
      picture = made;
      if (first_image_generation != 0 && source->generation >= first_image_generation) {
        status.first_image_ms = 1000 * seconds_between(first_image_submitted, Clock::now());
        first_image_generation = 0;
      }
    }
    changed.notify_all();
    if (options.on_publish) options.on_publish();
  }
}

} // namespace candela
