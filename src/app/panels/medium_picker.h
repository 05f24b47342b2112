#pragma once
// The choice of a medium by its name.

#include "app/panels/viewer_state.h"
#include "app/ui/widgets.h"

namespace candela {

/// A list of none and the scene's media; true when the name changed.
bool medium_field(Ui& ui, const ViewerState& state, const char* name, const char* label, std::string& medium,
                  std::string_view help);

} // namespace candela
