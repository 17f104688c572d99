// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/read_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

Cell cell_with_platform() {
  Cell cell = test_cell();
  cell.platform = Platform{};
  cell.platform->pivot_mm = {0, 0, 600};
  return cell;
}

Vec6 error_of(const PlatformReading& reading, const Cell& cell) {
  const double told_s = reading.time_s - cell.platform->read_out.latency_s;
  return difference(reading.base_from_body, true_reading(cell, told_s).base_from_body);
}

TEST(SimulateReadOut, WithoutErrorsTellsWhereThePlatformWasOneLatencyEarlier) {
  Cell cell = cell_with_platform();
  cell.platform->read_out = {0, 0, 0, 0, 0, 50, 0.03, 0};
  const auto readings = simulate_read_out(cell, 1);
  // Frames end at 99 / 20 Hz = 4.95 s; the last moment is told of 0.03 s later.
  ASSERT_EQ(readings.size(), 250U);
  EXPECT_DOUBLE_EQ(readings.back().time_s, 4.98);
  const RigidMotion base = tracker_from_base(cell);
  for (const PlatformReading& reading : readings) {
    const RigidMotion truth = pose_at(cell.movers[0].motion, reading.time_s - 0.03);
    EXPECT_LT(difference(base * reading.base_from_body, truth).norm(), 1e-9);
  }
}

TEST(SimulateReadOut, HasTheMeanErrorsOfFigures21And22AndTheCovarianceItStates) {
  Cell cell = cell_with_platform();
  cell.timing.frames = 2000;  // 100 s, 10,000 readings
  double rotation = 0, translation = 0, nees = 0;
  const auto readings = simulate_read_out(cell, 2);
  for (const PlatformReading& reading : readings) {
    const Vec6 error = error_of(reading, cell);
    rotation += deg_from_rad(error.head<3>().norm());
    const PlatformReading truth = true_reading(cell, reading.time_s);
    translation +=
        (reading.base_from_body * cell.platform->pivot_mm - truth.base_from_body * cell.platform->pivot_mm)
            .norm();
    nees += error.dot(*solve_positive(truth.covariance, error));
  }
  const double count = static_cast<double>(readings.size());
  EXPECT_NEAR(rotation / count, 0.055, 0.001);  // the mean's own noise is 0.0003
  EXPECT_NEAR(translation / count, 0.309, 0.005);
  EXPECT_NEAR(nees / count, 6, 0.15);  // σ of the mean of 10,000 χ² with six degrees: 0.035; jumps add
}

TEST(SimulateReadOut, KeepsItsNoiseForTheCorrelationTime) {
  Cell cell = cell_with_platform();
  cell.timing.frames = 20000;  // 1,000 s, so 2,000 correlation times
  cell.platform->read_out.jump_share = 0;
  cell.platform->read_out.correlation_s = 0.5;
  const auto readings = simulate_read_out(cell, 3);
  double square = 0, product = 0;  // of neighbours one correlation time apart
  for (std::size_t i = 50; i < readings.size(); ++i) {
    const Vec6 here = error_of(readings[i], cell);
    square += here.head<3>().squaredNorm();
    product += here.head<3>().dot(error_of(readings[i - 50], cell).head<3>());
  }
  EXPECT_NEAR(product / square, std::exp(-1.0), 0.05);  // σ about √(2 · 0.5 s / (3 · 1,000 s)) = 0.018
  EXPECT_TRUE(readings[0].correlated.isApprox(readings[0].covariance));
}

TEST(SimulateReadOut, MakesTheSameReadingsFromTheSameSeedAndOthersFromAnother) {
  const Cell cell = cell_with_platform();
  const auto once = simulate_read_out(cell, 7), again = simulate_read_out(cell, 7);
  const auto other = simulate_read_out(cell, 8);
  EXPECT_EQ(once[5].base_from_body.translation, again[5].base_from_body.translation);
  EXPECT_NE(once[5].base_from_body.translation, other[5].base_from_body.translation);
}

TEST(SimulateReadOut, SaysThatACellWithoutPlatformHasNone) {
  try {
    static_cast<void>(simulate_read_out(test_cell(), 1));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "test cell: has no [platform]; there is no read-out to simulate");
  }
  Cell cell = cell_with_platform();
  cell.platform->body = "table";
  EXPECT_THROW(static_cast<void>(simulate_read_out(cell, 1)), InputError);
}

}  // namespace
}  // namespace asterism
