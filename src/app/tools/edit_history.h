#pragma once
// Undo and redo: Documents are cheap to copy, so every step keeps a whole one.

#include "core/bounds.h"
#include "io/files/file_stamp.h"
#include "scene/document.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// The scene that is open: what stays the same while it is edited.
struct OpenScene {
  std::string path; ///< empty: the built-in scene
  Document home;    ///< as it was loaded
  Document saved;   ///< as its file has it
  Bounds3 bounds;   ///< world space
  std::vector<std::string> warnings;
  FileStamps files; ///< LoadedScene::files
};

/// One step of the history: all that an undo brings back.
struct EditState {
  Document document;
  bool fit_film = true; ///< the film's size is the window's, not the user's
  std::shared_ptr<OpenScene> scene;
};

/// What an edit did, in a few words for a tooltip: "path.max_depth", "Material red: roughness", "Camera".
std::string edit_name(const EditState& before, const EditState& after);

/// Whether two documents differ in something that a file should keep: the camera's pose
/// is not (looking around is no edit), nor is the film's size while it follows the window.
bool differs_from_file(const Document& document, const Document& saved, bool fit_film);

class EditHistory {
public:
  /// Clears the history; `now` is where undo ends.
  void reset(EditState now);

  /// Records the present state, once a frame. An edit becomes a step when no gesture (a drag, a flight) is
  /// under way any more; a gesture that ends where it began makes none. A new step drops what could be
  /// redone.
  void observe(const EditState& now, bool edited, bool in_gesture);
  /// Whether an edit waits for its gesture's end.
  bool pending() const { return pending_; }

  bool can_undo() const { return cursor_ > 0; }
  bool can_redo() const { return cursor_ + 1 < entries_.size(); }
  /// The state before (after) the present step. Only where there is one.
  const EditState& undo() { return entries_[--cursor_].state; }
  const EditState& redo() { return entries_[++cursor_].state; }
  /// The nearest step whose scene has these instances: how many undos away it is, or, if there is none
  /// before, minus how many redos.
  std::optional<int> undos_to(const std::vector<Instance>& instances) const;
  /// So many undos at once, as undos_to() counts them.
  const EditState& undo_by(int undos) {
    cursor_ = static_cast<std::size_t>(static_cast<int>(cursor_) - undos);
    return entries_[cursor_].state;
  }
  /// What undo() would take back and redo() would do again; empty if nothing.
  std::string undo_name() const { return can_undo() ? entries_[cursor_].name : ""; }
  std::string redo_name() const { return can_redo() ? entries_[cursor_ + 1].name : ""; }

private:
  struct Entry {
    EditState state;
    std::string name; ///< of the step that led here
    std::size_t bytes = 0;
  };
  void trim();

  std::deque<Entry> entries_;
  std::size_t cursor_ = 0; ///< the present one
  bool pending_ = false;
};

} // namespace candela
