#include "pixel_writer.h"

#include <algorithm>
#include <cmath>

#include "quadrille/error.h"

namespace quadrille {

PixelWriter::PixelWriter(const std::array<float, 4>& background, int channels)
    : channels_(channels) {
  for (int k = 0; k < 4; ++k) {
    if (!std::isfinite(background[k])) {
      throw Error(ErrorCode::invalid_argument,
                  "a background component is not a finite number; use values from 0 to 1");
    }
    behind_[k] = std::clamp(background[k], 0.0f, 1.0f);
  }
  behind_.head<3>() *= behind_[3];
}

}  // namespace quadrille
