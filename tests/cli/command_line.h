#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille::test {

/// What a run of the built command left behind.
struct CommandResult {
  int exit_code = 0;
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs `quadrille` with these arguments; neither of its outputs is a terminal.
CommandResult quadrille(const std::vector<std::string>& arguments);

/// The same where no file may grow above `blocks` times 512 bytes (RLIMIT_FSIZE): more is refused
/// as on a full disk.
CommandResult quadrille_on_full_disk(int blocks, const std::vector<std::string>& arguments);

/// A file of samples/.
std::string sample(const std::string& name);

/// A fresh, empty folder inside the scratch folder.
std::filesystem::path fresh_folder(const std::string& name);

/// Names of the files in a folder, sorted.
std::vector<std::string> files_in(const std::filesystem::path& folder);

std::string bytes_of(const std::filesystem::path& file);

std::vector<std::string> join(std::vector<std::string> a, const std::vector<std::string>& b);

/// Exit code 0 and nothing said, not even by a progress bar, as outputs are no terminals.
void expect_silent_success(const CommandResult& result);

/// True for exactly one line that starts as our complaints do.
bool is_one_complaint(const std::string& err);

}  // namespace quadrille::test
