#include "app/lab/panels_lab.h"

#include "app/lab/lab_drawing.h"
#include "app/ui/pane.h"
#include "lab/lessons.h"

#include <fmt/format.h>

#include <algorithm>

namespace candela {

namespace {

constexpr float kPaneAlpha = 0.97f;
constexpr float kPanelWidth = 452; // at scale 1: half of the picture in a small window

std::unique_ptr<LabPage> make_page(std::string_view lesson_name) {
  if (lesson_name == "pi") return make_pi_page();
  if (lesson_name == "solid-angle") return make_solid_angle_page();
  if (lesson_name == "integral") return make_integral_page();
  if (lesson_name == "points") return make_points_page();
  if (lesson_name == "warps") return make_warps_page();
  if (lesson_name == "medium") return make_medium_page();
  if (lesson_name == "lens") return make_lens_page();
  return make_brdf_page();
}

} // namespace

std::span<const std::string_view> sampler_names() { return find_setting("sampler.type")->choices; }

void sampler_fields(Ui& ui, Document& sampler) {
  static const Document defaults;
  for (const auto* row : sampler_rows()) {
    if (row->key == "sampler.strata" && sampler.settings.sampler.type != SamplerType::stratified) continue;
    lab_field(ui, *row, sampler, defaults, row->key == "sampler.type" ? "sampler" : "");
  }
}

LabPanel::LabPanel(std::function<void()> wake) : worker_(std::move(wake)) {
  for (const LessonInfo& info : lessons()) pages_.push_back(make_page(info.name));
}

LabPanel::~LabPanel() = default;

float LabPanel::width(float scale, float room) { return std::min(kPanelWidth * scale, room); }

void LabPanel::draw(Ui& ui, bool& visible, vec2 position, vec2 room) {
  worker_.run_completions();
  if (!visible || room.x < 1 || room.y < 1) return;
  const float width = LabPanel::width(ui.scale(), room.x);
  const LessonInfo& info = lessons()[page_];
  const std::string look_at = fmt::format("{}. {}", info.title, info.look_at);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float wrap = std::max(width - 2 * style.WindowPadding.x, 1.0f);
  const float head = ImGui::GetFrameHeightWithSpacing() + 2 * style.WindowPadding.y +
                     ImGui::CalcTextSize(look_at.c_str(), nullptr, false, wrap).y;
  ImGui::SetNextWindowBgAlpha(kPaneAlpha);
  if (begin_pane("##lab_head", position, vec2(width, std::min(head, room.y)), ImGuiWindowFlags_NoScrollbar)) {
    const float close = 60 * ui.scale();
    for (std::size_t i = 0; i < pages_.size(); ++i) {
      const std::string name(lessons()[i].name);
      if (i > 0) ImGui::SameLine(0, 2 * ui.scale());
      ImGui::PushStyleColor(ImGuiCol_Button,
                            i == page_ ? ImVec4(0.40f, 0.40f, 0.40f, 1) : ImVec4(0.20f, 0.20f, 0.20f, 1));
      if (ui.button(fmt::format("lab/{}", name).c_str(), name.c_str())) page_ = i;
      ImGui::PopStyleColor();
    }
    ImGui::SameLine(std::max(ImGui::GetWindowContentRegionMax().x - close, 1.0f));
    if (ui.button("lab.close", "Close", "F2; the lesson pauses and continues when it is shown again", close))
      visible = false;
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(look_at.c_str());
    ImGui::PopTextWrapPos();
    ui.record("lab.look_at");
  }
  ImGui::End();
  const std::string body = fmt::format("##lab_{}", page_); // each page keeps its own scroll
  ImGui::SetNextWindowBgAlpha(kPaneAlpha);
  if (begin_pane(body.c_str(), position + vec2(0, head), vec2(width, std::max(room.y - head, 1.0f)),
                 ImGuiWindowFlags_AlwaysVerticalScrollbar)) {
    pages_[page_]->draw(ui, sampler_);
    pages_[page_]->step(worker_);
  }
  ImGui::End();
}

} // namespace candela
