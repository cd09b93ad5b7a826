#pragma once

#include <optional>

namespace quadrille {

/// One-dimensional search for the number of quads whose error meets a bound. The error is taken for
/// a falling power of the number, which it is but for jitter.
class ErrorSearch {
 public:
  ErrorSearch(double bound, int max_quads) : bound_(bound), max_quads_(max_quads) {}

  void observe(int quads, double error);

  /// The number to try after the one observed last; nothing when the search is over.
  std::optional<int> next() const;

 private:
  struct Point {
    double log_quads = 0, log_error = 0;
  };

  /// Where the power law through the points reaches the middle of the accepted band.
  double predicted() const;
  double target() const;

  double bound_;
  int max_quads_;
  int last_quads_ = 0;
  double last_error_ = 0;
  std::optional<Point> above_, below_;    ///< nearest points on both sides of the bound
  std::optional<Point> last_, previous_;  ///< the points observed last
};

}  // namespace quadrille
