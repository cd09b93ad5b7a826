#include "process_cost.h"

#include <sys/resource.h>

#include <opencv2/imgproc.hpp>

namespace quadrille::bench {
namespace {

rusage usage() {
  rusage result{};
  getrusage(RUSAGE_SELF, &result);
  return result;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double cpu_seconds() {
  const rusage used = usage();
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double peak_megabytes() { return static_cast<double>(usage().ru_maxrss) * 1024 / 1e6; }

double reference_work_seconds() {
  constexpr int kBlurs = 300;
  const cv::Mat picture(256, 256, CV_32F, cv::Scalar(0.5));
  cv::Mat blurred;
  const double start = cpu_seconds();
  for (int i = 0; i < kBlurs; ++i) cv::GaussianBlur(picture, blurred, {}, 3);
  return cpu_seconds() - start;
}

}  // namespace quadrille::bench
