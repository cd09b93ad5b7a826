#include "display.h"

#include <X11/Xlib.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "quadrille/error.h"

namespace quadrille::viewer {

DisplayConnection::DisplayConnection() {
  constexpr int kTries = 10;
  constexpr std::chrono::milliseconds kPause{100};
  const char* name = std::getenv("DISPLAY");
  const bool named = name && *name;
  for (int i = 0; named && !display_ && i < kTries; ++i) {
    if (i > 0) std::this_thread::sleep_for(kPause);
    display_.reset(XOpenDisplay(nullptr));
  }
  if (display_) return;
  const std::string reason = named ? "the display '" + std::string(name) + "' cannot be opened"
                                   : "there is no display (DISPLAY is not set)";
  throw Error(ErrorCode::io_failure,
              reason + "; start an X server, or put 'xvfb-run -a' before the command");
}

DisplayConnection::~DisplayConnection() = default;

void DisplayConnection::Close::operator()(void* display) const {
  XCloseDisplay(static_cast<Display*>(display));
}

}  // namespace quadrille::viewer
