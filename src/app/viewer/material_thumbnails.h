#pragma once
// Thumbnails of materials: made on a thread of low priority, one at a time, of those that are on the screen.

#include "app/panels/viewer_state.h"
#include "app/platform/gl.h"
#include "app/platform/task_thread.h"
#include "session/material_preview.h"

#include <atomic>
#include <list>

namespace candela {

struct ThumbnailOptions {
  int first_spp = 4, spp = 64; ///< all get the first, then all the rest
  std::size_t most = 128;      ///< are kept
  int niceness = 19; ///< the lowest priority: next to a render, some 12 % of a core; 0: that of the window
  std::filesystem::path studio; ///< the scene that they are made in; empty: the program's own
};

/// Only the UI thread uses the members of the class. The task thread gets its values by copy (samples and the
/// studio are immutable once shared), gives results back as completions, and shares no more than the atomic
/// flag that ends its render.
class MaterialThumbnails {
public:
  /// The context of `gl` must be current here, in both halves of a frame and in the destructor. The task
  /// thread reads the studio before the first picture.
  MaterialThumbnails(const Gl& gl, ThumbnailOptions options, std::function<void()> wake);
  ~MaterialThumbnails();
  MaterialThumbnails(const MaterialThumbnails&) = delete;
  MaterialThumbnails& operator=(const MaterialThumbnails&) = delete;

  /// Before the panels: takes what is done, and gives the panels the pictures.
  void begin_frame(ViewerState& state);
  /// After the panels: begins the next picture that was drawn and is missing, unless the user waits for the
  /// main picture (`may_begin` false); gives up one that is no longer wanted.
  void end_frame(ViewerState& state, bool may_begin);

  /// Whether begin_frame() would have something new, and whether end_frame() has left something to begin.
  bool has_news() const { return worker_.has_completions(); }
  bool waits() const { return waits_; }

  // For tests.
  /// Pixels of a material's picture of all samples; null until there is one of its current value.
  std::shared_ptr<const std::vector<std::uint8_t>> finished(const SceneDesc& scene,
                                                            std::size_t material) const;
  std::size_t begun() const { return begun_; } ///< renders
  /// Why its picture cannot be made; empty where it can, or has not been tried.
  std::string problem(const SceneDesc& scene, std::size_t material) const;
  std::size_t kept() const { return entries_.size(); }
  bool running() const { return worker_.pending() > 0; }

private:
  struct Entry {
    MaterialSample sample;
    int side = 0, spp = 0; ///< 0 samples: it cannot be made
    std::shared_ptr<const std::vector<std::uint8_t>> pixels;
    std::string problem; ///< why it cannot be made
    GLuint texture = 0;
    std::uint64_t used = 0; ///< frame in which it was drawn last
  };
  struct Wanted {
    std::size_t material;
    MaterialSample sample;
    int spp;
  };

  Entry* find(const MaterialSample& sample, int side);
  void begin(const MaterialSample& sample, int side, int spp);
  void finish(const MaterialSample& sample, int side, int spp,
              std::shared_ptr<const std::vector<std::uint8_t>> pixels, std::string problem);
  void upload(Entry& entry);
  void evict();

  const Gl& gl_;
  ThumbnailOptions options_;
  std::shared_ptr<const Document> studio_;   ///< null before the first picture
  std::shared_ptr<const RenderScene> scene_; ///< of the newest picture; null while none is on the screen
  std::list<Entry> entries_;                 ///< pointers to them stay valid
  std::vector<Entry*> shown_;                ///< of the materials by index: kept while a new one is made
  std::string shown_scene_;                  ///< whose materials these are
  std::uint64_t frame_ = 0;
  bool waits_ = false;
  std::size_t begun_ = 0;
  MaterialSample in_work_;
  std::shared_ptr<std::atomic<bool>> stop_; ///< of the render in work; null: none
  TaskThread worker_;                       ///< last, so that it is destroyed first
};

} // namespace candela
