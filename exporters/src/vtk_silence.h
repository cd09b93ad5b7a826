#pragma once

#include <vtkCommand.h>

namespace quadrille {

/// Keeps VTK's messages from the terminal: an object with an error observer does not print them.
class SilentObserver : public vtkCommand {
 public:
  static SilentObserver* New() { return new SilentObserver; }
  void Execute(vtkObject*, unsigned long, void*) override { ++errors; }

  int errors = 0;
};

}  // namespace quadrille
