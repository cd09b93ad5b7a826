#include "display.h"

#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

#include "quadrille/error.h"

namespace quadrille::viewer {

void check_display() {
  if (Display* display = XOpenDisplay(nullptr)) {
    XCloseDisplay(display);
    return;
  }
  const char* name = std::getenv("DISPLAY");
  const std::string reason = name && *name
                                 ? "the display '" + std::string(name) + "' cannot be opened"
                                 : "there is no display (DISPLAY is not set)";
  throw Error(ErrorCode::io_failure,
              reason + "; start an X server, or put 'xvfb-run -a' before the command");
}

}  // namespace quadrille::viewer
