#include "render/film/render_pass.h"

namespace candela {

PassResult render_pass(const RenderScene& scene, const Document& document, const SampleRange& range,
                       Film& film, const StopCondition& stop, const PassOptions& options) {
  return CpuPassRenderer(options.threads)
      .render({scene, document, range, options.crop, options.camera},
              {film, options.components, options.layers}, stop);
}

} // namespace candela
