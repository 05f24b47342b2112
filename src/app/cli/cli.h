#pragma once
// Parsing of the command line. Each command is implemented in a file of its own.

namespace candela {

/// Runs the program; returns its exit code (core/error.h). Results go to stdout, everything else to stderr.
int run_program(int argc, char** argv);

} // namespace candela
