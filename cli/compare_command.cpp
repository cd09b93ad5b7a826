#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "common_options.h"
#include "picture_input.h"
#include "quadrille/error.h"
#include "quadrille/metrics.h"

namespace quadrille::cli {
namespace {

struct CompareRequest {
  std::filesystem::path a, b;
  double max_mae = -1;
  bool json = false;
};

void print(const ImageDifference& difference, bool json) {
  if (json) {
    const nlohmann::ordered_json values = {{"mae", difference.mae},
                                           {"psnr", difference.psnr},
                                           {"ssim", difference.ssim},
                                           {"max_error", difference.max_error}};
    fmt::print("{}\n", values.dump());
  } else {
    const std::string ssim = std::isnan(difference.ssim) ? "undefined below 7 x 7 pixels"
                                                         : fmt::format("{:.5f}", difference.ssim);
    fmt::print("MAE  {:.4f}\nPSNR {:.3f} dB\nSSIM {}\n", difference.mae, difference.psnr, ssim);
  }
}

int run_compare(const CompareRequest& request) {
  Observer observer(Verbosity::quiet, 0);
  const Raster a = read_raster(request.a, observer);
  const Raster b = read_raster(request.b, observer);
  if (a.width != b.width || a.height != b.height) {
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("'{}' has {} x {} pixels but '{}' has {} x {}; compare pictures of the "
                    "same size",
                    request.a.string(), a.width, a.height, request.b.string(), b.width, b.height));
  }
  const ImageDifference difference = compare(a, b);
  print(difference, request.json);
  if (request.max_mae >= 0 && difference.mae > request.max_mae) {
    fmt::print(stderr, "quadrille: the MAE of {:.4f} is above {}\n", difference.mae,
               request.max_mae);
    return kFailure;
  }
  return kSuccess;
}

}  // namespace

Action declare_compare(CLI::App& parser) {
  const auto request = std::make_shared<CompareRequest>();
  parser.add_option("A", request->a, "picture, or file of patches drawn at scale 1")
      ->required()
      ->type_name("FILE");
  parser.add_option("B", request->b, "picture or file of patches of the same size")
      ->required()
      ->type_name("FILE");
  parser.add_option("--max-mae", request->max_mae, "fail when the MAE (0 to 255) is above this")
      ->check(number_from(0, 255))
      ->type_name("X");
  parser.add_flag("--json", request->json, "print one JSON object");
  return [request] { return run_compare(*request); };
}

}  // namespace quadrille::cli
