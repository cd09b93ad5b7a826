#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace quadrille::cli {

/// Exit codes of the command.
inline constexpr int kSuccess = 0;
inline constexpr int kFailure = 1;
inline constexpr int kUsage = 2;

/// The command line itself is wrong: one line on stderr and exit code kUsage.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The parser's complaint as one line without its closing period.
std::string one_line(std::string text);

/// What a sub-command does once its options are parsed; returns the exit code.
using Action = std::function<int()>;

/// A sub-command: `declare` adds its options to the parser and returns what to run.
struct Command {
  const char* name;
  const char* summary;
  Action (*declare)(CLI::App& parser);
};

Action declare_vectorize(CLI::App& parser);
Action declare_export(CLI::App& parser);
Action declare_render(CLI::App& parser);
Action declare_inspect(CLI::App& parser);
Action declare_compare(CLI::App& parser);
Action declare_info(CLI::App& parser);

/// Parses and runs the arguments (without the program's name).
/// Throws UsageError for a wrong command line, besides whatever the sub-command throws.
int run_command(std::vector<std::string> arguments);

}  // namespace quadrille::cli
