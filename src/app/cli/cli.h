#pragma once
// The command line: what the words mean. Each command's work is in a file of its own.

namespace candela {

/// Runs the program; returns its exit code (core/error.h). Results go to stdout, everything else to stderr.
int run_program(int argc, char** argv);

} // namespace candela
