#pragma once

#include <memory>

namespace quadrille::viewer {

/// A connection to the X display. VTK, which needs one even to draw off screen, would end the
/// program where there is none. Held as long as VTK draws: servers may start anew, and refuse
/// connections meanwhile, when their last client leaves.
class DisplayConnection {
 public:
  /// Tries for a second. Throws Error{io_failure} when no display can be opened.
  DisplayConnection();
  ~DisplayConnection();

 private:
  struct Close {
    void operator()(void* display) const;
  };
  std::unique_ptr<void, Close> display_;
};

}  // namespace quadrille::viewer
