// Frame pacing: soon after input, seldom while a picture only gets less noisy; and its statistics.

#include "app/viewer/viewer.h"

#include <imgui.h>

namespace candela {

namespace {

// Without a GPU, drawing competes with the renderer: 30 frames a second look smooth, and input gets up to 60.
constexpr double kPictureInterval = 1 / 30.0;
constexpr double kInputInterval = 1 / 60.0;
constexpr double kHandInterval = 1 / 240.0;
/// The least time between pictures of inputs: it leaves the renderer time for the next one. With
/// kInputInterval, pictures of a flight took 25 ms, of which 6 ms were waiting.
constexpr double kAwaitedInterval = 1 / 100.0;
/// While a picture is awaited, drawing the old one again would delay it.
constexpr double kWaitingInterval = 1 / 15.0;
/// Largest share of the wall time for drawing pictures that only become less noisy.
constexpr double kWindowShare = 0.06;
constexpr double kSlowestRefining = 0.2;
constexpr double kBusyRedrawSeconds = 0.25; // for changing numbers and blinking text cursors
constexpr double kIdleRedrawSeconds = 5;

bool is_busy(SessionPhase phase) {
  return phase == SessionPhase::building || phase == SessionPhase::rendering;
}

} // namespace

/// An input's picture is due soon, and drawing would take cores from it.
bool Viewer::puts_off_drawing(bool restarted) {
  if (!owes_drawing_) owed_since_ = now_;
  return (restarted || owes_drawing_) && now_ < owed_since_ + kWaitingInterval;
}

void Viewer::shown(WindowFrame frame) {
  frame.rendering = state_.status.phase == SessionPhase::rendering;
  meter_.add(frame);
  frame_seconds_ += 0.2 * (frame.seconds - frame_seconds_);
  session_->publish_every(refining_interval());
  read_meter();
  if (state_.compare.active || state_.status.phase == SessionPhase::failed)
    meter_.give_up();
  else if (state_.picture)
    meter_.shown(*state_.picture->frame, MeterClock::now());
}

bool Viewer::wants_redraw() const {
  return !events_.empty() || redraws_ > 0 || owes_drawing_ || fly_command().any() ||
         reader_.has_completions() || writer_.has_completions() || watch_.has_change() ||
         inspector_.wants_redraw() || lab_.has_news() || texture_viewer_.has_news() ||
         thumbnails_.has_news() || session_->display() != viewport_.shown() ||
         session_->status().phase != drawn_phase_ || comparison_wants_redraw();
}

/// Updated seldom: sorting takes time, and flickering numbers cannot be read.
void Viewer::read_meter() {
  constexpr double kEvery = 1;
  const double seconds = now_ - meter_read_;
  if (seconds < kEvery) return;
  meter_read_ = now_;
  const double cpu = session_->cpu_time().render, spent = cpu - std::exchange(meter_cpu_, cpu);
  const double share = state_.meter.render_share;
  state_.meter = meter_.readings();
  const bool refines = state_.status.phase == SessionPhase::rendering && seconds < 2 * kEvery;
  state_.meter.render_share = refines ? spent / (seconds * session_->threads()) : share;
}

/// For the first picture after an edit, or for that of a gesture.
bool Viewer::user_waits() const {
  return state_.edited || meter_.waiting() || gesture_ != Gesture::none || fly_command().any() ||
         state_.status.phase == SessionPhase::building || !state_.picture;
}

bool Viewer::awaited_picture_is_there() const {
  if (!meter_.waiting()) return false;
  const auto newest = session_->display();
  return newest && newest->frame->generation >= meter_.awaited();
}

double Viewer::next_frame() const {
  if (!wants_redraw()) return now_ + idle_seconds();
  double due = now_ + refining_interval();
  if (awaited_picture_is_there()) due = drawn_at_ + kAwaitedInterval; // may be in the past
  if (has_pending_events() || fly_command().any()) {
    // While the user moves the camera, a frame without a new picture only submits the edit, at little cost.
    const bool only_hands_in = gesture_ != Gesture::none && !awaited_picture_is_there();
    due = std::min(due, now_ + (only_hands_in ? kHandInterval : kInputInterval));
  }
  const bool coarse = state_.picture && state_.picture->frame->spp < 1;
  if (owes_drawing_)
    due = std::min(due, owed_since_ + kWaitingInterval);
  else if (coarse || redraws_ > 0 || meter_.waiting() || texture_viewer_.has_news())
    due = std::min(due, drawn_at_ + (meter_.waiting() ? kWaitingInterval : kPictureInterval));
  return due;
}

double Viewer::refining_interval() const {
  return std::clamp(frame_seconds_ / kWindowShare, kPictureInterval, kSlowestRefining);
}

double Viewer::idle_seconds() const {
  if (fly_command().any()) return 0;
  if (typing_ && std::ranges::any_of(ImGui::GetIO().KeysDown, std::identity())) return 0; // keys repeat
  if (is_busy(drawn_phase_) || compare_.busy() || typing_ || state_.loading > 0 || history_.pending() ||
      thumbnails_.waits())
    return kBusyRedrawSeconds;
  double idle = kIdleRedrawSeconds;
  if (state_.inspect.focus_mark)
    idle = std::min(idle, std::max(state_.inspect.focus_mark->until - now_, 0.0) + 0.01);
  if (!state_.notice.empty()) idle = std::min(idle, std::max(notice_until_ - now_, 0.0) + 0.01);
  const double hint_end = first_frame_ + kHintSeconds;
  if (now_ < hint_end) idle = std::min(idle, hint_end - now_ + 0.01);
  return idle;
}

} // namespace candela
