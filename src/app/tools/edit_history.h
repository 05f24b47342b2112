#pragma once
// Undo and redo: Documents are cheap to copy, so every step keeps a complete one.

#include "core/bounds.h"
#include "io/files/file_stamp.h"
#include "scene/document.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace candela {

/// The open scene: the values that edits do not change.
struct OpenScene {
  std::string path; ///< empty: the built-in scene
  Document home;    ///< as loaded
  Document saved;   ///< as in its file
  Bounds3 bounds;   ///< world space
  std::vector<std::string> warnings;
  FileStamps files; ///< LoadedScene::files
};

/// One step of the history: everything that undo restores.
struct EditState {
  Document document;
  bool fit_film = true; ///< the film has the window's size
  std::shared_ptr<OpenScene> scene;
};

/// A short description of an edit for a tooltip: "path.max_depth", "Material red: roughness", "Camera".
std::string edit_name(const EditState& before, const EditState& after);

/// Whether two documents differ in values that a file should keep. The camera's pose is not one of them
/// (looking around is not an edit), nor is the film's size while it follows the window.
bool differs_from_file(const Document& document, const Document& saved, bool fit_film);

class EditHistory {
public:
  /// Clears the history; `now` is the oldest state that undo can restore.
  void reset(EditState now);

  /// Records the current state; called once a frame. An edit becomes a step when no gesture (a drag, a
  /// flight) is active; a gesture without a net change makes none. A new step drops the steps that could be
  /// redone.
  void observe(const EditState& now, bool edited, bool in_gesture);
  /// Whether an edit waits for the end of its gesture.
  bool pending() const { return pending_; }

  bool can_undo() const { return cursor_ > 0; }
  bool can_redo() const { return cursor_ + 1 < entries_.size(); }
  /// The state before (after) the current step, which must exist.
  const EditState& undo() { return entries_[--cursor_].state; }
  const EditState& redo() { return entries_[++cursor_].state; }
  /// The distance to the nearest step whose scene has these instances: the number of undos, or, if there is
  /// no earlier one, minus the number of redos.
  std::optional<int> undos_to(const std::vector<Instance>& instances) const;
  /// That many undos at once, as counted by undos_to().
  const EditState& undo_by(int undos) {
    cursor_ = static_cast<std::size_t>(static_cast<int>(cursor_) - undos);
    return entries_[cursor_].state;
  }
  /// Names of the edits that undo() and redo() would apply; empty if there is none.
  std::string undo_name() const { return can_undo() ? entries_[cursor_].name : ""; }
  std::string redo_name() const { return can_redo() ? entries_[cursor_ + 1].name : ""; }

private:
  struct Entry {
    EditState state;
    std::string name; ///< name of the edit that led here
    std::size_t bytes = 0;
  };
  void trim();

  std::deque<Entry> entries_;
  std::size_t cursor_ = 0; ///< the current step
  bool pending_ = false;
};

} // namespace candela
