#include "command.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace quadrille::cli {
namespace {

constexpr std::array<Command, 6> kCommands = {{
    {"vectorize", "Turn a picture into patches and write them in any of the formats",
     declare_vectorize},
    {"export", "Write patches from a .quad, .vtu or .vtm file in other formats", declare_export},
    {"render", "Draw a document or a picture at any scale, whole or a region", declare_render},
    {"inspect", "Draw a stage of the computation over the faded picture, or write all to .vtm",
     declare_inspect},
    {"compare", "Print how far two pictures are apart: MAE, PSNR, SSIM", declare_compare},
    {"info", "Print what a .quad, .vtu or .vtm file holds", declare_info},
}};

bool is_command(const std::string& word) {
  return word == "help" || std::ranges::any_of(kCommands, [&](const Command& command) {
           return word == command.name;
         });
}

/// `quadrille IN -o OUT` is short for `quadrille vectorize IN -o OUT`. A word that can be no file
/// stays, so that a misspelt sub-command is told from a missing picture.
bool is_short_form(const std::string& first) {
  if (is_command(first) || first == "-h" || first == "--help" || first == "--version") return false;
  std::error_code ignored;
  return first.starts_with('-') || first.find_first_of("./") != std::string::npos ||
         std::filesystem::exists(first, ignored);
}

std::string help_hint(const std::string& command) {
  return "see 'quadrille help" + (command.empty() ? "" : " " + command) + "'";
}

int explain(const CLI::App& parser, const std::vector<std::string>& arguments) {
  std::string topic = arguments.size() > 1 ? arguments[1] : "";
  if (topic == "-h" || topic == "--help") topic = "help";
  if (arguments.size() > 2 || (!topic.empty() && !is_command(topic))) {
    const std::string words = arguments[1] + (arguments.size() > 2 ? " " + arguments[2] : "");
    throw UsageError("there is no sub-command '" + words + "'; " + help_hint(""));
  }
  const bool general = topic.empty() || topic == "help";
  fmt::print("{}", general ? parser.help() : parser.get_subcommand(topic)->help("quadrille"));
  return kSuccess;
}

}  // namespace

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  while (text.ends_with(' ') || text.ends_with('.')) text.pop_back();
  return text;
}

int run_command(std::vector<std::string> arguments) {
  CLI::App parser("Raster pictures to smooth-shaded quads (bicubic patches), drawn at any scale.",
                  "quadrille");
  parser.set_version_flag("--version", "quadrille " QUADRILLE_VERSION);
  parser.footer("'quadrille IN -o OUT' is short for 'quadrille vectorize IN -o OUT'.");
  parser.require_subcommand(1);

  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const Command& command : kCommands) {
    CLI::App* sub = parser.add_subcommand(command.name, command.summary);
    sub->footer("");
    actions.emplace_back(sub, command.declare(*sub));
  }
  parser.add_subcommand("help", "Explain a sub-command: quadrille help SUBCOMMAND");

  if (arguments.empty()) throw UsageError("no picture and no sub-command; " + help_hint(""));
  if (is_short_form(arguments.front())) {
    arguments.insert(arguments.begin(), "vectorize");
  } else if (!is_command(arguments.front()) && !arguments.front().starts_with('-')) {
    throw UsageError("'" + arguments.front() + "' is neither a sub-command nor a file; " +
                     help_hint(""));
  }

  if (arguments.front() == "help") return explain(parser, arguments);

  const std::string chosen = is_command(arguments.front()) ? arguments.front() : "";
  try {
    std::ranges::reverse(arguments);  // the order in which the parser takes them
    parser.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      parser.exit(error);  // prints the help or the version
      return kSuccess;
    }
    throw UsageError(one_line(error.what()) + "; " + help_hint(chosen));
  }

  for (const auto& [sub, action] : actions) {
    if (sub->parsed()) return action();
  }
  return kSuccess;
}

}  // namespace quadrille::cli
