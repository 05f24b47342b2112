#pragma once

#include "media/phase_model.h"
#include "sampling/warp.h"

namespace candela {

/// Into all directions alike.
struct IsotropicPhase {
  bool operator==(const IsotropicPhase&) const = default;

  static constexpr std::string_view kName = "isotropic";
  static constexpr std::string_view kHelp = "into all directions alike";
  static constexpr auto rows() { return std::array<PhaseRow<IsotropicPhase>, 0>{}; }
  IsotropicPhase closure() const { return {}; }

  float eval(Turn) const { return kUniformSpherePdf; }
  Turn sample(float u, float) const { return Turn::from_forward(2 * u); }
  float mean_cosine() const { return 0; }
};

} // namespace candela
