#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille::test {

/// Runs a program found on PATH with these arguments, without a shell, and waits for it. `output`,
/// when given, receives what it wrote to standard output and standard error. Returns its exit
/// status, 128 + n when signal n ended it, 127 when it could not be started.
int run(const std::vector<std::string>& argv, std::string* output = nullptr);

/// True when a program of this name is on PATH; tests of optional programs skip without it.
bool has_program(const std::string& name);

/// A folder of this process for the files of its tests, made on the first call. It is removed at
/// the end of the process unless a test failed, so that what a failure wrote can be looked at.
std::filesystem::path scratch_dir();

}  // namespace quadrille::test
