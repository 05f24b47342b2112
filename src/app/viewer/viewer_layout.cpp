// Layout and drawing of the picture and the panels.

#include "app/figures/typeface.h"
#include "app/ui/ui_style.h"
#include "app/viewer/viewer.h"

#include <imgui.h>

namespace candela {

namespace {

constexpr float kColumnWidth = 352; // at scale 1, like all lengths here
constexpr float kStatusHeight = 24;
constexpr float kToolHeight = 66;
/// Smaller windows show only the picture: panels would be unreadable.
constexpr float kMinPanelWindowWidth = 420, kMinPanelWindowHeight = 160;
/// On a monitor with a high scale, the panels take at most the share of the window that they take of a window
/// of this size.
constexpr float kScaleReferenceWidth = 960, kScaleReferenceHeight = 540;

bool covers(const PixelRect& a, const PixelRect& b) {
  return a.x <= b.x && a.y <= b.y && a.x + a.width >= b.x + b.width && a.y + a.height >= b.y + b.height;
}

} // namespace

void Viewer::update_scale() {
  const float room = std::min(static_cast<float>(framebuffer_.x) / kScaleReferenceWidth,
                              static_cast<float>(framebuffer_.y) / kScaleReferenceHeight);
  const float wanted = std::min(content_scale_, std::max(room, 1.0f)) * text_zoom_;
  const float scale =
      std::clamp(std::round(wanted * 8) / 8, 0.5f, 4.0f); // few steps, since each builds a font atlas
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (scale == state_.scale && atlas.IsBuilt() && !glyphs_are_new_) return;
  glyphs_are_new_ = false;
  state_.scale = scale;
  atlas.Clear();
  load_fonts(atlas, scale, glyphs_);
  draw_.upload_fonts(atlas);
  apply_style(scale);
}

/// An atlas of all characters would take hundreds of megabytes: characters are added when they appear.
void Viewer::learn_letter(char32_t letter) {
  constexpr std::size_t kMost = 4000;
  constexpr char32_t kLastOfImGui = 0xffff; // it supports no others
  if (!is_common_glyph(letter) && letter <= kLastOfImGui && glyphs_.size() < kMost)
    glyphs_are_new_ |= glyphs_.insert(letter).second;
}

void Viewer::learn_letters(std::string_view text) {
  if (std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return;
  for (char32_t letter : code_points(text)) learn_letter(letter);
}

/// Texts that may change in any frame: typed ones and messages.
void Viewer::learn_letters_of_frame() {
  for (const std::string* text :
       {&state_.error, &state_.notice, &state_.loading_path, &state_.path_input, &state_.panorama_input,
        &state_.volume_input, &state_.save_path, &state_.replace_path, &state_.picture_of,
        &state_.compare.reference_path, &state_.compare.reference, &state_.inspect.bookmark_name,
        &state_.document.scene.description})
    learn_letters(*text);
}

void Viewer::learn_letters_of_scene() {
  const SceneDesc& scene = state_.document.scene;
  auto learn_names = [&](const auto& things) {
    for (const auto& thing : things) learn_letters(thing.name);
  };
  learn_names(scene.instances);
  learn_names(scene.materials);
  learn_names(scene.lights);
  learn_names(scene.bookmarks);
  for (const auto& texture : scene.textures) learn_letters(texture->name);
  learn_letters(state_.scene_path);
  for (const std::string& text : state_.warnings) learn_letters(text);
  for (const std::string& path : state_.recent) learn_letters(path);
  for (const auto& path : state_.scenes) learn_letters(path.string());
}

bool Viewer::shows_panels() const {
  return state_.panels_visible && static_cast<float>(framebuffer_.x) >= kMinPanelWindowWidth * state_.scale &&
         static_cast<float>(framebuffer_.y) >= kMinPanelWindowHeight * state_.scale;
}

PixelRect Viewer::free_region() const {
  PixelRect region{0, 0, framebuffer_.x, framebuffer_.y};
  if (shows_panels()) {
    region.width -= static_cast<int>(std::round(kColumnWidth * state_.scale));
    region.height -= static_cast<int>(std::round(kStatusHeight * state_.scale));
  }
  return region;
}

PixelRect Viewer::picture_rect() const {
  if (!state_.compare.active) return single_picture_rect();
  const ComparePanes panes = compare_panes();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return panes.variants[static_cast<std::size_t>(panes.variant_at({mouse.x, mouse.y}))].picture;
}

PixelRect Viewer::single_picture_rect() const {
  // Until there is a picture, the rectangle is that of the picture to come: gestures begin at once.
  const FilmSettings& ordered = state_.document.settings.film;
  const ivec2 film = state_.picture    ? ivec2(state_.picture->width, state_.picture->height)
                     : state_.fit_film ? glm::max(framebuffer_, ivec2(1))
                                       : glm::max(ivec2(ordered.width, ordered.height), ivec2(1));
  if (!state_.fit_film)
    return letterbox(free_region(), view_shape(film, state_.document.scene.camera.film_aspect()));
  // The film has the window's size, so that showing and hiding panels does not restart it; its centre is in
  // the centre of the free region. While the window is resized, the old picture is scaled.
  return letterbox(centered(free_region(), glm::max(framebuffer_, ivec2(1))), film);
}

void Viewer::draw_ui() {
  const PixelRect free = free_region();
  const vec2 free_size(free.width, free.height);
  const vec2 window(framebuffer_);
  if (shows_panels()) {
    const float tools = std::round(kToolHeight * state_.scale), width = window.x - free_size.x;
    tool_bar(ui_, state_, vec2(free_size.x, 0), vec2(width, tools));
    panel_column(ui_, state_, vec2(free_size.x, tools), vec2(width, free_size.y - tools));
    status_line(ui_, state_, vec2(0, free_size.y), vec2(window.x, window.y - free_size.y));
  }
  const bool covered = state_.texture_view.visible; // the picture, by a texture
  if (state_.compare.active && !covered)
    compare_overlay(ui_, state_.compare, compare_panes(), compare_.difference() != nullptr);
  // Overlays begin where neither the lab nor a message covers the picture.
  const vec2 clear(state_.lab_visible ? LabPanel::width(state_.scale, free_size.x) : 0, state_.strips_bottom);
  if (!covered) {
    inspector_.draw(ui_, state_, picture_rect(), free, clear, now_);
    picture_label(ui_, state_, clear);
  }
  bool hidden = false;
  lab_.draw(ui_, covered ? hidden : state_.lab_visible, vec2(0), free_size);
  texture_viewer_.draw(ui_, state_, vec2(0), free_size);
  message_strips(ui_, state_, vec2(0), free_size);
  help_overlay(ui_, state_, 0.5f * free_size, 0.96f * free_size);
  const vec2 bottom_center(0.5f * free_size.x, free_size.y);
  if (!shows_panels() && !state_.notice.empty())
    floating_line(ui_, "notice", state_.notice, bottom_center);
  else if (now_ - first_frame_ < kHintSeconds && !state_.help_visible && !state_.lab_visible && !covered)
    floating_line(ui_, "hint",
                  "W A S D to fly, drag to look, middle or Alt+drag to orbit; F1 shows every key",
                  bottom_center);
}

/// Clips overlays of the picture where the panels begin, since panels have no background of their own.
void Viewer::clip_overlays() const {
  const PixelRect free = free_region();
  ImGui::GetBackgroundDrawList()->PushClipRect(
      {static_cast<float>(free.x), static_cast<float>(free.y)},
      {static_cast<float>(free.x + free.width), static_cast<float>(free.y + free.height)});
}

/// Without a GPU, fill rate is limited. Clearing the framebuffer is nearly free and draws the panels'
/// background, where blending would cost as much as the picture. The area around the picture is drawn only if
/// there is one, and the picture is not drawn under panels.
void Viewer::draw_window() {
  const PixelRect free = free_region(), picture = picture_rect();
  gl_.Viewport(0, 0, framebuffer_.x, framebuffer_.y);
  clear(kPanelGrey);
  gl_.Enable(GL_SCISSOR_TEST);
  scissor(free);
  if (state_.compare.active || !viewport_.shown() || !covers(picture, free)) clear(kBackgroundGrey);
  if (state_.compare.active)
    draw_comparison();
  else
    viewport_.draw(picture, framebuffer_);
  gl_.Disable(GL_SCISSOR_TEST);
  draw_.draw(*ImGui::GetDrawData());
}

void Viewer::scissor(const PixelRect& rect) const {
  gl_.Scissor(rect.x, framebuffer_.y - rect.y - rect.height, rect.width, rect.height); // y grows upwards
}

void Viewer::clear(float grey) const {
  gl_.ClearColor(grey, grey, grey, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
}

} // namespace candela
