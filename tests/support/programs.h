#pragma once

#include <filesystem>

#include "support/run_program.h"

namespace quadrille::test {

/// A folder of this process for the files of its tests, made on the first call. It is removed at
/// the end of the process unless a test failed, so that what a failure wrote can be looked at.
std::filesystem::path scratch_dir();

}  // namespace quadrille::test
