// The Viewer during a comparison.

#include "app/viewer/viewer.h"

#include <fmt/format.h>
#include <imgui.h>

namespace candela {

namespace {

constexpr float kDividerReach = 8; // pixels at scale 1 within which the divider can be dragged
constexpr double kFlipHold = 0.25; // a key held longer shows the other variant only while it is held
constexpr int kRight = 1;          // of ImGui's buttons

} // namespace

ComparePanes Viewer::compare_panes() const {
  const ivec2 film = state_.picture ? ivec2(state_.picture->width, state_.picture->height)
                                    : glm::max(framebuffer_, ivec2(1));
  return candela::compare_panes(state_.compare, free_region(), single_picture_rect(),
                                view_shape(film, state_.document.scene.camera.film_aspect()));
}

void Viewer::update_compare() {
  CompareState& compare = state_.compare;
  const CompareMode::Edited edited{state_.document, session_, history_};
  if (std::string message = compare_.update(compare, edited); !message.empty()) notify(std::move(message));
  if (!compare.active) return;
  if (const RenderSession* other = compare_.other_session()) other_viewport_.show(other->display());
  difference_viewport_.show(compare_.difference());

  // Key B flips when it is pressed, and back on release if it was held.
  const bool down = !typing_ && single_keys_act(Key::b) && ImGui::GetIO().KeysDown[static_cast<int>(Key::b)];
  if (down && !flip_down_) compare.flipped = !compare.flipped, flip_since_ = now_;
  if (!down && flip_down_ && now_ - flip_since_ > kFlipHold) compare.flipped = !compare.flipped;
  flip_down_ = down;
}

void Viewer::serve_compare_requests() {
  if (gesture_ != Gesture::none) return; // a gesture ends in the variant in which it began
  CompareState& compare = state_.compare;
  const CompareMode::Edited edited{state_.document, session_, history_};
  if (compare.active && compared_scene_ != scene_)
    compare.toggle_requested = true; // another scene was opened
  if (compare.toggle_requested) {
    if (compare.active) {
      compare_.end(compare, edited);
      notify(fmt::format("Continuing with {} alone", variant_letter(compare.edited)));
    } else {
      compare_.begin(compare, edited, edit_state());
      compare_.set_region(sent_region_);
      compared_scene_ = scene_;
      exchange_sides();
      notify("The panels change B now; A keeps its settings");
    }
  }
  if (compare.active) {
    if (compare.copy_requested == compare.edited) compare_.replace_other(state_.document);
    if (compare.copy_requested == 1 - compare.edited) {
      state_.document = compare_.other_document();
      state_.edited = true;
    }
    if (compare.edit_requested == 1 - compare.edited) exchange_sides();
    const CompareMode::Edited now{state_.document, session_, history_};
    if (compare.freeze_requested) compare_.freeze_reference(compare, now, *compare.freeze_requested);
    if (compare.render_reference_requested) compare_.render_reference(compare, now);
    if (compare.load_reference_requested) compare_.load_reference(compare.reference_path);
    if (compare.clear_reference_requested) compare_.clear_reference();
    if (compare.export_requested) compare_.export_figure(compare, now, writer_);
    compare_.pause(state_.paused);
  }
  compare.toggle_requested = compare.render_reference_requested = compare.load_reference_requested =
      compare.clear_reference_requested = compare.export_requested = false;
  compare.copy_requested.reset();
  compare.edit_requested.reset();
  compare.freeze_requested.reset();
}

/// Submits pending edits to the variant that they belong to.
void Viewer::exchange_sides() {
  submit();
  compare_.exchange(state_.compare, {state_.document, session_, history_});
  viewport_.show(session_->display()); // in this frame already
  other_viewport_.show(compare_.other_session()->display());
  state_.picture = viewport_.shown();
  state_.status = session_->status();
  scene_generation_ = 0; // both variants show this scene, with generations of their own
}

/// Whether the mouse is dragging the divider or the zoomed pictures.
bool Viewer::use_mouse_on_comparison() {
  CompareState& compare = state_.compare;
  if (!compare.active) return false;
  const ImGuiIO& io = ImGui::GetIO();
  const PixelRect region = free_region();
  if (compare.zoom > 0 && io.MouseDown[kRight] && !io.WantCaptureMouse)
    compare.pan -= vec2(io.MouseDelta.x, io.MouseDelta.y) / static_cast<float>(compare.zoom);
  const int divider = compare_panes().divider;
  if (divider < 0) return divider_held_ = false;
  const bool near = std::abs(io.MousePos.x - static_cast<float>(divider)) <= kDividerReach * state_.scale &&
                    !io.WantCaptureMouse && gesture_ == Gesture::none;
  if (near || divider_held_) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (near && io.MouseClicked[0]) divider_held_ = true;
  if (!divider_held_) return false;
  if (region.width > 0)
    compare.divider = std::clamp(
        (io.MousePos.x - static_cast<float>(region.x)) / static_cast<float>(region.width), 0.0f, 1.0f);
  divider_held_ = io.MouseDown[0];
  return true;
}

void Viewer::draw_comparison() {
  const ComparePanes panes = compare_panes();
  for (int i = 0; i < 2; ++i) {
    const ComparePanes::Pane& pane = panes.variants[static_cast<std::size_t>(i)];
    if (!pane.shown || pane.clip.width <= 0 || pane.clip.height <= 0) continue;
    scissor(pane.clip);
    Viewport& viewport = panes.difference             ? difference_viewport_
                         : i == state_.compare.edited ? viewport_
                                                      : other_viewport_;
    if (!panes.difference || compare_.difference()) viewport.draw(pane.picture, framebuffer_);
  }
}

bool Viewer::comparison_wants_redraw() const {
  const RenderSession* other = compare_.other_session();
  return compare_.wants_redraw() || (other != nullptr && other->display() != other_viewport_.shown());
}

} // namespace candela
