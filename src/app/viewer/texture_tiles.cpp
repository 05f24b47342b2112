#include "app/viewer/texture_tiles.h"

#include "app/platform/gl_texture.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>

namespace candela {

namespace {

/// Of one task, so that pictures appear while there is more to make.
constexpr std::chrono::milliseconds kSlice(30);
/// Uploads of one frame: they are the UI thread's.
constexpr std::size_t kMostATask = 16;

} // namespace

TextureTiles::~TextureTiles() { clear(); }

void TextureTiles::clear() {
  work_->cancel();
  work_ = std::make_shared<Progress>();
  newest_->fetch_add(1, std::memory_order_relaxed);
  release(now_);
  release(before_);
  now_ = before_ = {};
  now_.number = newest_->load(std::memory_order_relaxed);
  grid_.reset();
  complete_ = false;
}

void TextureTiles::release(Look& look) {
  for (const auto& [key, tile] : look.tiles) gl_.DeleteTextures(1, &tile.texture);
  look.tiles.clear();
}

void TextureTiles::show(std::shared_ptr<const TextureGrid> grid, const TextureDisplay& display) {
  if (grid == now_.grid && display == now_.display) return;
  const std::uint64_t number = newest_->fetch_add(1, std::memory_order_relaxed) + 1;
  if (!now_.tiles.empty()) { // else the one before is still the newest with something to see
    release(before_);
    before_ = std::move(now_);
  }
  now_ = {grid, display, {}, number};
  grid_ = std::move(grid);
  complete_ = false;
}

std::size_t TextureTiles::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Look* look : {&now_, &before_})
    for (const auto& [key, tile] : look->tiles)
      bytes += 4 * static_cast<std::size_t>(tile.size.x * tile.size.y);
  return bytes;
}

ivec2 TextureTiles::tile_size(const TextureGrid& grid, const Key& key) {
  return glm::min(ivec2(kSide), reduced_size(grid.size(), key.reduction) - kSide * ivec2(key.x, key.y));
}

/// The reduction at which the grid is one tile.
int TextureTiles::coarsest() const {
  int reduction = 0;
  while (std::max(reduced_size(grid_->size(), reduction).x, reduced_size(grid_->size(), reduction).y) > kSide)
    ++reduction;
  return reduction;
}

std::vector<TextureTiles::Key> TextureTiles::visible(const GridRect& rect, vec2 clip_lo, vec2 clip_hi,
                                                     int reduction) const {
  const vec2 size(grid_->size());
  // In values of the grid.
  const vec2 lo = glm::clamp((clip_lo - rect.lo) / (rect.hi - rect.lo), 0.0f, 1.0f) * size,
             hi = glm::clamp((clip_hi - rect.lo) / (rect.hi - rect.lo), 0.0f, 1.0f) * size;
  std::vector<Key> keys;
  if (!(lo.x < hi.x && lo.y < hi.y)) return keys;
  const float side = static_cast<float>(kSide) * std::exp2(static_cast<float>(reduction));
  const ivec2 first(glm::floor(lo / side)), end(glm::ceil(hi / side));
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) keys.push_back({reduction, x, y});
  return keys;
}

void TextureTiles::draw(ImDrawList& list, const GridRect& rect, vec2 clip_lo, vec2 clip_hi,
                        TaskThread& worker) {
  if (!grid_ || !(rect.hi.x > rect.lo.x && rect.hi.y > rect.lo.y)) return;
  ++frame_;
  const float pixels_per_value = (rect.hi.x - rect.lo.x) / static_cast<float>(grid_->size().x);
  // Drawn at 1/2 to 1 of its size, where linear filtering sees every pixel.
  const int last = coarsest();
  const int reduction = std::clamp(static_cast<int>(std::floor(std::log2(1 / pixels_per_value))), 0, last);
  std::vector<Key> missing;
  const Key whole{last, 0, 0};
  if (const auto found = now_.tiles.find(whole); found != now_.tiles.end())
    found->second.used = frame_; // stays, for what is not there
  else
    missing.push_back(whole);
  if (reduction < last)
    for (const Key& key : visible(rect, clip_lo, clip_hi, reduction))
      if (!now_.tiles.contains(key)) missing.push_back(key);
  complete_ = missing.empty();
  if (complete_) {
    release(before_);
    before_ = {};
  } else if (before_.grid &&
             before_.grid->options().copies == grid_->options().copies) { // else it lies elsewhere
    draw_tiles(list, before_, rect, clip_lo, clip_hi, 0);
  }
  draw_tiles(list, now_, rect, clip_lo, clip_hi, reduction);
  evict();
  if (!complete_ && !in_work_) post(std::move(missing), worker);
}

/// From coarse to fine; where all is there, the finest alone.
void TextureTiles::draw_tiles(ImDrawList& list, Look& look, const GridRect& rect, vec2 clip_lo, vec2 clip_hi,
                              int least_reduction) {
  const vec2 size(look.grid->size()), scale = (rect.hi - rect.lo) / size;
  for (auto at = look.tiles.rbegin(); at != look.tiles.rend(); ++at) {
    auto& [key, tile] = *at;
    if (key.reduction < least_reduction || (complete_ && key.reduction > least_reduction)) continue;
    const float block = std::exp2(static_cast<float>(key.reduction));
    const vec2 origin = block * static_cast<float>(kSide) * vec2(key.x, key.y);
    // The last pixel may stand for fewer values.
    const vec2 end = glm::min(origin + block * vec2(tile.size), size);
    const vec2 lo = rect.lo + scale * origin, hi = rect.lo + scale * end;
    if (hi.x <= clip_lo.x || hi.y <= clip_lo.y || lo.x >= clip_hi.x || lo.y >= clip_hi.y) continue;
    const vec2 part = (end - origin) / (block * vec2(tile.size));
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(tile.texture)), {lo.x, lo.y},
                  {hi.x, hi.y}, {0, 0}, {part.x, part.y});
    tile.used = frame_;
  }
}

void TextureTiles::post(std::vector<Key> wanted, TaskThread& worker) {
  in_work_ = true;
  if (wanted.size() > kMostATask) wanted.resize(kMostATask);
  worker.post([this, wanted = std::move(wanted), grid = now_.grid, display = now_.display,
               number = now_.number, newest = newest_, progress = work_]() -> TaskThread::Completion {
    auto made = std::make_shared<std::vector<Made>>();
    const auto end = std::chrono::steady_clock::now() + kSlice;
    try {
      for (const Key& key : wanted) {
        const ivec2 size = tile_size(*grid, key);
        made->push_back(
            {key, size,
             grid_pixels(*grid, display, key.reduction, kSide * ivec2(key.x, key.y), size, progress.get())});
        // One tile is made in any case: something of a slider's way is seen.
        if (std::chrono::steady_clock::now() >= end || newest->load(std::memory_order_relaxed) != number)
          break;
      }
    } catch (const Cancelled&) {}
    return [this, grid, display, number, made] {
      in_work_ = false;
      made_ += made->size();
      if (number == now_.number && now_.grid)
        install(now_, *made);
      else if (number > before_.number && now_.grid && !complete_) { // a step of a slider that goes on
        release(before_);
        before_ = {grid, display, {}, number};
        install(before_, *made);
      }
    };
  });
}

void TextureTiles::install(Look& look, const std::vector<Made>& made) {
  for (const Made& m : made) {
    Tile& tile = look.tiles[m.key];
    if (tile.texture == 0) gl_.GenTextures(1, &tile.texture);
    tile.size = m.size;
    tile.used = frame_;
    upload_rgba8(gl_, tile.texture, m.size, m.pixels.data(), GL_LINEAR, GL_NEAREST);
  }
}

/// Frees the tiles that were drawn longest ago. Those of this frame stay, however many they are.
void TextureTiles::evict() {
  while (memory_bytes() > kMostBytes) {
    auto oldest =
        std::ranges::min_element(now_.tiles, {}, [](const auto& entry) { return entry.second.used; });
    if (oldest == now_.tiles.end() || oldest->second.used == frame_) return;
    gl_.DeleteTextures(1, &oldest->second.texture);
    now_.tiles.erase(oldest);
  }
}

} // namespace candela
