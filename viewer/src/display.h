#pragma once

namespace quadrille::viewer {

/// Throws Error{io_failure} when no X display can be opened: VTK, which needs one even to draw
/// off screen, would end the program.
void check_display();

}  // namespace quadrille::viewer
