#pragma once

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <string>

#include "quadrille/error.h"

namespace quadrille::bench {

/// False when the file cannot be written; without a name there is nothing to do.
bool write_json(const nlohmann::ordered_json& json, const std::string& file);

/// Exit code of a program whose `run` tells whether all went well; errors go to standard error.
template <class Run>
int exit_code(const Run& run) {
  try {
    return run() ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace quadrille::bench
