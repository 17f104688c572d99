// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/rig_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

struct Line {
  double mean = 0, mean_sigma = 0;
  double slope = 0, slope_sigma = 0;
};

/// y = mean + slope (x − mean x), sigmas from the scatter; infinite where there is too little.
Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(y.size());
  Line line{0, kUnknown, 0, kUnknown};
  double middle = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    line.mean += y[i] / n;
    middle += x[i] / n;
  }
  double xx = 0, xy = 0, squares = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    xx += (x[i] - middle) * (x[i] - middle);
    xy += (x[i] - middle) * (y[i] - line.mean);
    squares += (y[i] - line.mean) * (y[i] - line.mean);
  }
  if (y.size() < 3) return line;
  line.mean_sigma = std::sqrt(squares / (n - 1) / n);
  if (!(xx > 1e-12)) return line;
  line.slope = xy / xx;
  line.slope_sigma = std::sqrt(std::max(0.0, squares - line.slope * xy) / (n - 2) / xx);
  return line;
}

double error_of(const LengthObservation& length) { return (length.a - length.b).norm() - length.known_mm; }

double sigma_of(const LengthObservation& length) {
  const Vec3 along = (length.a - length.b).normalized();
  return std::sqrt(along.dot((length.a_covariance + length.b_covariance) * along));
}

std::vector<LengthSummary> summaries_of(const std::vector<LengthObservation>& lengths) {
  std::map<std::string, LengthSummary> by_name;
  for (const LengthObservation& length : lengths) {
    LengthSummary& summary = by_name[length.name];
    const double error = error_of(length), sigma = sigma_of(length);
    summary.name = length.name;
    summary.known_mm = length.known_mm;
    ++summary.count;
    summary.bias_mm += error;
    summary.rms_mm += error * error;
    summary.worst_mm = std::max(summary.worst_mm, std::abs(error));
    summary.rms_of_sigma += sigma > 0 ? error * error / (sigma * sigma) : 0.0;
  }
  std::vector<LengthSummary> summaries;
  for (auto& [name, summary] : by_name) {
    summary.bias_mm /= summary.count;
    summary.rms_mm = std::sqrt(summary.rms_mm / summary.count);
    summary.rms_of_sigma = std::sqrt(summary.rms_of_sigma / summary.count);
    summaries.push_back(summary);
  }
  return summaries;
}

void check_scale(RigCheck& check, const std::vector<LengthObservation>& lengths) {
  std::vector<double> depth_m, ppm;
  double squares = 0;
  for (const LengthObservation& length : lengths) {
    const double error = error_of(length);
    depth_m.push_back(0.5e-3 * (length.a.z() + length.b.z()));
    ppm.push_back(1e6 * error / length.known_mm);
    check.bias_mm += error / static_cast<double>(lengths.size());
    squares += error * error;
  }
  check.length_rms_mm = std::sqrt(squares / static_cast<double>(lengths.size()));
  const Line line = fit_line(depth_m, ppm);
  check.scale_ppm = line.mean;
  check.scale_sigma_ppm = line.mean_sigma;
  check.depth_ppm_per_m = line.slope;
  check.depth_sigma_ppm_per_m = line.slope_sigma;
}

void check_epipolar(RigCheck& check, const std::vector<EpipolarObservation>& epipolar, int width_px,
                    int height_px) {
  if (epipolar.empty()) return;
  std::vector<double> times, errors, region_errors[9];
  double squares = 0;
  for (const EpipolarObservation& seen : epipolar) {
    times.push_back(seen.time_s);
    errors.push_back(seen.error_px);
    squares += seen.error_px * seen.error_px;
    const int column = std::clamp(static_cast<int>(3 * seen.left_px.x() / width_px), 0, 2);
    const int row = std::clamp(static_cast<int>(3 * seen.left_px.y() / height_px), 0, 2);
    region_errors[3 * row + column].push_back(seen.error_px);
  }
  const Line line = fit_line(times, errors);
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  check.epipolar_mean_px = line.mean;
  check.epipolar_rms_px = std::sqrt(squares / static_cast<double>(errors.size()));
  check.drift_px = line.slope * (*last - *first);
  check.drift_sigma_px = line.slope_sigma * (*last - *first);
  for (int region = 0; region < 9; ++region) {
    const auto& in_region = region_errors[region];
    if (in_region.size() < 3) continue;
    const Line mean = fit_line(std::vector<double>(in_region.size(), 0.0), in_region);
    check.regions.push_back(
        {region % 3, region / 3, static_cast<int>(in_region.size()), mean.mean, mean.mean_sigma});
  }
}

/// Adds a reason when `value` passes `limit`, and worsens the verdict by how surely it does.
void judge(RigCheck& check, double value, double sigma, double limit, const std::string& words) {
  if (!(std::abs(value) > limit)) return;
  const bool surely = std::abs(value) - limit > 3 * sigma;
  check.verdict = std::max(check.verdict, surely ? RigVerdict::Bad : RigVerdict::Doubtful);
  check.reasons.push_back(words + (surely ? "" : " (not yet certain: take more frames)"));
}

}  // namespace

void describe(RigCheckOptions& options, OptionVisitor& visit) {
  visit.number("max_scale_ppm", options.max_scale_ppm, {0, 1e6}, "scale error of a rig that is still good");
  visit.number("max_epipolar_px", options.max_epipolar_px, {0, 100},
               "systematic epipolar error of a rig that is still good");
}

RigCheck check_rig(const std::vector<LengthObservation>& lengths,
                   const std::vector<EpipolarObservation>& epipolar, int width_px, int height_px,
                   const RigCheckOptions& options) {
  if (lengths.empty()) throw MeasurementError("no frame shows both ends of a known length");
  RigCheck check;
  check.lengths = summaries_of(lengths);
  check_scale(check, lengths);
  check_epipolar(check, epipolar, width_px, height_px);

  judge(check, check.scale_ppm, check.scale_sigma_ppm, options.max_scale_ppm,
        fmt::format("lengths come out {:.0f} ppm too {}", std::abs(check.scale_ppm),
                    check.scale_ppm > 0 ? "long" : "short"));
  judge(
      check, check.drift_px, check.drift_sigma_px, options.max_epipolar_px,
      fmt::format("the epipolar error drifts by {:+.3f} px during the recording: the cameras move or warm up",
                  check.drift_px));
  for (const RegionSummary& region : check.regions) {
    static const char* const kColumns[] = {"left", "middle", "right"};
    static const char* const kRows[] = {"top", "centre", "bottom"};
    judge(check, region.mean_px, region.sigma_px, options.max_epipolar_px,
          fmt::format("sight lines miss each other by {:+.3f} px in the {} {} of the image", region.mean_px,
                      kRows[region.row], kColumns[region.column]));
  }
  if (lengths.size() < 10) {
    check.verdict = std::max(check.verdict, RigVerdict::Doubtful);
    check.reasons.push_back(fmt::format(
        "only {} lengths were seen: show them at 10 or more places of the volume", lengths.size()));
  }
  return check;
}

}  // namespace asterism
