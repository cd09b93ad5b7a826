#pragma once

namespace quadrille::bench {

/// CPU seconds of all threads of this process so far, in the program and in the system for it.
double cpu_seconds();

/// The most memory that this process has held, in units of 10^6 bytes.
double peak_megabytes();

/// Does a fixed piece of image processing (Gaussian blurs by OpenCV) and returns its CPU seconds:
/// the unit that makes costs measured on different machines comparable.
double reference_work_seconds();

}  // namespace quadrille::bench
