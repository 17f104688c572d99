// SPDX-License-Identifier: Apache-2.0
// The statistics against values certified by the National Institute of Standards and Technology, to ten
// digits where binary numbers can hold the data that well, and against Student's own sleep data.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "asterism/statistics/anova.hpp"
#include "asterism/statistics/intervals.hpp"
#include "asterism/statistics/student.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr int kFirstDataLine = 61;

std::vector<std::string> lines_of(const std::string& name) {
  std::ifstream stream(std::string(ASTERISM_NIST_STRD) + "/" + name);
  EXPECT_TRUE(stream) << name;
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// How many digits of a certified value were met.
void expect_digits(double value, double certified, double digits, const std::string& what) {
  const double error = certified == 0 ? std::abs(value) : std::abs(value - certified) / std::abs(certified);
  EXPECT_LE(error, std::pow(10.0, -digits)) << what << ": " << value << ", certified " << certified;
}

class CertifiedSummary : public testing::TestWithParam<const char*> {};

TEST_P(CertifiedSummary, AgreesToTenDigits) {
  const std::vector<std::string> lines = lines_of(GetParam());
  const auto certified = [&](std::size_t line) {  // lines count from one
    const std::string& text = lines.at(line - 1);
    return std::stod(text.substr(text.rfind(':') + 1));
  };
  std::vector<double> values;
  for (std::size_t i = kFirstDataLine - 1; i < lines.size(); ++i) {
    std::istringstream words(lines[i]);
    for (double value; words >> value;) values.push_back(value);
  }
  const Summary summary = summarize(values);
  expect_digits(summary.mean, certified(41), 14, "mean");
  expect_digits(summary.deviation, certified(42), 10, "standard deviation");
  expect_digits(autocorrelation(values), certified(43), 10, "autocorrelation");
}

INSTANTIATE_TEST_SUITE_P(Nist, CertifiedSummary, testing::Values("Mavro.txt", "Michelso.txt"));

/// NumAcc2 to NumAcc4: `base` + 0.2, then `base` + 0.1 and + 0.3 in turn, 1001 values.
std::vector<double> alternating(double base_tenths) {
  std::vector<double> values = {(base_tenths + 2) / 10};
  while (values.size() < 1001) values.push_back((base_tenths + (values.size() % 2 == 1 ? 1 : 3)) / 10);
  return values;
}

TEST(CertifiedSummaryOfHardData, LosesOnlyWhatTheBinaryDataHaveLost) {
  const std::vector<double> num_acc1 = {10000001, 10000003, 10000002};
  expect_digits(summarize(num_acc1).mean, 10000002, 15, "NumAcc1 mean");
  expect_digits(summarize(num_acc1).deviation, 1, 15, "NumAcc1 deviation");
  // One rounding of the datum is 2⁻⁵³ · mean of the deviation 0.1: 14.8, 9 and 8 digits can be hoped for.
  const double means[] = {1.2, 1000000.2, 10000000.2}, digits[] = {14, 9, 8};
  for (int i = 0; i < 3; ++i) {
    const std::vector<double> values = alternating(10 * (means[i] - 0.2));
    expect_digits(summarize(values).mean, means[i], 14, "NumAcc mean");
    expect_digits(summarize(values).deviation, 0.1, digits[i], "NumAcc deviation");
    expect_digits(autocorrelation(values), -0.999, digits[i], "NumAcc autocorrelation");
  }
}

struct AnovaCase {
  const char* file;
  double digits;  // what the binary data allow
};
void PrintTo(const AnovaCase& one, std::ostream* out) { *out << one.file; }

class CertifiedAnova : public testing::TestWithParam<AnovaCase> {};

TEST_P(CertifiedAnova, AgreesAsFarAsTheDataAllow) {
  const std::vector<std::string> lines = lines_of(GetParam().file);
  std::map<int, std::vector<double>> by_treatment;
  for (std::size_t i = kFirstDataLine - 1; i < lines.size(); ++i) {
    std::istringstream words(lines[i]);
    int treatment = 0;
    double value = 0;
    if (words >> treatment >> value) by_treatment[treatment].push_back(value);
  }
  std::vector<std::vector<double>> groups;
  for (auto& [treatment, values] : by_treatment) groups.push_back(std::move(values));
  // The numbers behind the first line that holds `word`.
  const auto numbers_after = [&](const std::string& word) {
    std::vector<double> numbers;
    for (const std::string& line : lines) {
      const std::size_t place = line.find(word);
      if (place == std::string::npos || !numbers.empty()) continue;
      std::istringstream words(line.substr(place + word.size()));
      for (double number; words >> number;) numbers.push_back(number);
    }
    return numbers;
  };
  const std::string factor = std::string(GetParam().file).starts_with("SmLs") ? "Treatment " : "Instrument ";
  const std::vector<double> between = numbers_after("Between " + factor),
                            within = numbers_after("Within " + factor);
  const Anova anova = one_way_anova(groups);
  const double digits = GetParam().digits;
  EXPECT_EQ(anova.between_degrees, between.at(0));
  EXPECT_EQ(anova.within_degrees, within.at(0));
  expect_digits(anova.between_squares, between.at(1), digits, "between");
  expect_digits(anova.within_squares, within.at(1), digits, "within");
  expect_digits(anova.f, between.at(3), digits, "F");
  expect_digits(anova.r_squared, numbers_after("Certified R-Squared").at(0), digits, "R²");
  expect_digits(anova.deviation, numbers_after("Standard Deviation").at(0), digits, "deviation");
}

// SmLs04 has 7 and SmLs07 13 common leading digits: their data are rounded to 1e-9 and 1e-3 of what varies.
INSTANTIATE_TEST_SUITE_P(Nist, CertifiedAnova,
                         testing::Values(AnovaCase{"SiRstv.dat", 10}, AnovaCase{"AtmWtAg.dat", 8.5},
                                         AnovaCase{"SmLs01.dat", 13}, AnovaCase{"SmLs04.dat", 9},
                                         AnovaCase{"SmLs07.dat", 2}));

// Values computed with R 4 (t.test on the data sets sleep and morley).
TEST(StudentsSleepData, GivesThePairedTestOfR) {
  const std::vector<double> first = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  const std::vector<double> second = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  const TTest test = paired_t_test(first, second);
  expect_digits(test.t, -4.06212768338204, 13, "t");
  EXPECT_EQ(test.degrees, 9);
  expect_digits(test.p, 0.00283289019738, 11, "p");
  expect_digits(test.interval.low, -2.45988576327698, 13, "low");
  expect_digits(test.interval.high, -0.70011423672302, 13, "high");
  // R's help page of t.test: t.test(extra ~ group, data = sleep), Welch: t = −1.8608, df = 17.776, p =
  // 0.07939.
  const TTest welch = welch_t_test(summarize(first), summarize(second));
  EXPECT_NEAR(welch.t, -1.8608, 5e-5);
  EXPECT_NEAR(welch.degrees, 17.776, 5e-4);
  EXPECT_NEAR(welch.p, 0.07939, 5e-6);
}

TEST(MichelsonsSpeedOfLight, GivesTheIntervalOfR) {
  std::vector<double> speeds;
  const std::vector<std::string> lines = lines_of("Michelso.txt");
  for (std::size_t i = kFirstDataLine - 1; i < lines.size(); ++i) {
    std::istringstream words(lines[i]);
    for (double value; words >> value;) speeds.push_back(std::round((value - 299) * 1000));
  }
  const Interval interval = mean_interval(summarize(speeds));
  EXPECT_NEAR(interval.centre(), 852.4, 1e-9);
  EXPECT_NEAR(interval.low, 836.722593166, 1e-8);
  EXPECT_NEAR(interval.high, 868.077406834, 1e-8);
  std::vector<std::vector<double>> experiments(5);  // twenty runs each
  for (std::size_t i = 0; i < speeds.size(); ++i) experiments.at(i / 20).push_back(speeds[i]);
  const Anova anova = one_way_anova(experiments);
  EXPECT_NEAR(anova.f, 4.288, 5e-4);
  EXPECT_NEAR(anova.p, 0.00311, 5e-6);
}

}  // namespace
}  // namespace asterism
