#include "app/compare/compare_mode.h"

#include "app/figures/reference_seed.h"
#include "core/error.h"
#include "io/images/image_file.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace candela {

namespace {

/// Limits of the analyses: the least time from one to the next, and their share of a core.
constexpr double kAnalysisInterval = 0.05, kAnalysisShare = 0.1;

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The newest accumulation's frame, if every pixel has a sample.
std::shared_ptr<const Frame> current_frame(const RenderSession& session) {
  const SessionStatus status = session.status(); // read first, so that the frame is at least as new
  if (status.submitted != status.generation || status.first_image_ms < 0) return nullptr;
  auto frame = session.latest();
  return frame && frame->spp > 0 ? frame : nullptr;
}

bool same_size(const Frame& a, const Frame& b) { return a.width == b.width && a.height == b.height; }

/// The values that both variants must share to be comparable, except the camera's.
void share(const CompareState& state, const Document& from, Document& to) {
  to.settings.film.width = from.settings.film.width;
  to.settings.film.height = from.settings.film.height;
  to.settings.display = from.settings.display;
  to.settings.stop = from.settings.stop;
  if (state.share_camera) to.scene.camera = from.scene.camera;
}

bool is_shared(std::string_view key) {
  return key == "film.width" || key == "film.height" || key.starts_with("display.") ||
         key.starts_with("stop.") || key.starts_with("camera.");
}

} // namespace

std::string distinct_settings(const Document& document, const Document& other, std::size_t most) {
  std::vector<std::string> all;
  for (const auto& row : settings_table())
    if (!is_shared(row.key) && field_text(row, document) != field_text(row, other))
      all.push_back(fmt::format("{}={}", row.key, field_text(row, document)));
  if (document.scene.materials != other.scene.materials) all.push_back("materials");
  if (document.scene.lights != other.scene.lights) all.push_back("lights");
  if (document.scene.instances != other.scene.instances) all.push_back("objects");
  const std::size_t shown = std::min(all.size(), most);
  std::string out =
      fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < all.size()) out += fmt::format(", {} more", all.size() - shown);
  return out;
}

CompareMode::CompareMode(Options options) : options_(std::move(options)), analyst_(options_.wake) {}

void CompareMode::begin(CompareState& state, const Edited& edited, EditState now) {
  turns_ = std::make_shared<RenderTurns>(std::vector<int>{0, 0, 1});
  edited.session->take_turns(turns_, 0);
  SessionOptions session;
  session.threads = options_.threads;
  session.on_publish = options_.wake;
  session.turns = turns_;
  session.variant = 1;
  session.geometry_of = edited.session->scene();
  other_ = {edited.document, std::make_unique<RenderSession>(std::move(session)), {}};
  other_.history.reset(std::move(now));
  other_.session->submit(other_.document);
  paused_ = false;
  rel_mse_tracks_ = noise_tracks_ = {};
  measured_ = {};
  analysed_ = {};
  difference_ = nullptr;
  state.active = true;
  state.edited = 0;
}

void CompareMode::end(CompareState& state, const Edited& edited) {
  clear_reference();
  dispose(std::move(other_.session));
  other_.document = Document();
  other_.history = EditHistory();
  edited.session->take_turns(nullptr, 0);
  turns_ = nullptr;
  difference_ = nullptr;
  analysed_ = {};
  state.active = false;
  state.plot = {};
}

/// Sessions are destroyed on another thread: one may still be building a large scene.
void CompareMode::dispose(std::unique_ptr<RenderSession> session) {
  if (!session) return;
  analyst_.post(
      [doomed = std::shared_ptr<RenderSession>(std::move(session))]() mutable -> TaskThread::Completion {
        doomed.reset();
        return [] {};
      });
}

void CompareMode::exchange(CompareState& state, const Edited& edited) {
  std::swap(edited.document, other_.document);
  std::swap(edited.session, other_.session);
  std::swap(edited.history, other_.history);
  state.edited = 1 - state.edited;
}

void CompareMode::replace_other(const Document& document) {
  other_.document = document;
  other_.session->submit(document);
}

void CompareMode::follow(const CompareState& state, const Document& edited) {
  Document shared = other_.document;
  share(state, edited, shared);
  if (shared.settings == other_.document.settings && shared.scene.camera == other_.document.scene.camera)
    return;
  other_.document = std::move(shared);
  other_.session->submit(other_.document);
}

void CompareMode::pause(bool paused) {
  if (other_.session && paused != paused_) other_.session->pause(paused);
  paused_ = paused;
}

void CompareMode::step() {
  if (other_.session) other_.session->step();
  paused_ = true;
}

void CompareMode::set_region(const CropWindow& region) {
  if (other_.session) other_.session->set_region(region);
}

bool CompareMode::wants_redraw() const { return analyst_.has_completions(); }

bool CompareMode::busy() const {
  if (!other_.session) return false;
  const SessionPhase phase = other_.session->status().phase;
  return phase == SessionPhase::building || phase == SessionPhase::rendering || analyses_ > 0 ||
         reference_session_ != nullptr;
}

std::string CompareMode::update(CompareState& state, const Edited& edited) {
  analyst_.run_completions();
  if (!state.active) return std::exchange(message_, {});
  turns_->set_fairness(state.equal_time ? RenderTurns::Fairness::time : RenderTurns::Fairness::samples);
  watch_reference(state, edited);
  analyse(state, edited);
  describe(state, edited);
  return std::exchange(message_, {});
}

// The reference.

void CompareMode::freeze_reference(const CompareState& state, const Edited& edited, int variant) {
  const auto frame = current_frame(session(state, edited, variant));
  if (!frame) {
    message_ = "There is no complete picture yet: wait for its first sample";
    return;
  }
  clear_reference();
  reference_ = {std::make_shared<Image>(Image{frame->width, frame->height, frame->linear}),
                fmt::format("{} at {} spp", variant_letter(variant), frame->spp),
                document(state, edited, variant).scene.camera};
}

void CompareMode::render_reference(const CompareState& state, const Edited& edited) {
  clear_reference();
  Document document = this->document(state, edited, 0);
  document.settings.sampler.seed ^= kReferenceSeed;
  document.settings.stop = {};
  document.settings.stop.spp = state.reference_spp;
  document.settings.adaptive.error = 0;
  rendering_ = {nullptr, fmt::format("A's settings, {} spp", state.reference_spp), document.scene.camera};
  SessionOptions options;
  options.threads = options_.threads;
  options.on_publish = options_.wake;
  options.turns = turns_;
  options.variant = 2;
  options.geometry_of = session(state, edited, 0).scene();
  reference_session_ = std::make_unique<RenderSession>(std::move(options));
  reference_session_->submit(std::move(document));
}

void CompareMode::load_reference(const std::string& path) {
  analyst_.post([this, path]() -> TaskThread::Completion {
    try {
      auto image = std::make_shared<const Image>(read_image(path));
      return [this, path, image] {
        if (!other_.session) return; // the comparison has ended
        clear_reference();
        reference_ = {image, std::filesystem::path(path).filename().string(), std::nullopt};
      };
    } catch (const std::bad_alloc&) {
      return [this, path] { message_ = fmt::format("{}: there is not enough memory for it", path); };
    } catch (const std::exception& error) { // an Error, or what a library throws: shown either way
      return [this, problem = std::string(error.what())] { message_ = problem; };
    }
  });
}

void CompareMode::clear_reference() {
  dispose(std::move(reference_session_));
  reference_.reset();
  rel_mse_tracks_ = {};
  for (Measured& measured : measured_) measured.rel_mse.reset();
}

std::string CompareMode::reference_problem(const Document& document) const {
  const FilmSettings& film = document.settings.film;
  const Image& image = *reference_->image;
  if (image.width != film.width || image.height != film.height)
    return fmt::format("it has {} x {} pixels, the film {} x {}", image.width, image.height, film.width,
                       film.height);
  if (reference_->camera && *reference_->camera != document.scene.camera) return "it shows another view";
  return {};
}

void CompareMode::watch_reference(CompareState& state, const Edited& edited) {
  state.rendering_reference = reference_session_ != nullptr;
  state.has_reference = false;
  const Document& a = document(state, edited, 0);
  if (reference_session_) {
    const SessionStatus status = reference_session_->status();
    state.reference = fmt::format("rendering, {} of {} spp", status.spp, state.reference_spp);
    if (status.phase == SessionPhase::failed) {
      message_ = status.error;
      dispose(std::move(reference_session_));
    } else if (rendering_.camera != a.scene.camera) {
      message_ = "The reference was dropped: the view has changed";
      dispose(std::move(reference_session_));
    } else if (status.phase == SessionPhase::finished) {
      const auto frame = reference_session_->latest();
      rendering_.image = std::make_shared<Image>(Image{frame->width, frame->height, frame->linear});
      dispose(std::move(reference_session_));
      reference_ = std::move(rendering_);
      rel_mse_tracks_ = {};
    }
    return;
  }
  if (!reference_) {
    state.reference = "none";
    return;
  }
  const std::string problem = reference_problem(a);
  state.has_reference = problem.empty();
  state.reference = problem.empty() ? reference_->name : fmt::format("{}: {}", reference_->name, problem);
  if (!problem.empty())
    for (Measured& measured : measured_) measured.rel_mse.reset();
}

// The numbers.

void CompareMode::analyse(const CompareState& state, const Edited& edited) {
  if (analyses_ > 0 || now_seconds() < next_analysis_) return;
  auto analysis = std::make_shared<CompareAnalysis>();
  for (int i = 0; i < 2; ++i)
    analysis->frames[static_cast<std::size_t>(i)] = current_frame(session(state, edited, i));
  if (state.has_reference) analysis->reference = reference_->image;
  auto fits = [&](const std::shared_ptr<const Frame>& frame) {
    return !analysis->reference ||
           (frame->width == analysis->reference->width && frame->height == analysis->reference->height);
  };
  for (auto& frame : analysis->frames)
    if (frame && !fits(frame)) frame = nullptr; // of the film's size before
  const auto& [a, b] = analysis->frames;
  const bool shows = state.layout == CompareLayout::difference;
  if (shows && state.difference == DifferenceOf::a_and_b && a && b && same_size(*a, *b))
    analysis->difference = {0, 1};
  if (shows && state.difference == DifferenceOf::a_and_reference && a && analysis->reference)
    analysis->difference = {0, 2};
  if (shows && state.difference == DifferenceOf::b_and_reference && b && analysis->reference)
    analysis->difference = {1, 2};
  analysis->with_sign = state.with_sign;
  analysis->range = state.range;
  const bool is_new = analysis->frames != analysed_ || key_ != key_of(state);
  if (!is_new) return;
  analysed_ = analysis->frames;
  key_ = key_of(state);
  ++analyses_;
  analyst_.post([this, analysis]() -> TaskThread::Completion {
    analysis->run();
    return [this, analysis] { take(*analysis); };
  });
}

void CompareMode::take(const CompareAnalysis& analysis) {
  --analyses_;
  next_analysis_ = now_seconds() + std::max(kAnalysisInterval, analysis.seconds / kAnalysisShare);
  if (!other_.session) return; // the comparison has ended
  if (analysis.picture) difference_ = analysis.picture;
  const bool same_reference = reference_ && analysis.reference == reference_->image;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!analysis.frames[i]) continue;
    const Frame& frame = *analysis.frames[i];
    measured_[i] = {frame.generation, same_reference ? analysis.rel_mse[i] : std::nullopt, analysis.noise[i]};
    if (measured_[i].rel_mse) rel_mse_tracks_[i].add(frame, *measured_[i].rel_mse);
    if (measured_[i].noise) noise_tracks_[i].add(frame, *measured_[i].noise);
  }
}

void CompareMode::describe(CompareState& state, const Edited& edited) const {
  for (int i = 0; i < 2; ++i) {
    CompareVariant& variant = state.variants[static_cast<std::size_t>(i)];
    variant.status = session(state, edited, i).status();
    variant.label = distinct_settings(document(state, edited, i), document(state, edited, 1 - i), 3);
    const Measured& measured = measured_[static_cast<std::size_t>(i)];
    // Of the newest accumulation: edits that restart nothing, such as the exposure, do not start another.
    const bool is_current = measured.generation >= variant.status.restarting;
    variant.rel_mse = is_current && state.has_reference ? measured.rel_mse : std::nullopt;
    variant.noise = is_current ? measured.noise : std::nullopt;
  }
  state.plot = error_plot(state.has_reference ? rel_mse_tracks_ : noise_tracks_, state.over_seconds,
                          state.has_reference ? "relMSE" : kNoiseName);
}

void CompareMode::export_figure(const CompareState& state, const Edited& edited, TaskThread& writer) {
  ComparisonFigure source;
  for (int i = 0; i < 2; ++i) {
    const auto index = static_cast<std::size_t>(i);
    source.pictures[index] = session(state, edited, i).display();
    source.labels[index] = state.variants[index].label;
  }
  if (state.has_reference) source.reference = reference_->image;
  source.difference = state.difference;
  source.with_sign = state.with_sign;
  source.range = state.range;
  source.plot = state.plot;
  writer.post(
      [this, source = std::move(source), folder = options_.folder.string()]() -> TaskThread::Completion {
        try {
          return [this, path = write_comparison_figure(source, folder)] {
            message_ = fmt::format("Saved {}", std::filesystem::path(path).lexically_normal().string());
          };
        } catch (const std::exception& error) { // shown
          return [this, problem = std::string(error.what())] { message_ = problem; };
        }
      });
}

} // namespace candela
