#pragma once

#include <optional>

#include "document_quantization.h"

namespace quadrille {

/// How finely a layer is quantised.
struct QuantizationSteps {
  int position_exponent = 0;  ///< positions are multiples of 2^-exponent pixels
  float color = 0;            ///< see ColorSteps; 1 is white
  bool operator==(const QuantizationSteps&) const = default;
};

/// Steps that are given, or that the picture decides.
struct StepChoice {
  std::optional<int> position_exponent;
  std::optional<float> color;
  double error = 0;  ///< wished mean absolute error of the picture, for what is not given

  /// The finest steps that may be chosen.
  QuantizationSteps finest() const;
};

/// Patches in integers and what these stand for.
struct SteppedPatches {
  QuantizedPatches patches;
  QuantizationSteps steps;
};

/// Patches that are multiples of such steps already keep their integers. Others get integers with
/// which they draw nearly the same picture, in the fewest bits known: vertices are rounded, colours
/// are fitted to the moved vertices and rounded. Patches that were certified free of folds stay so:
/// where rounding takes the proof away, tangents are drawn toward their chords.
SteppedPatches quantize(const PatchMesh& patches, double width, double height,
                        const StepChoice& choice);

}  // namespace quadrille
