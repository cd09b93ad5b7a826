#include "interrupt.h"

#include <csignal>
#include <initializer_list>

namespace quadrille::cli {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void remember(int signal) {
  g_signal = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  // A file over the user's limit is then an error like a full disk, which leaves nothing behind.
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // Whoever started us ignoring it (nohup, a background job) wants that kept.
    if (std::signal(signal, remember) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

int interrupting_signal() { return g_signal; }

}  // namespace quadrille::cli
