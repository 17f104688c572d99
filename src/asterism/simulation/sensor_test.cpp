// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/simulation/simulate.hpp"
#include "asterism/simulation/test_cell.hpp"

namespace asterism {
namespace {

Raster<float> even(int width, int height, float level) {
  Raster<float> light(width, height);
  std::fill(light.pixels.begin(), light.pixels.end(), level);
  return light;
}

struct MeanVariance {
  double mean = 0, variance = 0;
};

template <class Grey>
MeanVariance statistics_of(const Raster<Grey>& image) {
  double sum = 0, squares = 0;
  for (const Grey grey : image.pixels) {
    sum += grey;
    squares += static_cast<double>(grey) * grey;
  }
  const auto n = static_cast<double>(image.pixels.size());
  return {sum / n, squares / n - sum / n * (sum / n)};
}

TEST(Expose, FollowsTheMeanVarianceLineOfShotAndReadNoise) {
  Sensor sensor;
  sensor.bits = 16;
  const double grey_per_electron = 65535 / sensor.full_well_e;
  const Raster<float> gain = even(400, 300, 1);
  for (const float level : {0.02F, 0.1F, 0.3F, 0.8F}) {
    const Image image = expose(even(400, 300, level), gain, sensor, Side::Left, 5, 3);
    const MeanVariance found = statistics_of(std::get<Raster16>(image));
    const double electrons = level * sensor.full_well_e;
    const double variance = grey_per_electron * grey_per_electron * (electrons + 49);
    EXPECT_NEAR(found.mean, 65535 * (level + sensor.offset_level), 4 * std::sqrt(variance / 120000) + 0.01);
    EXPECT_NEAR(found.variance / variance, 1, 4 * std::sqrt(2.0 / 120000));
  }
}

TEST(Expose, RoundsToEightBitsAndStopsAtTheCeiling) {
  Sensor sensor;
  sensor.read_noise_e = 0;
  sensor.full_well_e = 1e9;  // as good as no shot noise
  const Raster<float> gain = even(20, 20, 1);
  const auto grey_of = [&](float level) {
    return std::get<Raster8>(expose(even(20, 20, level), gain, sensor, Side::Left, 1, 0)).at(7, 7);
  };
  EXPECT_EQ(grey_of(0), 4);  // the offset, 0.016 · 255 = 4.08
  EXPECT_EQ(grey_of((100.3F - 4.08F) / 255), 100);
  EXPECT_EQ(grey_of((100.7F - 4.08F) / 255), 101);
  EXPECT_EQ(grey_of(1.7F), 255);
}

TEST(FixedPattern, HasTheStatedSpreadAndIsTheCamerasOwn) {
  const Sensor sensor;
  const Lens lens = rig_of({400, 300, 1000, 500, 2000}).left;
  const Raster<float> left = fixed_pattern(sensor, lens, Side::Left, 1);
  const Raster<float> right = fixed_pattern(sensor, lens, Side::Right, 1);
  const MeanVariance found = statistics_of(left);
  EXPECT_NEAR(found.mean, 1, 4 * 0.004 / std::sqrt(120000.0));
  EXPECT_NEAR(std::sqrt(found.variance), 0.004, 4 * 0.004 / std::sqrt(240000.0));
  double together = 0;
  for (std::size_t i = 0; i < left.pixels.size(); ++i)
    together += (left.pixels[i] - 1.0) * (right.pixels[i] - 1.0);
  EXPECT_LT(std::abs(together / 120000) / found.variance, 4 / std::sqrt(120000.0));
}

TEST(Expose, DrawsNewNoiseForEachFrameAndRow) {
  const Sensor sensor;
  const Raster<float> light = even(200, 50, 0.5F);
  const Raster<float> gain = even(200, 50, 1);
  const auto first = std::get<Raster8>(expose(light, gain, sensor, Side::Left, 1, 0));
  const auto next = std::get<Raster8>(expose(light, gain, sensor, Side::Left, 1, 1));
  EXPECT_NE(first.pixels, next.pixels);
  EXPECT_FALSE(std::equal(first.row(0), first.row(1), first.row(1)));
  const auto again = std::get<Raster8>(expose(light, gain, sensor, Side::Left, 1, 0));
  EXPECT_EQ(first.pixels, again.pixels);
}

TEST(Simulator, MakesTheSameBitsOnOneThreadAndOnTwo) {
  Cell cell = test_cell();
  cell.light.glints = 4;
  cell.sensor.exposure_s = 0.004;
  cell.obstacles.push_back({"rod", Capsule{{-100, -200, 1500}, {200, 200, 1500}, 8}, "", {}, 0.1});
  cell.sensor.focus_mm = 1800;
  cell.light.specular = 0.8;
  cell.lamps.push_back({"lamp", {300, -200, 2400}, 15, 2, 0.2, 30});
  const auto casing = std::make_shared<const TriangleMesh>(mesh_of(CasingShape{}));
  cell.workpiece = Solid{"casing", casing, "platform", {}, 0.3};
  const Simulator simulator(cell, {});
  set_thread_count(1);
  const SimulatedFrame one = simulator.frame(3);
  set_thread_count(2);
  const Simulator again(cell, {});
  std::vector<SimulatedFrame> two(4);
  parallel_for(two.size(), [&](std::size_t i) { two[i] = again.frame(static_cast<int>(i)); });
  set_thread_count(0);
  EXPECT_EQ(std::get<Raster8>(*one.image.left).pixels, std::get<Raster8>(*two[3].image.left).pixels);
  EXPECT_EQ(std::get<Raster8>(*one.image.right).pixels, std::get<Raster8>(*two[3].image.right).pixels);
}

TEST(Simulator, LeavesOutTheImagesOfLostFrames) {
  Cell cell = test_cell();
  cell.sensor.lost_frames = 1;
  const SimulatedFrame made = Simulator(cell, {}).frame(0);
  EXPECT_FALSE(made.image.left || made.image.right);
  EXPECT_EQ(made.truth.targets.size(), 12U);
}

}  // namespace
}  // namespace asterism
