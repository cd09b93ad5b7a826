#pragma once

#include <vector>

namespace quadrille {

/// Finds how many lattice cells to ask for so that the wished number of quads comes out. More cells
/// give more quads on the whole, but not steadily: points merge, whole rows come and go.
class CountCalibration {
 public:
  CountCalibration(int wished, double first_guess);

  double cells() const { return cells_; }
  /// Tells how many quads cells() gave and chooses the next cells().
  void observe(int quads);

 private:
  struct Trial {
    double log_cells, log_quads;
  };
  double log_wished_;
  double cells_;
  std::vector<Trial> trials_;

  double next_guess() const;
  double apart_from_trials(double guess) const;
};

}  // namespace quadrille
