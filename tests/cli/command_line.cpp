#include "command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "support/programs.h"

namespace quadrille::test {

namespace fs = std::filesystem;

namespace {

/// Runs the command in a shell after `prepare`.
CommandResult run_command(const std::string& prepare, const std::vector<std::string>& arguments) {
  const fs::path err = scratch_dir() / "stderr.txt";
  std::vector<std::string> argv = {
      "sh", "-c",         prepare + "err=$1; shift; exec \"$@\" 2>\"$err\"",
      "sh", err.string(), QUADRILLE_COMMAND};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  CommandResult result;
  result.exit_code = run(argv, &result.out);
  result.err = bytes_of(err);
  return result;
}

}  // namespace

CommandResult quadrille(const std::vector<std::string>& arguments) {
  return run_command("", arguments);
}

CommandResult quadrille_on_full_disk(int blocks, const std::vector<std::string>& arguments) {
  return run_command("ulimit -f " + std::to_string(blocks) + "; ", arguments);
}

std::string sample(const std::string& name) {
  return std::string(QUADRILLE_SOURCE_DIR) + "/samples/" + name;
}

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = scratch_dir() / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> join(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expect_silent_success(const CommandResult& result) {
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "");
}

bool is_one_complaint(const std::string& err) {
  return err.starts_with("quadrille: ") && err.ends_with('\n') &&
         std::ranges::count(err, '\n') == 1;
}

}  // namespace quadrille::test
