// Statistics, the status line, and the column that holds the panels.

#include "app/panels/panel_list.h"
#include "app/panels/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

/// Four digits and a prefix, of constant length: "1.234 M".
std::string si(double value) {
  constexpr std::string_view kPrefixes[] = {"", " k", " M", " G", " T"};
  std::size_t prefix = 0;
  while (value >= 999.95 && prefix + 1 < std::size(kPrefixes)) value /= 1000, ++prefix;
  const int digits = prefix == 0 ? 0 : value < 10 ? 3 : value < 100 ? 2 : 1;
  return fmt::format("{:.{}f}{}", value, digits, kPrefixes[prefix]);
}

std::string seconds_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(seconds);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds : 0;
}

const char* phase_text(const ViewerState& state) {
  switch (state.status.phase) {
  case SessionPhase::idle: return "idle";
  case SessionPhase::building: return "building";
  case SessionPhase::rendering: return state.status.first_image_ms < 0 ? "restarting" : "rendering";
  case SessionPhase::paused: return "paused";
  case SessionPhase::finished: return "finished";
  case SessionPhase::failed: return "failed";
  }
  return "";
}

ImVec4 phase_color(SessionPhase phase) {
  if (phase == SessionPhase::failed) return {0.90f, 0.36f, 0.30f, 1};
  if (phase == SessionPhase::finished || phase == SessionPhase::idle) return {0.55f, 0.55f, 0.55f, 1};
  return {0.85f, 0.62f, 0.30f, 1};
}

/// "12 of 64", if a number of samples is the stopping criterion.
std::string spp_text(const ViewerState& state) {
  const int target = state.document.settings.stop.spp;
  return target > 0 ? fmt::format("{} of {}", state.status.spp, target) : fmt::format("{}", state.status.spp);
}

constexpr float kFirstCell = 26; // right of the dot, at scale 1

constexpr ImGuiWindowFlags kPlainWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus |
                                          ImGuiWindowFlags_NoBackground; // Viewer::draw_window()

} // namespace

void statistics_panel(Ui& ui, ViewerState& state) {
  if (!ui.section("panel.statistics", "Statistics", true)) return;
  const SessionStatus& status = state.status;
  const std::string progress = fmt::format("{:.0f} %", 100 * status.progress);
  ImGui::ProgressBar(static_cast<float>(std::clamp(status.progress, 0.0, 1.0)),
                     ImVec2(-1, ImGui::GetTextLineHeight() + 2 * ui.scale()), progress.c_str());
  ui.record("statistics.progress");
  ui.tooltip("Towards the first stopping criterion that is met (Render, When to stop)");
  ui.readout("samples a pixel", spp_text(state));
  ui.readout("render time", seconds_text(status.render_seconds), "Of this accumulation, without waiting");
  ui.readout("samples/s", si(per_second(status.rays.samples, status.render_seconds)),
             "Camera paths a second");
  ui.readout("rays/s", si(per_second(status.rays.closest + status.rays.shadow, status.render_seconds)),
             "Closest-hit and shadow rays a second");
  ui.readout("edit to image",
             status.first_image_ms < 0 ? "…" : fmt::format("{:.1f} ms", status.first_image_ms),
             "From the last edit that restarted the image to its first picture");
  const MeterReadings& meter = state.meter;
  auto ms = [](double value) { return value > 0 ? fmt::format("{:.1f} ms", value) : std::string("…"); };
  ui.readout("input latency", ms(meter.first_ms),
             "From an input to its first picture on the screen; the median of the last 32");
  ui.readout("full-picture latency", ms(meter.full_ms), "The same, to one sample in every pixel");
  ui.readout("frame", fmt::format("{}, 99 %: {}", ms(meter.frame_ms), ms(meter.frame_p99_ms)),
             "Time of a window frame until it is on the screen: median and 99th percentile of the last 256");
  ui.readout("cores rendering",
             meter.render_share > 0 ? fmt::format("{:.0f} %", 100 * meter.render_share) : "…",
             "CPU time of the render threads, of all cores; other programs use some, too");
  ui.readout("restarts", fmt::format("{}", status.restarts), "Accumulations begun since the window opened");
  ui.readout("non-finite", fmt::format("{}", status.nonfinite),
             "Samples whose radiance was NaN or infinite; they are left out and counted");
  ui.readout("window", fmt::format("{:.1f} ms", state.frame_ms), "CPU time of the window's last frame");
  const FilmSettings& film = state.document.settings.film;
  ui.readout("film", fmt::format("{} x {}", film.width, film.height), "pixels");
}

void panel_column(Ui& ui, ViewerState& state, vec2 position, vec2 size) {
  ImGui::SetNextWindowPos(ImVec2(position.x, position.y));
  ImGui::SetNextWindowSize(ImVec2(size.x, size.y));
  const ImGuiWindowFlags flags =
      (kPlainWindow & ~ImGuiWindowFlags_NoScrollbar) |
      ImGuiWindowFlags_AlwaysVerticalScrollbar; // so that nothing moves when a section opens
  if (ImGui::Begin("##panels", nullptr, flags)) {
    for (DrawPanel draw : kPanels) draw(ui, state);
    if (ui.button("lab.open", "Monte Carlo lab",
                  "Lessons on samplers, densities and materials, over the picture (F2)"))
      state.toggle_lab();
    state.reveal_selection = false;
  }
  ImGui::End();
}

void status_line(Ui& ui, ViewerState& state, vec2 position, vec2 size) {
  ImGui::SetNextWindowPos(ImVec2(position.x, position.y));
  ImGui::SetNextWindowSize(ImVec2(size.x, size.y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(10 * ui.scale(), 3 * ui.scale()));
  if (ImGui::Begin("##status", nullptr, kPlainWindow)) {
    const float unit = ui.scale();
    const SessionStatus& status = state.status;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled(
        ImVec2(at.x + 4 * unit, at.y + 0.5f * ImGui::GetTextLineHeight()), 3.5f * unit,
        ImGui::GetColorU32(phase_color(status.phase)));
    // Each text has a fixed position, so that none moves when another grows.
    auto cell = [&, x = kFirstCell * unit](const std::string& text, float width) mutable {
      ImGui::SameLine(x);
      ImGui::TextUnformatted(text.c_str());
      x += width * unit;
    };
    ImGui::Dummy(ImVec2(1, 1));
    cell(phase_text(state), 80);
    cell(spp_text(state) + " spp", 118);
    cell(seconds_text(status.render_seconds), 80);
    cell(si(per_second(status.rays.samples, status.render_seconds)) + " samples/s", 138);
    std::string talk = state.notice;
    if (state.reading)
      talk =
          fmt::format("loading {} … {:.0f} %", std::filesystem::path(state.loading_path).filename().string(),
                      std::floor(100 * state.loaded));
    else if (talk.empty())
      talk = scene_title(state) + (state.modified ? "*" : "");
    if (!state.picture_of.empty()) talk += "    " + state.picture_of;
    if (state.picture && state.picture->denoised)
      talk += "    " + denoised_text(*state.picture->denoised);
    else if (state.document.settings.display.denoise && state.document.settings.view == View::radiance)
      talk += "    " + (status.denoise_error.empty() ? "denoising …" : status.denoise_error);
    cell(talk, 0);
    const char* keys = "F1 help    Tab panels";
    const float width = ImGui::CalcTextSize(keys).x;
    const float left = size.x - width - 10 * unit;
    const float talk_end = (kFirstCell + 80 + 118 + 80 + 138) * unit + ImGui::CalcTextSize(talk.c_str()).x;
    if (left > talk_end + 16 * unit) {
      ImGui::SameLine(left);
      ImGui::TextDisabled("%s", keys);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

} // namespace candela
