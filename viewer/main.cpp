#include "program.h"
#include "view_command.h"

int main(int argc, char** argv) {
  return quadrille::cli::run_program("quadrille-view", [&] {
    return quadrille::viewer::run_view({argv + 1, argv + argc});
  });
}
