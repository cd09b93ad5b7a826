#pragma once

#include <string>

#include "support/run_program.h"

namespace quadrille::test {

/// VTK's Python module belongs to the distribution's interpreter, which need not be the first one.
/// Empty when none has it.
inline const std::string& python_with_vtk() {
  static const std::string found = [] {
    for (const std::string python : {"python3", "/usr/bin/python3"}) {
      if (run({python, "-c", "import vtkmodules.vtkIOXML"}) == 0) return python;
    }
    return std::string();
  }();
  return found;
}

}  // namespace quadrille::test
