#include "app/cli.h"
#include "app/streams.h"

int main(int argc, char** argv) {
  candela::prepare_streams();
  return candela::run_program(argc, argv);
}
