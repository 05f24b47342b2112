#pragma once
// The portals of a scene, as its infinite lights are sampled through them.

#include "lights/light.h"
#include "lights/light_desc.h"

#include <memory>
#include <vector>

namespace candela {

/// The portals of a scene that are not closed, and the charts of what comes through them, which edits of
/// other parts keep: a chart does not depend on where its portals are.
class ScenePortals {
public:
  ScenePortals() = default;
  /// Throws Error (limit) if there are too many.
  explicit ScenePortals(const std::vector<LightDesc>& lights);

  /// Tells a light where it comes in, if it is one that portals serve: an environment, a sky, or a constant
  /// light. This must outlive it. Charts of `previous` (may be null) serve again. Throws Cancelled soon after
  /// `progress` is told to end; it may be null.
  void give(Light& light, const ScenePortals* previous, const Progress* progress);
  std::size_t memory_bytes() const;

private:
  struct KnownChart {
    EnvironmentLight light; ///< its factor 1 at most; without a map: constant
    std::shared_ptr<const PortalChart> chart;
  };
  const std::shared_ptr<const PortalChart>& chart(const EnvironmentLight& light, const PortalAxes& axes,
                                                  const ScenePortals* previous, const Progress* progress);

  std::vector<PortalRectangle> portals_;
  std::vector<KnownChart> charts_;
  std::vector<std::unique_ptr<const PortalGuide>> guides_; ///< what the lights point to
};

} // namespace candela
