#pragma once

#include <vector>

#include "quadrille/feature_tensor.h"
#include "quadrille/planar_loops.h"
#include "quadrille/working_picture.h"

namespace quadrille {

/// Takes the features outside of an outline (source pixels) away and makes the outline one: the
/// strongest feature line, and FeatureTensor::outline.
void confine_features(FeatureTensor& features, const std::vector<Loop>& outline,
                      const WorkingPicture& working);

}  // namespace quadrille
