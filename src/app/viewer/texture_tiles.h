#pragma once
// A texture's picture in tiles: made on another thread where they are visible, kept while there is room.

#include "app/platform/gl.h"
#include "app/platform/task_thread.h"
#include "core/math.h"
#include "textures/texture_grid.h"

#include <atomic>
#include <map>
#include <memory>
#include <tuple>

struct ImDrawList;

namespace candela {

/// The whole grid on the screen: framebuffer pixels, which may lie outside of the window.
struct GridRect {
  vec2 lo{0}, hi{0};
};

class TextureTiles {
public:
  static constexpr int kSide = 256;                                ///< of a tile, pixels
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20; ///< of the driver's textures, roughly

  /// The context of `gl` must be current here, in draw() and in the destructor.
  explicit TextureTiles(const Gl& gl) : gl_(gl) {}
  ~TextureTiles();
  TextureTiles(const TextureTiles&) = delete;
  TextureTiles& operator=(const TextureTiles&) = delete;

  /// From now on. Tiles of what was shown before stay on the screen until there are others.
  void show(std::shared_ptr<const TextureGrid> grid, const TextureDisplay& display);
  /// Frees everything; a tile in work is given up.
  void clear();
  /// Draws what is there of the part within [clip_lo, clip_hi], and posts work for what is missing.
  void draw(ImDrawList& list, const GridRect& rect, vec2 clip_lo, vec2 clip_hi, TaskThread& worker);

  const std::shared_ptr<const TextureGrid>& grid() const { return grid_; }
  /// The last draw() had all that it needed.
  bool complete() const { return complete_; }
  std::size_t memory_bytes() const;
  /// Tiles made so far.
  std::size_t made() const { return made_; }

private:
  struct Key {
    int reduction = 0; ///< each pixel stands for 2^reduction values along x and y
    int x = 0, y = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Tile {
    GLuint texture = 0;
    ivec2 size{0};
    std::uint64_t used = 0; ///< frame in which it was drawn last
  };
  struct Look { ///< all that the pixels depend on
    std::shared_ptr<const TextureGrid> grid;
    TextureDisplay display;
    std::map<Key, Tile> tiles;
    std::uint64_t number = 0;
  };
  struct Made {
    Key key;
    ivec2 size;
    std::vector<std::uint8_t> pixels;
  };

  static ivec2 tile_size(const TextureGrid& grid, const Key& key);
  int coarsest() const;
  std::vector<Key> visible(const GridRect& rect, vec2 clip_lo, vec2 clip_hi, int reduction) const;
  void draw_tiles(ImDrawList& list, Look& look, const GridRect& rect, vec2 clip_lo, vec2 clip_hi,
                  int least_reduction);
  void post(std::vector<Key> wanted, TaskThread& worker);
  void install(Look& look, const std::vector<Made>& made);
  void release(Look& look);
  void evict();

  const Gl& gl_;
  std::shared_ptr<const TextureGrid> grid_;
  Look now_, before_; ///< before_: shown until now_ is complete
  bool complete_ = false, in_work_ = false;
  std::uint64_t frame_ = 0;
  std::size_t made_ = 0;
  std::shared_ptr<std::atomic<std::uint64_t>> newest_ = std::make_shared<std::atomic<std::uint64_t>>(0);
  std::shared_ptr<Progress> work_ = std::make_shared<Progress>();
};

} // namespace candela
