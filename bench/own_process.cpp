#include "own_process.h"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace quadrille::bench {
namespace {

using Json = nlohmann::ordered_json;

Json caught(const std::function<Json()>& measure) {
  try {
    return measure();
  } catch (const std::exception& error) {
    return {{"error", error.what()}};
  }
}

}  // namespace

Json run_in_own_process(const std::function<Json()>& measure) {
  std::FILE* answer = std::tmpfile();
  if (!answer) throw std::runtime_error("cannot make a temporary file");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    const std::string text = caught(measure).dump(-1, ' ', false, Json::error_handler_t::replace);
    std::fwrite(text.data(), 1, text.size(), answer);
    std::fflush(answer);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  std::rewind(answer);
  std::string text;
  for (int c; (c = std::fgetc(answer)) != EOF;) text += static_cast<char>(c);
  std::fclose(answer);
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_discarded() && !json.is_null()) return json;
  return {{"error", WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                        : "gave no answer"}};
}

}  // namespace quadrille::bench
