#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "command.h"
#include "interrupt.h"
#include "quadrille/error.h"

namespace {

/// Complains in exactly one line, whatever a file name or a message holds.
int complain(std::string message, int exit_code) {
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  fmt::print(stderr, "quadrille: {}\n", message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace quadrille::cli;
  // libvips writes warnings about odd files on stderr, where we promise one line of our own.
  setenv("VIPS_WARNING", "0", /*overwrite=*/0);
  catch_interrupts();
  try {
    const int exit_code = run_command({argv + 1, argv + argc});
    if (std::fflush(stdout) != 0) return complain("cannot write to the standard output", kFailure);
    return exit_code;
  } catch (const UsageError& error) {
    return complain(error.what(), kUsage);
  } catch (const quadrille::Error& error) {
    const bool cancelled = error.code() == quadrille::ErrorCode::cancelled;
    return complain(error.what(), cancelled ? 128 + interrupting_signal() : kFailure);
  } catch (const std::bad_alloc&) {
    return complain("out of memory; try fewer quads, a smaller scale or a smaller picture",
                    kFailure);
  } catch (const std::exception& error) {
    return complain(fmt::format("unexpected failure: {}", error.what()), kFailure);
  }
}
