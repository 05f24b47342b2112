#include "app/viewer/texture_viewer.h"

#include "app/ui/pane.h"
#include "app/ui/ui_style.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <new>

namespace candela {

namespace {

constexpr float kColumn = 292; // at scale 1
constexpr float kZoomStep = 1.2f;
constexpr float kLeastSide = 16;          // of the unit square, pixels
constexpr float kLargestTexel = 256;      // pixels
constexpr std::size_t kMostEdges = 20000; // of a UV layout

constexpr std::string_view kChannels[] = {"RGB", "R", "G", "B", "A"};
constexpr std::string_view kResolutions[] = {"256", "512", "1024", "2048", "4096"};
constexpr float kStops = 16;

std::string numbers(vec4 v, int count, const char* format) {
  std::string text;
  for (int c = 0; c < count; ++c)
    text += fmt::format(fmt::runtime(format), v[c]) + (c + 1 < count ? " " : "");
  return text;
}

} // namespace

TextureViewer::TextureViewer(const Gl& gl, std::function<void()> wake)
    : tiles_(gl), worker_(std::move(wake)) {}

TextureViewer::~TextureViewer() { close(); }

void TextureViewer::close() {
  tiles_.clear();
  if (building_) building_->cancel();
  building_.reset();
  pyramid_.reset();
  too_large_.reset();
  texture_.reset();
  layout_of_.reset();
  layout_.clear();
  shown_ = false;
}

void TextureViewer::draw(Ui& ui, ViewerState& state, vec2 position, vec2 room) {
  worker_.run_completions();
  TextureViewState& view = state.texture_view;
  const auto& textures = state.document.scene.textures;
  if (view.texture < 0 || static_cast<std::size_t>(view.texture) >= textures.size()) view.visible = false;
  if (!view.visible || room.x < 1 || room.y < 1) {
    if (shown_) close();
    return;
  }
  const std::vector<TextureUser> users = texture_users(state.document.scene, view.texture);
  const auto of =
      std::ranges::find_if(users, [&](const TextureUser& u) { return view.as_of == u.parameter; });
  if (of == users.end()) view.as_of.reset(); // it no longer uses the texture
  const TextureUser* user = view.as_of ? &*of : nullptr;
  // As a parameter has its integers, if one does.
  color_space_ = user != nullptr ? user->look.use.color_space
                 : users.empty() ? ColorSpace::srgb
                                 : users.front().look.use.color_space;
  update_grid(state, user);
  shown_ = true;

  const float column = std::min(kColumn * ui.scale(), 0.5f * room.x);
  if (begin_pane("##texture_view", position, vec2(column, room.y), ImGuiWindowFlags_None)) {
    controls(ui, state, users);
    facts(ui, state, users);
  }
  ImGui::End();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(kBackgroundGrey, kBackgroundGrey, kBackgroundGrey, 1));
  if (begin_pane("##texture_canvas", position + vec2(column, 0), vec2(room.x - column, room.y),
                 ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse))
    canvas(ui, state, user);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

void TextureViewer::update_grid(const ViewerState& state, const TextureUser* user) {
  const TextureViewState& view = state.texture_view;
  const auto& texture = state.document.scene.textures[static_cast<std::size_t>(view.texture)];
  TextureGridOptions options;
  if (user != nullptr) {
    options.look = user->look;
  } else {
    const auto users = texture_users(state.document.scene, view.texture);
    if (!users.empty()) options.wrap = users.front().look.use.wrap;
  }
  options.copies = view.tiled ? 2 : 1;
  options.color_space = color_space_;
  options.resolution = 256 << view.resolution;
  const ImageTexture* image = texture->image();
  if (image != nullptr && user == nullptr && view.level > 0) {
    if (too_large_ == image->texels)
      options.level = 0;
    else if (!pyramid_ || pyramid_->texels() != image->texels || pyramid_->color_space() != color_space_)
      build_pyramid(*image, color_space_);
    else
      options.level = view.level;
    if (building_ && tiles_.grid() && texture == texture_) return; // what is shown stays until then
  }
  texture_ = texture;
  if (tiles_.grid() == nullptr || tiles_.grid()->texture() != texture || tiles_.grid()->options() != options)
    tiles_.show(std::make_shared<const TextureGrid>(texture, options, options.level > 0 ? pyramid_ : nullptr),
                view.display);
  else
    tiles_.show(tiles_.grid(), view.display);
  const vec2 unit(tiles_.grid()->unit_size());
  if (options.level == 0) aspect_ = unit.y / unit.x; // levels are rounded
}

void TextureViewer::build_pyramid(const ImageTexture& image, ColorSpace space) {
  if (building_) return;
  building_ = std::make_shared<Progress>();
  worker_.post([this, texels = image.texels, space, progress = building_]() -> TaskThread::Completion {
    std::shared_ptr<const MipPyramid> made;
    try {
      made = std::make_shared<const MipPyramid>(texels, space, progress.get());
    } catch (const Cancelled&) { // the viewer was closed
    } catch (const std::bad_alloc&) {}
    return [this, made, texels, progress] {
      if (building_ != progress) return;
      building_.reset();
      pyramid_ = made;
      if (!made) too_large_ = texels;
    };
  });
}

void TextureViewer::controls(Ui& ui, ViewerState& state, const std::vector<TextureUser>& users) {
  TextureViewState& view = state.texture_view;
  const ImageTexture* image = texture_->image();
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float third = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  if (ui.button("texture_view.fit", "Fit", "All of it; double-click the picture", third))
    view.fit_wanted = true;
  ImGui::SameLine();
  if (ui.button("texture_view.one", "1:1", "One texel is one pixel of the screen", third)) {
    zoom_ = std::max(static_cast<float>(tiles_.grid()->unit_size().x), kLeastSide);
    fits_ = false;
  }
  ImGui::SameLine();
  if (ui.button("texture_view.close", "Close", "Esc", third)) view.visible = false;

  std::vector<std::string> names = {"the texture"};
  for (const TextureUser& user : users) names.push_back(user.label);
  const std::vector<std::string_view> choices(names.begin(), names.end());
  const auto of =
      std::ranges::find_if(users, [&](const TextureUser& u) { return view.as_of == u.parameter; });
  int shown = view.as_of ? static_cast<int>(of - users.begin()) + 1 : 0;
  if (ui.choice(
          "texture_view.show", "show", shown, choices,
          "The texture, or a parameter's value over its surface's coordinates: after the transform, the "
          "channel, factor and offset")) {
    view.as_of.reset();
    if (shown > 0) view.as_of = users[static_cast<std::size_t>(shown) - 1].parameter;
  }
  int channel = static_cast<int>(view.display.channel);
  if (ui.choice("texture_view.channel", "channel", channel, kChannels,
                "Colours, or one channel in grey; alpha is shown as stored"))
    view.display.channel = static_cast<ShownChannel>(channel);
  static constexpr FieldInfo kExposure{"exposure",
                                       FieldType::real,
                                       -kStops,
                                       kStops,
                                       "stops",
                                       "Multiplies the shown values by 2^exposure",
                                       Invalidates::nothing};
  const float zero = 0;
  FieldContext context;
  context.initial = &zero;
  ui.field("texture_view.exposure", kExposure, &view.display.exposure, context);
  if (image != nullptr && !view.as_of) {
    const auto levels = static_cast<int>(
        std::floor(std::log2(static_cast<float>(std::max(image->texels->width, image->texels->height)))));
    std::vector<std::string> sizes;
    for (int i = 0; i <= levels; ++i)
      sizes.push_back(fmt::format("{}: {} x {}", i, std::max(image->texels->width >> i, 1),
                                  std::max(image->texels->height >> i, 1)));
    const std::vector<std::string_view> entries(sizes.begin(), sizes.end());
    view.level = std::clamp(view.level, 0, levels);
    ui.choice("texture_view.level", "level", view.level, entries,
              "Of the pyramid that the filter 'trilinear' looks up; 0 is the picture");
  }
  if (image == nullptr)
    ui.choice("texture_view.resolution", "resolution", view.resolution, kResolutions,
              "Values that are evaluated along one unit of the coordinates");
  static constexpr FieldInfo kTiled{"tiled",
                                    FieldType::boolean,
                                    0,
                                    0,
                                    "",
                                    "Two copies along u and v, as its wrap mode says",
                                    Invalidates::nothing};
  static constexpr FieldInfo kLayout{"uv_layout",
                                     FieldType::boolean,
                                     0,
                                     0,
                                     "",
                                     "The edges of the selected object's mesh, in texture coordinates",
                                     Invalidates::nothing};
  ui.field("texture_view.tiled", kTiled, &view.tiled, {});
  ui.field("texture_view.uv_layout", kLayout, &view.uv_layout, {});
}

void TextureViewer::facts(Ui& ui, const ViewerState& state, const std::vector<TextureUser>& users) {
  const TextureViewState& view = state.texture_view;
  auto line = [&](const char* name, const std::string& text) {
    ImGui::TextWrapped("%s", text.c_str());
    ui.record(name);
  };
  ImGui::Separator();
  line("texture_view.name", texture_label(state.document.scene, view.texture));
  line("texture_view.kind", texture_summary(*texture_));
  if (const ImageTexture* image = texture_->image()) {
    const bool floats = std::holds_alternative<std::vector<float>>(image->texels->data);
    line("texture_view.space", floats || color_space_ == ColorSpace::linear ? "linear" : "sRGB");
    line("texture_view.memory",
         fmt::format("{}{}", bytes_text(image->memory_bytes()),
                     pyramid_ ? fmt::format(" and {} of levels", bytes_text(pyramid_->memory_bytes())) : ""));
    if (!image->source.empty()) {
      ImGui::TextDisabled("%s", image->source.c_str());
      ui.tooltip(image->source);
    }
  }
  ImGui::TextDisabled(users.empty() ? "No material uses it." : "Used by");
  for (const TextureUser& user : users) line("texture_view.user", user.label);
  if (building_) ImGui::TextDisabled("building the levels ...");
}

void TextureViewer::fit(vec2 size, int copies) {
  const float n = static_cast<float>(copies);
  const vec2 room = glm::max(0.94f * size, 1.0f);
  zoom_ = std::min(room.x / n, room.y / (n * aspect_));
  center_ = vec2(0.5f * n);
  fits_ = true;
}

/// The unit square on the screen, for the canvas [lo, hi].
void TextureViewer::place(vec2 lo, vec2 hi) {
  const vec2 unit(zoom_, zoom_ * aspect_), middle = 0.5f * (lo + hi);
  unit_.lo = glm::round(vec2(middle.x - center_.x * unit.x, middle.y - (1 - center_.y) * unit.y));
  unit_.hi = unit_.lo + unit;
}

void TextureViewer::use_mouse(TextureViewState& view, vec2 lo, vec2 hi) {
  const ImGuiIO& io = ImGui::GetIO();
  const vec2 mouse(io.MousePos.x, io.MousePos.y), middle = 0.5f * (lo + hi);
  const vec2 unit(zoom_, zoom_ * aspect_), up(1, -1);
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
    center_ -= up * vec2(io.MouseDelta.x, io.MouseDelta.y) / unit;
    fits_ = false;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) view.fit_wanted = true;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    const vec2 under = center_ + up * (mouse - middle) / unit; // stays under the mouse
    const float most = kLargestTexel * static_cast<float>(tiles_.grid()->unit_size().x);
    zoom_ = std::clamp(zoom_ * std::pow(kZoomStep, io.MouseWheel), kLeastSide, std::max(most, kLeastSide));
    center_ = under - up * (mouse - middle) / vec2(zoom_, zoom_ * aspect_);
    fits_ = false;
  }
  center_ = glm::clamp(center_, vec2(-0.5f), vec2(2.5f)); // part of it stays near
}

void TextureViewer::canvas(Ui& ui, ViewerState& state, const TextureUser* user) {
  TextureViewState& view = state.texture_view;
  const float line = ImGui::GetTextLineHeightWithSpacing() + 6 * ui.scale();
  const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const vec2 lo(at.x, at.y), size = glm::max(vec2(room.x, room.y - line), 1.0f), hi = lo + size;
  const int copies = view.tiled ? 2 : 1;
  ImGui::InvisibleButton("##canvas", im(size),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
  ui.record("texture_view.canvas");
  use_mouse(view, lo, hi);
  if (std::exchange(view.fit_wanted, false) || fits_) fit(size, copies);
  place(lo, hi);
  const float n = static_cast<float>(copies);
  const vec2 unit = unit_.hi - unit_.lo;
  const GridRect all{{unit_.lo.x, unit_.hi.y - n * unit.y}, {unit_.lo.x + n * unit.x, unit_.hi.y}};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(im(lo), im(hi), true);
  if (std::holds_alternative<MeshAttributeTexture>(texture_->model)) {
    ImGui::SetCursorScreenPos(im(lo + 24 * ui.scale()));
    ImGui::TextDisabled("Colours of a mesh: they have no picture over texture coordinates.");
  } else {
    tiles_.draw(list, all, lo, hi, worker_);
  }
  list.AddRect(im(unit_.lo - 1.0f), im(unit_.hi + 1.0f), IM_COL32(130, 130, 130, 160));
  if (view.uv_layout) draw_uv_layout(state, user, lo, hi);
  list.PopClipRect();
  ImGui::SetCursorScreenPos(im(vec2(lo.x + 10 * ui.scale(), hi.y + 3 * ui.scale())));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  told_ = hovered ? value_text(user, {mouse.x, mouse.y}) : std::string();
  if (told_.empty())
    ImGui::TextDisabled("%.0f %%   drag to pan, wheel to zoom",
                        100 * zoom_ / static_cast<float>(tiles_.grid()->unit_size().x));
  else
    ImGui::TextUnformatted(told_.c_str());
  ui.record(told_.empty() ? "texture_view.zoom" : "texture_view.value");
}

std::string TextureViewer::value_text(const TextureUser* user, vec2 mouse) const {
  const TextureGrid& grid = *tiles_.grid();
  const vec2 unit = unit_.hi - unit_.lo;
  const vec2 uv = vec2(mouse.x + 0.5f - unit_.lo.x, unit_.hi.y - mouse.y - 0.5f) / unit;
  const float n = static_cast<float>(grid.options().copies);
  if (!(uv.x >= 0 && uv.y >= 0 && uv.x < n && uv.y < n)) return {};
  const ivec2 at = glm::min(ivec2(vec2(uv.x, n - uv.y) * vec2(grid.unit_size())), grid.size() - 1);
  std::string text = fmt::format("uv {:.4f} {:.4f}", uv.x, uv.y);
  if (user != nullptr) {
    const vec2 there = user->look.use.uv.apply(uv);
    if (there != uv) text += fmt::format("   texture {:.4f} {:.4f}", there.x, there.y);
    return text + "   value " + numbers(grid.value(at), user->look.is_number ? 1 : 3, "{:.4g}");
  }
  if (const auto stored = grid.stored(at)) {
    const vec4 raw(stored->values[0], stored->values[1], stored->values[2], stored->values[3]);
    text += fmt::format("   texel {} {}   raw ", at.x, at.y) +
            numbers(raw, stored->channels, stored->integer ? "{:.0f}" : "{:.5g}");
  }
  return text + "   linear " + numbers(grid.value(at), 4, "{:.4g}");
}

void TextureViewer::draw_uv_layout(const ViewerState& state, const TextureUser* user, vec2 lo, vec2 hi) {
  const auto& scene = state.document.scene;
  if (state.selection.kind != Selection::Kind::object) return;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(
      &scene.instances[static_cast<std::size_t>(state.selection.index)].shape);
  if (mesh == nullptr) return;
  if (layout_of_ != *mesh) layout_of_ = *mesh, layout_ = uv_layout(**mesh, kMostEdges);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const vec2 unit = unit_.hi - unit_.lo;
  // Of the texture itself, where its first user looks for the surface; of a parameter, the surface's own.
  UvTransform transform;
  if (user == nullptr)
    if (const auto users = texture_users(scene, state.texture_view.texture); !users.empty())
      transform = users.front().look.use.uv;
  auto place = [&](vec2 uv) {
    const vec2 p = user == nullptr ? transform.apply(uv) : uv;
    return vec2(unit_.lo.x + p.x * unit.x, unit_.hi.y - p.y * unit.y);
  };
  for (const UvEdge& edge : layout_) {
    const vec2 a = place(edge.from), b = place(edge.to);
    const vec2 least = glm::min(a, b), most = glm::max(a, b);
    if (!(most.x >= lo.x && most.y >= lo.y && least.x <= hi.x && least.y <= hi.y)) continue;
    list.AddLine(im(a), im(b), IM_COL32(255, 170, 60, 200));
  }
}

} // namespace candela
