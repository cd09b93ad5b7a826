#include "background_run.h"

#include <gtest/gtest.h>

#include "support/torn_meshes.h"

namespace quadrille::viewer {
namespace {

RunRequest request_for(int quads) {
  const auto painter = [](double x, double y) {
    return Eigen::Array4d(0.5 + 0.4 * std::sin(0.2 * x), 0.5, x * y > 700 ? 0.2 : 0.9, 1);
  };
  RunRequest request;
  request.source =
      std::make_shared<const Raster>(testing::paint_box_filtered(64, 48, 3, 2, painter));
  request.options.quads = quads;
  return request;
}

TEST(BackgroundRun, GivesWhatVectorizeGives) {
  BackgroundRun run;
  const RunRequest request = request_for(60);
  run.start(request);
  run.wait();
  const auto result = run.take();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->error, "");
  const VectorImage expected = vectorize(*request.source, request.options).image;
  EXPECT_EQ(result->image->layers[0].patches.mesh.vertices,
            expected.layers[0].patches.mesh.vertices);
  EXPECT_FALSE(run.take()) << "once";
}

TEST(BackgroundRun, OnlyTheNewestRequestCounts) {
  BackgroundRun run;
  for (const int quads : {400, 300, 40}) run.start(request_for(quads));
  run.wait();
  const auto result = run.take();
  ASSERT_TRUE(result);
  EXPECT_LE(result->image->patch_count(), 80);
}

TEST(BackgroundRun, GivesNothingWhenCancelled) {
  BackgroundRun run;
  run.start(request_for(400));
  run.cancel();
  EXPECT_FALSE(run.progress().running);
  run.wait();
  EXPECT_FALSE(run.take());
}

TEST(BackgroundRun, TellsWhatWentWrong) {
  BackgroundRun run;
  RunRequest request = request_for(60);
  request.options.quads = 0;
  run.start(request);
  run.wait();
  const auto result = run.take();
  ASSERT_TRUE(result);
  EXPECT_NE(result->error, "");
  EXPECT_FALSE(result->image);
}

TEST(BackgroundRun, EndsInTheMiddleOfARun) {
  BackgroundRun run;
  run.start(request_for(400));
}

}  // namespace
}  // namespace quadrille::viewer
