#include "app/viewer/inspector.h"

#include "app/panels/bookmarks.h"
#include "app/panels/panels.h"
#include "app/panels/panels_probe.h"
#include "app/platform/gl_texture.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

namespace candela {

namespace {

constexpr double kFocusMarkSeconds = 4;
/// Depths of so many pixels take about 50 ms while rendering.
constexpr double kMaxDepths = 250000;

} // namespace

Inspector::Inspector(const Gl& gl, std::function<void()> wake) : gl_(gl), worker_(std::move(wake)) {
  gl_.GenTextures(1, &texture_);
}

Inspector::~Inspector() { gl_.DeleteTextures(1, &texture_); }

std::optional<std::string> Inspector::shortcut(Key key, bool control, ViewerState& state) {
  InspectState& inspect = state.inspect;
  if (key >= Key::digit_1 && key <= Key::digit_9) {
    const auto number = static_cast<std::size_t>(key) - static_cast<std::size_t>(Key::digit_1);
    const auto& bookmarks = state.document.scene.bookmarks;
    if (control) {
      store_bookmark(state, number);
      return fmt::format("Stored as bookmark {}, {}", inspect.selected_bookmark + 1,
                         bookmarks[static_cast<std::size_t>(inspect.selected_bookmark)].name);
    }
    if (number >= bookmarks.size())
      return fmt::format("There is no bookmark {0}: Ctrl+{0} stores the view", number + 1);
    go_to_bookmark(state, number);
    return bookmarks[number].name;
  }
  if (control) return std::nullopt;
  if (key == Key::i) {
    inspect.probe_visible = !inspect.probe_visible;
    inspect.probe_frozen = false;
  } else if (key == Key::h && inspect.probe_visible) {
    inspect.probe_frozen = !inspect.probe_frozen && inspect.probe_pixel;
  } else if (key == Key::o) {
    inspect.focus_plane_visible = !inspect.focus_plane_visible;
  } else {
    return std::nullopt;
  }
  return "";
}

void Inspector::mark_focus(ViewerState& state, const Pick& pick, double now) {
  state.inspect.focus_mark = {pick.position, pick.view_depth, now + kFocusMarkSeconds};
}

Inspector::DepthKey Inspector::depth_key(const RenderSession::Built& built) {
  if (!built.scene) return {};
  DepthKey key{built.document->scene.camera,
               {built.document->settings.film.width, built.document->settings.film.height},
               built.scene};
  const Camera standard;
  key.camera.aperture_radius = standard.aperture_radius;
  key.camera.focus_distance = standard.focus_distance;
  key.camera.blades = standard.blades;
  key.camera.blade_rotation = standard.blade_rotation;
  return key;
}

void Inspector::update(ViewerState& state, const RenderSession& session, const PixelRect& picture,
                       std::optional<vec2> mouse) {
  worker_.run_completions();
  InspectState& inspect = state.inspect;
  if (inspect.probe_visible && state.picture) {
    const ivec2 film(state.picture->width, state.picture->height);
    if (!inspect.probe_frozen) {
      inspect.probe_pixel.reset();
      if (mouse) {
        const vec2 inside =
            (*mouse + 0.5f - vec2(picture.x, picture.y)) / vec2(picture.width, picture.height);
        if (inside.x >= 0 && inside.y >= 0 && inside.x < 1 && inside.y < 1)
          inspect.probe_pixel = glm::min(ivec2(inside * vec2(film)), film - 1);
      }
    } else if (inspect.probe_pixel->x >= film.x || inspect.probe_pixel->y >= film.y) {
      inspect.probe_pixel.reset(); // the film size has changed
      inspect.probe_frozen = false;
    }
    inspect.probe_pick.reset();
    if (inspect.probe_pixel) inspect.probe_pick = session.pick(vec2(*inspect.probe_pixel) + 0.5f);
  }
  if (inspect.histogram_open && state.picture && state.picture != inspect.histogram_of && !counting_) {
    counting_ = true;
    worker_.post([this, &inspect, picture_shown = state.picture]() -> TaskThread::Completion {
      auto made =
          std::make_shared<const LogHistogram>(log_histogram(picture_shown->linear(), picture_shown->rgba));
      return [this, &inspect, made, picture_shown] {
        inspect.histogram = made;
        inspect.histogram_of = picture_shown;
        counting_ = false;
      };
    });
  }
  inspect.histogram_open = false; // set again when the panel is drawn
  depths_current_ = false;
  if (inspect.focus_plane_visible) ask_for_depths(session);
}

void Inspector::ask_for_depths(const RenderSession& session) {
  const RenderSession::Built built = session.built();
  const DepthKey key = depth_key(built);
  depths_current_ = depths_ && key == depth_of_;
  if (depths_current_ || tracing_ || !built.scene) return;
  tracing_ = true;
  asked_of_ = key;
  const int stride = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(key.film.x) * key.film.y / kMaxDepths))));
  worker_.post([this, built, stride]() -> TaskThread::Completion {
    auto map = std::make_shared<const DepthMap>(depth_map(*built.scene, *built.document, stride));
    return [this, map] {
      depths_ = map;
      depth_of_ = asked_of_;
      tracing_ = false;
    };
  });
}

void Inspector::paint_focus_plane(const Camera& camera, ivec2 film) {
  const DepthMap& map = *depths_;
  const CameraView view(camera, film.x, film.y);
  const float focus = view.focus_distance();
  const CameraView::Interval sharp = view.depth_of_field(sharp_blur(film.y));
  using Texel = std::array<std::uint8_t, 4>;
  constexpr Texel kNone{0, 0, 0, 0}, kSharp{60, 220, 255, 70}, kPlane{60, 220, 255, 230};
  constexpr float kSameSurface = 0.05f; // of the focus distance: a larger depth step is an edge
  std::vector<Texel> texels(map.depth.size(), kNone);
  const auto width = static_cast<std::size_t>(map.width);
  for (std::size_t i = 0; i < map.depth.size(); ++i) {
    const float z = map.depth[i];
    if (view.has_lens() && z >= sharp.near && z <= sharp.far) texels[i] = kSharp;
    auto crosses = [&](std::size_t j) {
      const float other = map.depth[j];
      return (z - focus) * (other - focus) <= 0 && std::abs(z - other) < kSameSurface * focus;
    };
    if ((i % width + 1 < width && crosses(i + 1)) || (i + width < map.depth.size() && crosses(i + width)))
      texels[i] = kPlane;
  }
  upload_rgba8(gl_, texture_, {map.width, map.height}, texels.front().data(), GL_LINEAR, GL_NEAREST);
  painted_camera_ = camera;
  painted_depths_ = depths_;
}

void Inspector::draw_focus_plane(const ViewerState& state, const PixelRect& picture) {
  if (!state.inspect.focus_plane_visible || !depths_current_) return;
  const Camera& camera = state.document.scene.camera;
  if (painted_depths_ != depths_ || painted_camera_ != camera) paint_focus_plane(camera, depth_of_.film);
  // The map may extend beyond the film's edge by some pixels.
  const vec2 stride = glm::ceil(vec2(depth_of_.film) / vec2(depths_->width, depths_->height));
  const vec2 end = vec2(depth_of_.film) / (stride * vec2(depths_->width, depths_->height));
  ImGui::GetBackgroundDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_)),
      ImVec2(static_cast<float>(picture.x), static_cast<float>(picture.y)),
      ImVec2(static_cast<float>(picture.x + picture.width), static_cast<float>(picture.y + picture.height)),
      ImVec2(0, 0), ImVec2(end.x, end.y));
}

void Inspector::draw(Ui& ui, ViewerState& state, const PixelRect& picture, const PixelRect& free, vec2 clear,
                     double now) {
  draw_focus_plane(state, picture);
  draw_focus_mark(ui, state, picture, now);
  legend_overlay(ui, state, vec2(free.x, free.y + free.height));
  probe_overlay(ui, state, picture, clear);
}

} // namespace candela
