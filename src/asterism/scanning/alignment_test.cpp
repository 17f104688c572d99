// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"
#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

const RigidMotion kTruth = {exp_rotation({0.3, -0.2, 1.1}), {120, -40, 600}};
constexpr double kSigma_mm = 0.02;

Vec3 noise(RandomStream& random) {
  const double x = random.normal(), y = random.normal();
  return kSigma_mm * Vec3(x, y, random.normal());
}

/// A block of 200 × 120 × 80 mm with its corner at the origin.
TriangleMesh block(double x = 200, double y = 120, double z = 80) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Six faces of the block: places on each.
std::vector<Vec3> places_on_block() {
  return {{20, 20, 0},    {180, 30, 0}, {100, 100, 0}, {30, 0, 40},    {170, 0, 30},
          {0, 60, 40},    {0, 20, 20},  {200, 50, 60}, {200, 100, 20}, {60, 120, 50},
          {150, 120, 20}, {50, 40, 80}, {150, 90, 80}};
}

std::vector<ProbedPoint> probed(const std::vector<Vec3>& places, const std::vector<std::string>& names,
                                std::uint64_t draw, double share = 1) {
  RandomStream random(17, draw);
  std::vector<ProbedPoint> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ProbedPoint point;
    if (!names.empty()) point.name = names[i];
    point.in_platform = kTruth * places[i] + share * noise(random);
    point.covariance = kSigma_mm * kSigma_mm * Mat3::Identity();
    points.push_back(point);
  }
  return points;
}

double nees(const Alignment& alignment) {
  const Vec6 error = difference(alignment.platform_from_workpiece, kTruth);
  return error.dot(*solve_positive(alignment.covariance, error));
}

const std::vector<std::string> kNames = {"a", "b", "c", "d"};
const std::vector<Vec3> kNominal = {{0, 0, 0}, {200, 0, 0}, {0, 120, 10}, {200, 120, 80}};
std::vector<NominalPoint> nominal() {
  std::vector<NominalPoint> points;
  for (std::size_t i = 0; i < kNames.size(); ++i) points.push_back({kNames[i], kNominal[i]});
  return points;
}

DatumPlanes datums() { return {{{0, 0, 0}, {0, 0, -1}}, {{0, 0, 0}, {0, -1, 0}}, {{0, 0, 0}, {-1, 0, 0}}}; }
const std::vector<std::string> kDatums = {"primary",   "primary",   "primary",
                                          "secondary", "secondary", "tertiary"};
std::vector<Vec3> datum_places() {
  const std::vector<Vec3> all = places_on_block();
  return {all.begin(), all.begin() + 6};
}

TEST(AlignPoints, FindsThePartAndStatesItHonestly) {
  const Alignment exact = align_points(probed(kNominal, kNames, 0, 0), nominal());
  EXPECT_LT(difference(exact.platform_from_workpiece, kTruth).norm(), 1e-9);
  constexpr int kDraws = 2000;
  double sum = 0, chi2 = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Alignment alignment =
        align_points(probed(kNominal, kNames, static_cast<std::uint64_t>(draw)), nominal());
    sum += nees(alignment) / kDraws;
    chi2 += alignment.chi2 / kDraws;
  }
  EXPECT_NEAR(sum, 6, 0.24);   // three sigmas: 3 √(12/2000)
  EXPECT_NEAR(chi2, 6, 0.24);  // twelve coordinates less six
}

TEST(AlignPoints, RefusesWhatDoesNotBelongTogether) {
  auto points = probed(kNominal, kNames, 0);
  points[1].name = "z";
  EXPECT_TELLS(input_error_of([&] { return align_points(points, nominal()).points; }),
               "no nominal point is called `z`");
  points[1].name = "a";
  EXPECT_TELLS(input_error_of([&] { return align_points(points, nominal()).points; }), "`a` is probed twice");
  points.resize(1);
  EXPECT_TELLS(input_error_of([&] { return align_points(points, nominal()).points; }),
               "three points at least");
}

TEST(Align321, FindsThePartAndStatesItHonestly) {
  const Alignment exact = align_3_2_1(probed(datum_places(), kDatums, 0, 0), datums());
  EXPECT_LT(difference(exact.platform_from_workpiece, kTruth).norm(), 1e-9);
  constexpr int kDraws = 2000;
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    sum += nees(align_3_2_1(probed(datum_places(), kDatums, static_cast<std::uint64_t>(draw)), datums())) /
           kDraws;
  }
  EXPECT_NEAR(sum, 6, 0.24);
}

TEST(Align321, TakesTheProbesBallIntoAccount) {
  std::vector<Vec3> places = datum_places();
  const Vec3 out[] = {-Vec3::UnitZ(), -Vec3::UnitZ(), -Vec3::UnitZ(),
                      -Vec3::UnitY(), -Vec3::UnitY(), -Vec3::UnitX()};
  for (std::size_t i = 0; i < places.size(); ++i) places[i] += 1.5 * out[i];
  const Alignment alignment = align_3_2_1(probed(places, kDatums, 0, 0), datums(), 1.5);
  EXPECT_LT(difference(alignment.platform_from_workpiece, kTruth).norm(), 1e-9);
}

TEST(Align321, GivesThePrimaryPlaneItsPointsFirst) {
  // Four points on the first plane; errors of the other planes' points do not turn it.
  std::vector<Vec3> places = datum_places();
  std::vector<std::string> names = kDatums;
  places.emplace_back(20, 100, 0);
  names.emplace_back("primary");
  auto points = probed(places, names, 0, 0);
  points[3].in_platform += 0.5 * (kTruth.rotation * Vec3(1, 1, 1));
  const Alignment alignment = align_3_2_1(points, datums());
  const Vec3 normal = alignment.platform_from_workpiece.rotation * Vec3::UnitZ();
  EXPECT_LT((normal - kTruth.rotation * Vec3::UnitZ()).norm(), 1e-9);
}

TEST(Align321, NamesWhatIsMissing) {
  auto points = probed(datum_places(), kDatums, 0);
  points.pop_back();
  EXPECT_TELLS(input_error_of([&] { return align_3_2_1(points, datums()).points; }),
               "the tertiary plane needs 1 points");
  points[0].name = "top";
  EXPECT_TELLS(input_error_of([&] { return align_3_2_1(points, datums()).points; }),
               "`top` is no datum plane");
  DatumPlanes flat = datums();
  flat.tertiary = flat.primary;
  EXPECT_TELLS(input_error_of([&] { return align_3_2_1(probed(datum_places(), kDatums, 0), flat).points; }),
               "leave a motion free");
}

TEST(AlignBestFit, FindsThePartAndStatesItHonestly) {
  const SurfaceTree surface(block());
  const std::vector<RigidMotion> starts = {
      perturbed(kTruth, (Vec6() << 0.03, 0.02, -0.03, 4, -3, 5).finished())};
  constexpr int kDraws = 500;
  double sum = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Alignment alignment =
        align_best_fit(probed(places_on_block(), {}, static_cast<std::uint64_t>(draw)), surface, starts, {});
    sum += nees(alignment) / kDraws;
    EXPECT_TRUE(alignment.not_determined.empty());
  }
  EXPECT_NEAR(sum, 6, 0.47);  // three sigmas: 3 √(12/500)
}

TEST(AlignBestFit, TellsWhichMotionsACylinderLeavesFree) {
  const SurfaceTree surface(surface_of_revolution({{50, -100}, {50, 100}, {0, 100}, {0, -100}}, 720));
  std::vector<Vec3> places;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.9 * i;
    places.emplace_back(50 * std::cos(angle), 50 * std::sin(angle), 6 * (i - 12));
  }
  const std::vector<RigidMotion> starts = {perturbed(kTruth, (Vec6() << 0.01, 0.01, 0, 1, 1, 0).finished())};
  const Alignment alignment = align_best_fit(probed(places, {}, 3), surface, starts, {});
  ASSERT_EQ(alignment.not_determined.size(), 2u);
  std::string told = alignment.not_determined[0] + "; " + alignment.not_determined[1];
  EXPECT_TELLS(told, "a turn about the axis (0.00, 0.00, 1.00) through (0, 0,");
  EXPECT_TELLS(told, "slide along");
  // What is determined is right: the axis.
  const Vec3 axis = alignment.platform_from_workpiece.rotation * Vec3::UnitZ();
  EXPECT_LT((axis - kTruth.rotation * Vec3::UnitZ()).norm(), 1e-3);
}

TEST(AlignBestFit, RefusesAPartThatFitsInTwoWays) {
  // A block turned by half about its middle is the same block.
  const SurfaceTree surface(block());
  const RigidMotion half = rotation_about({100, 60, 40}, exp_rotation({0, 0, std::numbers::pi}));
  const std::vector<RigidMotion> starts = {kTruth, kTruth * half};
  try {
    (void)align_best_fit(probed(places_on_block(), {}, 1), surface, starts, {});
    FAIL() << "told one of two";
  } catch (const MeasurementError& error) {
    EXPECT_TELLS(std::string(error.what()), "fits in two ways that differ by a turn of 180.0°");
  }
}

TEST(AlignBestFit, TellsWhenNoStartIsNear) {
  const SurfaceTree surface(block());
  const std::vector<RigidMotion> starts = {{Quaternion::Identity(), {9000, 0, 0}}};
  EXPECT_THROW((void)align_best_fit(probed(places_on_block(), {}, 1), surface, starts, {}), MeasurementError);
}

}  // namespace
}  // namespace asterism
