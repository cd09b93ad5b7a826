// Whatever the picture and the number of quads: a valid mesh of that number of well-shaped quads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "adversarial_pictures.h"
#include "quadrille/image_file.h"
#include "quadrille/vectorize.h"

namespace quadrille {
namespace test {

void PrintTo(const PictureFamily& family, std::ostream* stream) { *stream << family.name; }

}  // namespace test

namespace {

constexpr int kPicturesPerFamily = 100;
constexpr int kCountedFrom = 200;  // quads
constexpr double kCountTolerance = 0.05;
constexpr double kSmallestJacobian = 0.15;

/// What is wrong, as words that name the picture.
struct Complaints {
  std::vector<std::string> thrown, invalid, fallback, count, shape;
};

/// The documented reasons for the lattice: the picture is smaller than 4 quads a side, or its quads
/// are smaller than a pixel.
bool may_fall_back(const Raster& picture, int quads) {
  const double edge = std::sqrt(static_cast<double>(picture.width) * picture.height / quads);
  return edge < 1 || 4 * edge > std::min(picture.width, picture.height);
}

double smallest_jacobian(const QuadMesh& mesh) {
  double smallest = 1;
  for (int q = 0; q < mesh.quad_count(); ++q) {
    smallest = std::min(smallest, scaled_jacobian(mesh, q));
  }
  return smallest;
}

void examine(const Raster& picture, int quads, const std::string& number, Complaints& complaints) {
  const std::string name = number + " (" + std::to_string(picture.width) + "x" +
                           std::to_string(picture.height) + " at " + std::to_string(quads) + ")";
  Quadrangulation result;
  try {
    result = quadrangulate(picture, {.quads = quads});
  } catch (const std::exception& error) {
    complaints.thrown.push_back(name + ": " + error.what());
    return;
  }
  const auto violations = validate(result.mesh, picture.width, picture.height);
  if (!violations.empty()) complaints.invalid.push_back(name + ": " + violations.front().what);
  if (result.fallback) {
    if (!may_fall_back(picture, quads)) complaints.fallback.push_back(name);
    return;
  }
  const int made = result.mesh.quad_count();
  if (quads >= kCountedFrom && std::abs(made - quads) > kCountTolerance * quads) {
    complaints.count.push_back(name + ": " + std::to_string(made));
  }
  const double jacobian = smallest_jacobian(result.mesh);
  if (jacobian < kSmallestJacobian) {
    complaints.shape.push_back(name + ": " + std::to_string(jacobian));
  }
}

void expect_none(const Complaints& complaints) {
  using testing::IsEmpty;
  EXPECT_THAT(complaints.thrown, IsEmpty());
  EXPECT_THAT(complaints.invalid, IsEmpty());
  EXPECT_THAT(complaints.fallback, IsEmpty()) << "lattice without a documented reason";
  EXPECT_THAT(complaints.count, IsEmpty()) << "number of quads off";
  EXPECT_THAT(complaints.shape, IsEmpty()) << "smallest scaled Jacobian too small";
}

class AdversarialFamily : public testing::TestWithParam<test::PictureFamily> {};

TEST_P(AdversarialFamily, AlwaysEndsInAGoodMesh) {
  std::seed_seq seed(GetParam().name.begin(), GetParam().name.end());
  std::mt19937 random(seed);
  Complaints complaints;
  for (int i = 0; i < kPicturesPerFamily; ++i) {
    const int smallest = i % 10 ? 16 : 1;
    const int w = test::log_uniform(random, smallest, 160);
    const int h = test::log_uniform(random, smallest, 160);
    const int quads = test::log_uniform(random, 4, 3000);
    const Raster picture = GetParam().draw(random, w, h);
    examine(picture, quads, "#" + std::to_string(i), complaints);
  }
  expect_none(complaints);
}

INSTANTIATE_TEST_SUITE_P(Pictures, AdversarialFamily,
                         testing::ValuesIn(test::adversarial_families().begin(),
                                           test::adversarial_families().end()),
                         [](const auto& family) { return family.param.name; });

class QuadBudget : public testing::TestWithParam<int> {};

TEST_P(QuadBudget, IsMetOnASample) {
  Complaints complaints;
  examine(load_image(std::filesystem::path(QUADRILLE_SOURCE_DIR) /
                     "samples/pictures/animal_chelsea.png"),
          GetParam(), "chelsea", complaints);
  expect_none(complaints);
}

INSTANTIATE_TEST_SUITE_P(From4To100000, QuadBudget,
                         testing::Values(4, 20, 200, 1000, 3000, 10'000, 30'000, 100'000),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace quadrille
