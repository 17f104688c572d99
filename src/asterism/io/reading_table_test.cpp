// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/reading_table.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

const char* const kHeader = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";

void expect_refused(const std::string& rows, const std::string& why) {
  const TestFolder folder;
  folder.write("r.csv", kHeader + rows);
  try {
    static_cast<void>(read_readings(folder / "r.csv"));
    FAIL() << "no error for " << rows;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(ReadingTable, ComesBackAsItWasWritten) {
  const TestFolder folder;
  std::vector<PlatformReading> readings(2);
  readings[0].time_s = -0.01;
  readings[0].base_from_body = {exp_rotation({0.1, 2, 0.3}), {1, 2, 2500}};
  readings[0].covariance.diagonal() << 1e-8, 2e-8, 3e-8, 0.01, 0.04, 0.09;
  readings[1] = readings[0];
  readings[1].time_s = 0.02;
  write_readings(folder / "r.csv", readings);
  const auto back = read_readings(folder / "r.csv");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].time_s, -0.01);
  EXPECT_LT(difference(back[1].base_from_body, readings[1].base_from_body).norm(), 1e-6);
  EXPECT_TRUE(back[0].covariance.isApprox(readings[0].covariance, 1e-3));
  EXPECT_TRUE(back[0].correlated.isZero(0));
}

TEST(ReadingTable, WithoutSigmasIsAsGoodAsAReadOutUsuallyIs) {
  const TestFolder folder;
  folder.write("r.csv", std::string(kHeader) + "0,1,2,3,1,0,0,0\n");
  const auto readings = read_readings(folder / "r.csv");
  EXPECT_NEAR(deg_from_rad(std::sqrt(readings[0].covariance(0, 0))), 0.0345, 1e-9);
  EXPECT_NEAR(std::sqrt(readings[0].covariance(3, 3)), 0.196, 1e-3);  // 0.185 mm and the jumps
}

TEST(ReadingTable, RefusesTimesThatGoBackAndWhatIsNoRotation) {
  expect_refused("0.1,0,0,0,1,0,0,0\n0.1,0,0,0,1,0,0,0\n",
                 "r.csv:3: column `time_s`: 0.1 s does not come after the row before (0.1 s)");
  expect_refused("0.1,0,0,0,2,0,0,0\n", "qw to qz have length 2; a rotation's is 1");
  const TestFolder folder;
  folder.write("r.csv",
               "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,sigma_x_mm,sigma_y_mm,sigma_z_mm,sigma_rx_deg,sigma_ry_deg,"
               "sigma_rz_deg\n0,0,0,0,1,0,0,0,1,1,0,1,1,1\n");
  EXPECT_THROW(static_cast<void>(read_readings(folder / "r.csv")), InputError);
}

}  // namespace
}  // namespace asterism
