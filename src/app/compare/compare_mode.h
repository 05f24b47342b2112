#pragma once
// Two Documents rendered at once, and measures of their difference. The Viewer holds the edited one and this
// class the other; they swap when the user edits the other one. All numbers are computed on a thread of their
// own.

#include "app/compare/compare_analysis.h"
#include "app/platform/task_thread.h"
#include "app/tools/edit_history.h"
#include "scene/document.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <tuple>

namespace candela {

class CompareMode {
public:
  struct Options {
    int threads = 0;
    std::function<void()> wake;
    std::filesystem::path folder; ///< of exported figures
  };
  /// The Viewer's members that are swapped when the other variant is edited.
  struct Edited {
    Document& document;
    std::unique_ptr<RenderSession>& session;
    EditHistory& history;
  };

  explicit CompareMode(Options options);

  /// The edited Document becomes A; B begins as its copy.
  void begin(CompareState& state, const Edited& edited, EditState now);
  /// Ends the comparison; the edited variant stays.
  void end(CompareState& state, const Edited& edited);
  /// From now on the panels edit the other variant.
  void exchange(CompareState& state, const Edited& edited);
  /// The other variant becomes a copy of this document.
  void replace_other(const Document& document);
  const Document& other_document() const { return other_.document; }
  const RenderSession* other_session() const { return other_.session.get(); }

  /// Copies the values that both share (film size, display, stopping criteria, perhaps the camera) to the
  /// other variant.
  void follow(const CompareState& state, const Document& edited);
  void pause(bool paused);
  void step();
  void set_region(const CropWindow& region);

  /// Called once a frame: takes finished results and requests new ones. Returns a message for the user, or an
  /// empty text.
  std::string update(CompareState& state, const Edited& edited);
  bool wants_redraw() const;
  bool busy() const;

  // The reference. It is dropped as soon as another view or film size is rendered.
  void freeze_reference(const CompareState& state, const Edited& edited, int variant);
  void render_reference(const CompareState& state, const Edited& edited);
  void load_reference(const std::string& path);
  void clear_reference();

  /// Null while there is none.
  std::shared_ptr<const Image> reference_image() const { return reference_ ? reference_->image : nullptr; }

  /// Newest false-colour difference; null before the first.
  const std::shared_ptr<const DisplayImage>& difference() const { return difference_; }
  /// Writes a figure of both pictures, their difference and the plot, under a new name, on `writer`.
  void export_figure(const CompareState& state, const Edited& edited, TaskThread& writer);

private:
  struct Reference {
    std::shared_ptr<const Image> image;
    std::string name;
    std::optional<Camera> camera; ///< of the rendered view; none if unknown, as for a file
  };
  struct Measured {
    std::uint64_t generation = 0; ///< of the frame that the numbers belong to
    std::optional<double> rel_mse, noise;
  };
  struct Other {
    Document document;
    std::unique_ptr<RenderSession> session;
    EditHistory history;
  };

  const RenderSession& session(const CompareState& state, const Edited& edited, int variant) const {
    return variant == state.edited ? *edited.session : *other_.session;
  }
  const Document& document(const CompareState& state, const Edited& edited, int variant) const {
    return variant == state.edited ? edited.document : other_.document;
  }
  void dispose(std::unique_ptr<RenderSession> session);
  /// Why the reference does not fit the rendered pictures; empty if it does.
  std::string reference_problem(const Document& document) const;
  void watch_reference(CompareState& state, const Edited& edited);
  void analyse(const CompareState& state, const Edited& edited);
  void take(const CompareAnalysis& analysis);
  void describe(CompareState& state, const Edited& edited) const;

  Options options_;
  std::shared_ptr<RenderTurns> turns_;
  Other other_;
  std::unique_ptr<RenderSession> reference_session_; ///< while the reference is rendered
  Reference rendering_;                              ///< the reference that it will give
  std::optional<Reference> reference_;
  bool paused_ = false;
  std::array<ErrorTrack, 2> rel_mse_tracks_, noise_tracks_;
  std::array<Measured, 2> measured_; ///< newest
  std::shared_ptr<const DisplayImage> difference_;
  std::array<std::shared_ptr<const Frame>, 2> analysed_; ///< frames of the last analysis
  int analyses_ = 0;                                     ///< running
  /// The other inputs of the last analysis: a change requests another one.
  using Key = std::tuple<CompareLayout, DifferenceOf, bool, float, std::shared_ptr<const Image>>;
  Key key_of(const CompareState& state) const {
    return {state.layout, state.difference, state.with_sign, state.range,
            state.has_reference ? reference_->image : nullptr};
  }
  Key key_;
  double next_analysis_ = 0;
  std::string message_;

  TaskThread analyst_; // last, because its completions use the members above
};

/// The contents of a comparison's figure, as on the screen. Pictures may be null.
struct ComparisonFigure {
  std::array<std::shared_ptr<const DisplayImage>, 2> pictures;
  std::shared_ptr<const Image> reference;
  std::array<std::string, 2> labels;
  DifferenceOf difference = DifferenceOf::a_and_b;
  bool with_sign = false;
  float range = 0.1f;
  Plot plot; ///< left out if it has no points
};

/// Draws the figure and writes it to a new file in the folder. Returns its path.
std::string write_comparison_figure(const ComparisonFigure& source, const std::string& folder);

} // namespace candela
