#pragma once
// The state that the Compare panel shows and edits: two Documents, A and B, rendered side by side.

#include "app/figures/plot.h"
#include "session/render_session.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace candela {

enum class CompareLayout : int { side_by_side, wipe, flip, difference };
enum class DifferenceOf : int { a_and_b, a_and_reference, b_and_reference };

/// The label of CompareVariant::noise. It is not "error", since a variance does not include bias.
inline constexpr std::string_view kNoiseName = "noise (est. relMSE)";

struct CompareVariant {
  SessionStatus status;
  std::string label;             ///< what it has that the other has not: "sampler.type=halton"
  std::optional<double> rel_mse; ///< against the reference
  std::optional<double> noise;   ///< relMSE estimated from the picture's variance
};

struct CompareState {
  bool active = false;
  bool panel_was_active = false; ///< in the last frame: the panel unfolds when a comparison begins
  int edited = 0;                ///< the variant that the panels change; 0: A, 1: B
  CompareLayout layout = CompareLayout::side_by_side;
  bool equal_time = false;  ///< both render for the same time; else the same samples
  bool share_camera = true; ///< flying moves both
  bool flipped = false;     ///< B is shown, in the flip layout
  float divider = 0.5f;     ///< of wipe, share of the free region's width
  int zoom = 0;             ///< screen pixels per film pixel; 0: the whole film
  vec2 pan{0};              ///< of a zoomed picture, film pixels from the middle
  DifferenceOf difference = DifferenceOf::a_and_b;
  bool with_sign = false;
  float range = 0.1f; ///< relative difference at the ends of the signed colour map
  bool over_seconds = false;
  int reference_spp = 1024;
  std::string reference_path; ///< as typed

  // Shown by the panel.
  std::array<CompareVariant, 2> variants;
  std::string reference; ///< in words: "none", "rendering, 12 of 1024 spp", "A at 512 spp"
  bool has_reference = false;
  bool rendering_reference = false;
  Plot plot;

  // Requests to the Viewer.
  bool toggle_requested = false;
  std::optional<int> edit_requested;   ///< a variant
  std::optional<int> copy_requested;   ///< the variant to copy from
  std::optional<int> freeze_requested; ///< the variant whose picture becomes the reference
  bool render_reference_requested = false;
  bool load_reference_requested = false;
  bool clear_reference_requested = false;
  bool export_requested = false;
};

constexpr CompareLayout next_layout(CompareLayout layout) {
  return static_cast<CompareLayout>((static_cast<int>(layout) + 1) % 4);
}

/// 'A' or 'B'.
constexpr char variant_letter(int variant) { return variant == 0 ? 'A' : 'B'; }

/// The settings of `document` that differ from those of `other`, as KEY=VALUE, except those that both
/// variants share (camera, film size, display, stop). Lists at most `most` of them and the number of the
/// others.
std::string distinct_settings(const Document& document, const Document& other, std::size_t most);

} // namespace candela
