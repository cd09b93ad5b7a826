#pragma once

namespace quadrille::cli {

/// From now on Ctrl-C, a polite kill and the end of the terminal only set a flag, so that the run
/// stops at its next step and tidies up. A second one ends the program at once.
void catch_interrupts();

/// The number of the signal that asked to stop, 0 when none did.
int interrupting_signal();

}  // namespace quadrille::cli
