#include "imaging/view.h"

namespace candela {

bool is_scalar_view(View view) {
  switch (view) {
  case View::depth:
  case View::optical_depth:
  case View::bvh_cost:
  case View::light_share:
  case View::variance:
  case View::samples:
  case View::nonfinite: return true;
  default: return false;
  }
}

} // namespace candela
