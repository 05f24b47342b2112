#include "app/viewer/material_thumbnails.h"

#include "app/platform/data_file.h"
#include "app/platform/gl_texture.h"
#include "core/error.h"
#include "io/scene_reader.h"
#include "session/worker_threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace candela {

namespace {

constexpr float kSide = 64; // at scale 1

} // namespace

MaterialThumbnails::MaterialThumbnails(const Gl& gl, ThumbnailOptions options, std::function<void()> wake)
    : gl_(gl), options_(std::move(options)), worker_(std::move(wake)) {
  if (options_.studio.empty()) options_.studio = find_data_file_if_any("scenes/studio.json");
}

MaterialThumbnails::~MaterialThumbnails() {
  if (stop_) stop_->store(true, std::memory_order_relaxed);
  for (const Entry& entry : entries_) gl_.DeleteTextures(1, &entry.texture);
}

std::shared_ptr<const std::vector<std::uint8_t>> MaterialThumbnails::finished(const SceneDesc& scene,
                                                                              std::size_t material) const {
  const MaterialSample sample = material_sample(scene, material);
  for (const Entry& entry : entries_)
    if (entry.spp == options_.spp && entry.sample == sample) return entry.pixels;
  return nullptr;
}

std::string MaterialThumbnails::problem(const SceneDesc& scene, std::size_t material) const {
  const MaterialSample sample = material_sample(scene, material);
  const auto found = std::ranges::find(entries_, sample, &Entry::sample);
  return found == entries_.end() ? std::string() : found->problem;
}

MaterialThumbnails::Entry* MaterialThumbnails::find(const MaterialSample& sample, int side) {
  const auto found = std::ranges::find_if(
      entries_, [&](const Entry& entry) { return entry.side == side && entry.sample == sample; });
  return found == entries_.end() ? nullptr : &*found;
}

void MaterialThumbnails::begin_frame(ViewerState& state) {
  worker_.run_completions();
  const std::size_t count = state.document.scene.materials.size();
  if (shown_.size() != count || shown_scene_ != state.scene_path) {
    shown_.assign(count, nullptr);
    shown_scene_ = state.scene_path;
  }
  ThumbnailState& thumbnails = state.thumbnails;
  thumbnails.textures.assign(count, 0);
  thumbnails.problems.assign(count, "");
  for (std::size_t i = 0; i < count; ++i)
    if (shown_[i] != nullptr) {
      thumbnails.textures[i] = shown_[i]->texture;
      thumbnails.problems[i] = shown_[i]->problem;
    }
  thumbnails.drawn.clear();
}

void MaterialThumbnails::end_frame(ViewerState& state, bool may_begin) {
  ++frame_;
  const SceneDesc& scene = state.document.scene;
  const int side = static_cast<int>(std::lround(kSide * state.scale));
  std::vector<Wanted> wanted;
  bool still_wanted = false;
  for (std::size_t i : state.thumbnails.drawn) {
    if (i >= shown_.size() || i >= scene.materials.size()) continue; // edited in this frame
    if (shown_[i] != nullptr) shown_[i]->used = frame_;
    MaterialSample sample = material_sample(scene, i);
    Entry* entry = shown_[i] != nullptr && shown_[i]->side == side && shown_[i]->sample == sample
                       ? shown_[i]
                       : find(sample, side);
    still_wanted |= stop_ && sample == in_work_;
    if (entry != nullptr) {
      shown_[i] = entry;
      entry->used = frame_;
      if (entry->spp == options_.spp || entry->spp == 0) continue;
    }
    wanted.push_back({i, std::move(sample), entry == nullptr ? options_.first_spp : options_.spp});
  }
  evict();
  if (state.thumbnails.drawn.empty()) scene_.reset();
  if (stop_ && !still_wanted) stop_->store(true, std::memory_order_relaxed);
  const auto next = std::ranges::min_element(wanted, {}, &Wanted::spp);
  waits_ = next != wanted.end() && !stop_;
  if (!waits_ || !may_begin) return;
  waits_ = false;
  begin(next->sample, side, next->spp);
}

void MaterialThumbnails::begin(const MaterialSample& sample, int side, int spp) {
  ++begun_;
  in_work_ = sample;
  stop_ = std::make_shared<std::atomic<bool>>(false);
  worker_.post([this, sample, side, spp, niceness = options_.niceness, stop = stop_, studio = studio_,
                scene = scene_, path = options_.studio]() mutable -> TaskThread::Completion {
    WorkerThreads(1).start(niceness);
    std::shared_ptr<const std::vector<std::uint8_t>> pixels;
    bool given_up = false;
    std::string problem;
    try {
      if (!studio) studio = std::make_shared<const Document>(read_scene(path.string()).document);
      const auto document = preview_document(*studio, sample, side, spp);
      if (!document) {
        problem =
            fmt::format("{}: materials: none is called \"material\": give one that name", path.string());
      } else {
        auto preview = render_preview(*document, std::move(scene), *stop);
        given_up = !preview;
        if (preview) {
          pixels = std::make_shared<const std::vector<std::uint8_t>>(std::move(preview->rgba));
          scene = std::move(preview->scene);
        }
      }
    } catch (const Error& e) { problem = e.what(); } catch (const std::bad_alloc&) {
      problem = "there is not enough memory: close other programs";
    }
    return [this, sample, side, spp, studio, scene = std::move(scene), pixels, given_up,
            problem = std::move(problem)] {
      studio_ = studio;
      if (!given_up) scene_ = scene; // the next frame frees it if no thumbnail is drawn any more
      stop_.reset();
      if (!given_up) finish(sample, side, spp, pixels, problem);
    };
  });
}

void MaterialThumbnails::finish(const MaterialSample& sample, int side, int spp,
                                std::shared_ptr<const std::vector<std::uint8_t>> pixels,
                                std::string problem) {
  Entry* entry = find(sample, side);
  if (entry == nullptr) {
    entry = &entries_.emplace_back();
    entry->sample = sample;
    entry->side = side;
  }
  entry->used = frame_;
  entry->spp = pixels ? spp : 0;
  entry->pixels = std::move(pixels);
  entry->problem = std::move(problem);
  if (entry->pixels) upload(*entry);
}

void MaterialThumbnails::upload(Entry& entry) {
  if (entry.texture == 0) gl_.GenTextures(1, &entry.texture);
  upload_rgba8(gl_, entry.texture, ivec2(entry.side), entry.pixels->data(), GL_LINEAR_MIPMAP_LINEAR,
               GL_LINEAR);
  gl_.GenerateMipmap(GL_TEXTURE_2D);
}

/// Those that were drawn longest ago.
void MaterialThumbnails::evict() {
  while (entries_.size() > options_.most) {
    const auto oldest = std::ranges::min_element(entries_, {}, &Entry::used);
    if (oldest->used == frame_) return;
    std::ranges::replace(shown_, &*oldest, nullptr);
    gl_.DeleteTextures(1, &oldest->texture);
    entries_.erase(oldest);
  }
}

} // namespace candela
