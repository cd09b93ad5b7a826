#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "quadrille/error.h"

namespace quadrille {

/// Calls work() and turns OpenCV's exceptions into ours.
template <class Work>
auto with_opencv_errors(const Work& work) {
  try {
    return work();
  } catch (const cv::Exception& error) {
    throw Error(ErrorCode::numerical_failure,
                "an image operation failed (" + error.err + "); report the picture");
  }
}

}  // namespace quadrille
