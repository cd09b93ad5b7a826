#pragma once

#include <string>
#include <vector>

namespace quadrille::viewer {

/// Parses and runs the arguments of `quadrille-view` (without the program's name); returns the exit
/// code. Throws cli::UsageError for a wrong command line, and Error.
int run_view(std::vector<std::string> arguments);

}  // namespace quadrille::viewer
