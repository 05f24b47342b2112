#include "app/cli/cli.h"
#include "app/platform/streams.h"

int main(int argc, char** argv) {
  candela::prepare_streams();
  return candela::run_program(argc, argv);
}
