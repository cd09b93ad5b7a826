#pragma once

#include <functional>
#include <nlohmann/json.hpp>

namespace quadrille::bench {

/// Runs the measurement in a process of its own, so that its peak memory is its own and a crash
/// ends nothing else, and returns what it returned; `error` and nothing else when it failed. The
/// calling process must not have started threads.
nlohmann::ordered_json run_in_own_process(const std::function<nlohmann::ordered_json()>& measure);

}  // namespace quadrille::bench
