#pragma once
// The exit code of an action's error.

#include "core/error.h"

namespace candela::test {

/// The code of the Error that the action throws; `done` if it throws none.
template <class Action>
ExitCode code_of(Action action) {
  try {
    action();
  } catch (const Error& error) { return error.code(); }
  return ExitCode::done;
}

} // namespace candela::test
