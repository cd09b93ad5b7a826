#pragma once

#include <string>
#include <vector>

namespace quadrille::test {

/// Runs a program found on PATH with these arguments, without a shell, and waits for it. `output`,
/// when given, receives what it wrote to standard output and standard error. Returns its exit
/// status, 128 + n when signal n ended it, 127 when it could not be started.
int run(const std::vector<std::string>& argv, std::string* output = nullptr);

/// True when a program of this name is on PATH; tests of optional programs skip without it.
bool has_program(const std::string& name);

}  // namespace quadrille::test
