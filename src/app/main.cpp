#include "app/cli.h"

int main(int argc, char** argv) { return candela::run_program(argc, argv); }
