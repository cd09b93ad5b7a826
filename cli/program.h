#pragma once

#include <functional>

namespace quadrille::cli {

/// Runs a program's work and returns its exit code. Whatever it throws becomes exactly one line on
/// stderr that begins with the program's name, and the exit code that goes with it.
int run_program(const char* name, const std::function<int()>& work);

}  // namespace quadrille::cli
