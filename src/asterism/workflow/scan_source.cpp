// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/scan_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPiece = 2'000'000;
constexpr std::size_t kMostKept = 6'000'000;  // points: 200 MB

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Counts a piece in; medians of pieces are taken as weighed means, which differ by nothing that matters.
void count(const Scan& scan, const ScanSurface& surface, ScanSurvey& survey) {
  const auto before = static_cast<double>(survey.points), more = static_cast<double>(scan.in_scanner.size());
  const auto mean = [&](double old, double now) { return (before * old + more * now) / (before + more); };
  std::vector<double> depths;
  Vec3f lowest = scan.in_scanner.front(), highest = lowest;
  Vec3 centre = Vec3::Zero();
  for (std::size_t i = 0; i < scan.in_scanner.size(); ++i) {
    const Vec3f& point = scan.in_scanner[i];
    depths.push_back(point.z());
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
    centre += point.cast<double>();
    const Vec3 normal = surface.normals[i].cast<double>();
    survey.facing += normal * normal.transpose();
  }
  survey.centre = (before * survey.centre + centre) / (before + more);
  survey.depth_mm = mean(survey.depth_mm, median_of(std::move(depths)));
  survey.across_mm = std::max<double>(survey.across_mm, (highest - lowest).norm());
  survey.roughness_mm = mean(survey.roughness_mm, surface.roughness_mm);
  survey.spacing_mm = mean(survey.spacing_mm, surface.spacing_mm);
  survey.from_origin = survey.from_origin && seen_from_origin(scan);
  survey.points += scan.in_scanner.size();
  survey.outliers += surface.outliers;
}

/// Which unit would put a length between two others; empty when none would.
std::string unit_between(double mm, double low, double high) {
  constexpr std::array<std::pair<const char*, double>, 3> kUnits = {
      {{"m", 1000}, {"cm", 10}, {"inch", 25.4}}};
  for (const auto& [unit, factor] : kUnits) {
    if (mm * factor >= low && mm * factor <= high) return unit;
  }
  return "";
}

void refuse_wrong_units(const std::filesystem::path& folder, const std::vector<ScanEntry>& entries,
                        const std::vector<ScanSurvey>& surveys, const std::optional<Scanner>& scanner) {
  std::vector<double> sizes;
  for (const ScanSurvey& survey : surveys) {
    if (survey.points > 1) sizes.push_back(survey.across_mm);
  }
  const double usual_mm = median_of(sizes);
  constexpr double kAlike = 100;  // views of one part differ less than that
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    const ScanSurvey& survey = surveys[i];
    if (survey.points < 2) continue;
    const std::string where = (folder / entries[i].file).string();
    if (scanner && survey.from_origin) {
      const std::string unit = unit_between(survey.depth_mm, scanner->near_mm / 2, 2 * scanner->far_mm);
      const bool plausible = survey.depth_mm > scanner->near_mm / 4 && survey.depth_mm < 4 * scanner->far_mm;
      if (!plausible) {
        throw InputError(
            where,
            fmt::format("scan {} lies {:.3g} mm before the scanner, which measures from {:g} to {:g} mm{}",
                        entries[i].scan, survey.depth_mm, scanner->near_mm, scanner->far_mm,
                        unit.empty()
                            ? "; is its unit right (--unit)?"
                            : fmt::format("; are its numbers in {}? Then say --unit {}", unit, unit)));
      }
    }
    if (survey.across_mm * kAlike < usual_mm || survey.across_mm > kAlike * usual_mm) {
      throw InputError(
          where,
          fmt::format(
              "scan {} is {:.3g} mm across and the others about {:.3g} mm: it must be in another unit; "
              "all scans need the same",
              entries[i].scan, survey.across_mm, usual_mm));
    }
  }
}

}  // namespace

ScanSource::ScanSource(std::filesystem::path folder, std::vector<ScanEntry> entries, double mm_each,
                       const std::optional<Scanner>& scanner, const ScanSurfaceOptions& options,
                       const Progress& progress)
    : folder_(std::move(folder)),
      entries_(std::move(entries)),
      mm_each_(mm_each),
      scanner_(scanner.value_or(Scanner{})),
      options_(options),
      surveys_(entries_.size()) {
  // Without a scanner the neighbours' own spread alone tells what lies off.
  constexpr double kLeast_mm = 1e-3;  // what single precision leaves of a coordinate, and more
  if (!scanner) scanner_.depth_sigma_mm = scanner_.lateral_sigma_mm = kLeast_mm;
  std::vector<std::vector<Scan>> kept(entries_.size());
  std::size_t points = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    ScanSurvey& survey = surveys_[i];
    const auto take = [&](Scan&& piece, const ScanSurface& surface) {
      count(piece, surface, survey);
      points += piece.in_scanner.size();
      if (points > kMostKept) {
        kept.clear();
      } else {
        kept[i].push_back(cleaned(std::move(piece), surface));
      }
    };
    read(i, take, survey.not_finite);
    progress("reading scans", i + 1, entries_.size());
  }
  if (points == 0) throw MeasurementError(fmt::format("not one point in {} scans", entries_.size()));
  refuse_wrong_units(folder_, entries_, surveys_, scanner);
  kept_ = std::move(kept);
  if (scanner) return;
  std::vector<double> roughness;
  for (const ScanSurvey& survey : surveys_) {
    if (survey.points > 0) roughness.push_back(survey.roughness_mm);
  }
  scanner_.depth_sigma_mm = scanner_.lateral_sigma_mm = std::max(kLeast_mm, median_of(roughness));
}

void ScanSource::read(std::size_t scan, const std::function<void(Scan&&, const ScanSurface&)>& take,
                      std::size_t& not_finite) const {
  not_finite = read_scan_pieces(folder_, entries_[scan], kPiece, [&](Scan&& piece) {
    for (Vec3f& point : piece.in_scanner) point *= static_cast<float>(mm_each_);
    const ScanSurface surface = surface_of(piece, scanner_, options_);
    take(std::move(piece), surface);
  });
}

void ScanSource::each_piece(std::size_t scan, const std::function<void(const Scan&)>& take) const {
  if (!kept_.empty()) {
    for (const Scan& piece : kept_[scan]) take(piece);
    return;
  }
  std::size_t not_finite = 0;
  read(
      scan, [&](Scan&& piece, const ScanSurface& surface) { take(cleaned(std::move(piece), surface)); },
      not_finite);
}

}  // namespace asterism
