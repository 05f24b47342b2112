#pragma once
// The camera's part of the settings table.

#include "scene/document.h"

#include <span>

namespace candela {

/// "camera.*", in the order in which the panel shows them.
std::span<const Field<Document>> camera_rows();

} // namespace candela
