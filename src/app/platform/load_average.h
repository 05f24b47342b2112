#pragma once

#include <cstdlib>

namespace candela {

/// Mean number of running processes over the last minute; 0 if unknown.
inline double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

} // namespace candela
