#include "program.h"

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "command.h"
#include "interrupt.h"
#include "quadrille/error.h"

namespace quadrille::cli {
namespace {

/// Complains in exactly one line, whatever a file name or a message holds.
int complain(const char* name, std::string message, int exit_code) {
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  fmt::print(stderr, "{}: {}\n", name, message);
  return exit_code;
}

}  // namespace

int run_program(const char* name, const std::function<int()>& work) {
  // libvips writes warnings about odd files on stderr, where we promise one line of our own.
  setenv("VIPS_WARNING", "0", /*overwrite=*/0);
  catch_interrupts();
  try {
    const int exit_code = work();
    if (std::fflush(stdout) != 0) {
      return complain(name, "cannot write to the standard output", kFailure);
    }
    return exit_code;
  } catch (const UsageError& error) {
    return complain(name, error.what(), kUsage);
  } catch (const Error& error) {
    const bool cancelled = error.code() == ErrorCode::cancelled;
    return complain(name, error.what(), cancelled ? 128 + interrupting_signal() : kFailure);
  } catch (const std::bad_alloc&) {
    return complain(name, "out of memory; try fewer quads, a smaller scale or a smaller picture",
                    kFailure);
  } catch (const std::exception& error) {
    return complain(name, fmt::format("unexpected failure: {}", error.what()), kFailure);
  }
}

}  // namespace quadrille::cli
