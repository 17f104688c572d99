// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "asterism/geometry/neighbours.hpp"
#include "asterism/scanning/registration.hpp"

namespace asterism {
namespace {

/// All scans' spots in one tree; which scan each is of.
class OtherScans {
 public:
  explicit OtherScans(std::span<const ScanSpots> scans) : scans_(scans), tree_(places_of(scans)) {
    for (std::size_t scan = 0; scan < scans.size(); ++scan) {
      for (std::size_t i = 0; i < scans[scan].spots.size(); ++i) of_.push_back({scan, i});
    }
  }

  /// The nearest spot of another scan that counts, and faces the same way.
  [[nodiscard]] std::optional<SurfaceSpot> nearest(const SurfaceSpot& spot, std::size_t not_of,
                                                   const std::vector<bool>& left_out,
                                                   double within_mm) const {
    constexpr std::size_t kAsked = 24;
    constexpr double kSameFacing = 0.7;
    for (const std::size_t found : tree_.few_nearest(spot.at, kAsked)) {
      const auto [scan, i] = of_[found];
      if (scan == not_of || left_out[scan]) continue;
      const SurfaceSpot& other = scans_[scan].spots[i];
      if (other.normal.dot(spot.normal) < kSameFacing) continue;
      if ((other.at - spot.at).norm() > within_mm) return std::nullopt;
      return other;
    }
    return std::nullopt;
  }

 private:
  static std::vector<Vec3> places_of(std::span<const ScanSpots> scans) {
    std::vector<Vec3> places;
    for (const ScanSpots& scan : scans) {
      for (const SurfaceSpot& spot : scan.spots) places.push_back(spot.at);
    }
    return places;
  }

  std::span<const ScanSpots> scans_;
  Neighbours tree_;
  std::vector<std::pair<std::size_t, std::size_t>> of_;
};

}  // namespace

std::vector<std::optional<Registration>> register_scans(std::span<const ScanSpots> scans,
                                                        const RegistrationOptions& options) {
  const OtherScans others(scans);
  std::vector<bool> left_out(scans.size(), false);
  const auto mean_without = [&](std::size_t without) {
    Mat6 mean = Mat6::Zero();
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (i != without) mean += scans[i].noise / static_cast<double>(scans.size() - 1);
    }
    return mean;
  };
  const auto judge = [&](std::size_t scan) -> std::optional<Registration> {
    const FindSpot find = [&](const SurfaceSpot& spot) {
      return others.nearest(spot, scan, left_out, 2 * options.within_mm);
    };
    auto found = register_scan(scans[scan].spots, find, scans[scan].noise, mean_without(scan),
                               scans[scan].origin, options);
    if (!found) return std::nullopt;
    return std::move(*found);
  };
  std::vector<std::optional<Registration>> judged(scans.size());
  std::vector<bool> asked(scans.size(), true);
  for (std::size_t round = 0; round < scans.size(); ++round) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (asked[i]) judged[i] = judge(i);
    }
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      asked[i] = !left_out[i] && judged[i] && judged[i]->disagrees;
      if (asked[i] && (!worst || judged[i]->chi2 > judged[*worst]->chi2)) worst = i;
    }
    if (!worst) break;
    left_out[*worst] = true;
    asked[*worst] = false;
  }
  return judged;
}

}  // namespace asterism
