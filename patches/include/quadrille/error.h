#pragma once

#include <stdexcept>
#include <string>

namespace quadrille {

enum class ErrorCode {
  invalid_argument,    ///< a value the caller passed is outside its documented range
  unsupported_format,  ///< a file is of a kind, or uses a feature, that we do not read or write
  io_failure,          ///< the operating system or a file's content stopped us
  degenerate_input,    ///< well-formed input that has no meaningful result
  numerical_failure,   ///< an invariant did not hold after a computation; a bug worth reporting
  cancelled,           ///< RunContext::on_progress returned false
  limit_exceeded,      ///< input larger than a documented limit
};

/// The only exception type that leaves the library. Messages are one sentence in plain English:
/// what was wrong, with which value, and what to do next.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace quadrille
