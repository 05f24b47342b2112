#pragma once
// What the Compare panel looks at and changes: two Documents, A and B, rendered side by side.

#include "app/figures/plot.h"
#include "session/render_session.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace candela {

enum class CompareLayout : int { side_by_side, wipe, flip, difference };
enum class DifferenceOf : int { a_and_b, a_and_reference, b_and_reference };

/// What CompareVariant::noise is called wherever it shows: no variance knows of a bias.
inline constexpr std::string_view kNoiseName = "noise (est. relMSE)";

struct CompareVariant {
  SessionStatus status;
  std::string label;             ///< what it has that the other has not: "sampler.type=halton"
  std::optional<double> rel_mse; ///< against the reference
  std::optional<double> noise;   ///< relMSE that the picture's own variance lets expect
};

struct CompareState {
  bool active = false;
  bool panel_was_active = false; ///< in the frame before: the panel unfolds when a comparison begins
  int edited = 0;                ///< the variant that the panels change; 0: A, 1: B
  CompareLayout layout = CompareLayout::side_by_side;
  bool equal_time = false;  ///< both render for the same time; else the same samples
  bool share_camera = true; ///< flying moves both
  bool flipped = false;     ///< B is to be seen, in the flip layout
  float divider = 0.5f;     ///< of wipe, share of the free region's width
  int zoom = 0;             ///< screen pixels a film pixel; 0: all of the film
  vec2 pan{0};              ///< of a zoomed picture, film pixels from the middle
  DifferenceOf difference = DifferenceOf::a_and_b;
  bool with_sign = false;
  float range = 0.1f; ///< of the signed difference: the relative difference of the end colours
  bool over_seconds = false;
  int reference_spp = 1024;
  std::string reference_path; ///< as typed

  // What there is to see.
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

/// The settings that `document` has and `other` has not, as KEY=VALUE; those that both variants of a
/// comparison share (camera, film size, display, stop) are left out. At most `most`, the rest is counted.
std::string distinct_settings(const Document& document, const Document& other, std::size_t most);

} // namespace candela
