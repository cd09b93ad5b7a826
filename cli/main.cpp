#include "command.h"
#include "program.h"

int main(int argc, char** argv) {
  using namespace quadrille::cli;
  return run_program("quadrille", [&] { return run_command({argv + 1, argv + argc}); });
}
