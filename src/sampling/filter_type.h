#pragma once

namespace candela {

/// The weight that a pixel gives to the film around it (sampling/filter.h).
enum class FilterType : int { box, tent, gaussian, blackman_harris, mitchell };

} // namespace candela
