// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/cloud_fusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/scanning/voxel_store.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::size_t kShares = 64;  // of space, whatever the number of threads
constexpr std::size_t kChunk = 1 << 13;
constexpr VoxelKey kTooFar = ~VoxelKey{0};

VoxelKey key_of(const Vec3& at, double per_mm) {
  VoxelKey key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(at[axis] * per_mm);
    if (!(std::abs(cell) < static_cast<double>(kVoxelOffset - 1))) return kTooFar;
    key = key << 21 | static_cast<VoxelKey>(static_cast<std::int64_t>(cell) + kVoxelOffset);
  }
  return key;
}

std::size_t share_of(VoxelKey key) { return (key * 0xD6E8FEB86659FD93ULL) >> 58; }

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

double median_of(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void describe(CloudFusionOptions& options, OptionVisitor& visit) {
  visit.number("voxel_mm", options.voxel_mm, {1e-3, 1e3},
               "points of one cube of this edge that face one way become one");
  visit.number("outlier_p", options.outlier_p, {0, 0.5},
               "what agrees with the others of its voxel less likely than this is refused; 0 = never");
  visit.integer("min_points", options.min_points, {1, 1000000}, "a voxel with fewer points is left out");
}

struct CloudFusion::State {
  CloudFusionOptions options;
  float largest_chi2;
  std::size_t points = 0;
  std::int32_t scan = 0, part = 0;
  bool open = false;
  std::vector<VoxelStore> shares{kShares};

  void close() {
    if (!open) return;
    parallel_for(kShares, [&](std::size_t share) { shares[share].close_part(largest_chi2); });
    open = false;
  }
};

CloudFusion::CloudFusion(const CloudFusionOptions& options) : state_(std::make_shared<State>()) {
  state_->options = options;
  state_->largest_chi2 = options.outlier_p > 0
                             ? static_cast<float>(chi_square_quantile(1 - options.outlier_p, 1))
                             : std::numeric_limits<float>::max();
}

void CloudFusion::add(int scan, int part, std::span<const ScannerPose> poses,
                      std::span<const CarriedPoint> points) {
  State& state = *state_;
  if (state.open && (state.scan != scan || state.part != part)) state.close();
  state.scan = scan;
  state.part = part;
  state.open = true;
  state.points += points.size();

  // Sorted into shares by counting, each chunk its own places, so that a share sees its points in their
  // order.
  const double per_mm = 1 / state.options.voxel_mm;
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  std::vector<VoxelKey> keys(points.size());
  std::vector<std::array<std::uint32_t, kShares>> place(chunks);
  const auto each_of = [&](std::size_t chunk, const auto& take) {
    for (std::size_t i = chunk * kChunk; i < std::min(points.size(), (chunk + 1) * kChunk); ++i) take(i);
  };
  parallel_for(chunks, [&](std::size_t chunk) {
    place[chunk].fill(0);
    each_of(chunk, [&](std::size_t i) {
      keys[i] = key_of(points[i].at, per_mm);
      if (keys[i] == kTooFar) {
        throw InputError("the cloud",
                         fmt::format("a point lies {:.3g} m away, too far for voxels of {} mm: is its "
                                     "unit right, are the poses?",
                                     points[i].at.norm() / 1000, state.options.voxel_mm));
      }
      ++place[chunk][share_of(keys[i])];
    });
  });
  std::array<std::uint32_t, kShares + 1> begin{};
  std::uint32_t before = 0;
  for (std::size_t share = 0; share < kShares; ++share) {
    begin[share] = before;
    for (auto& counts : place) before += std::exchange(counts[share], before);
  }
  begin[kShares] = before;
  std::vector<std::uint32_t> order(points.size());
  parallel_for(chunks, [&](std::size_t chunk) {
    each_of(chunk,
            [&](std::size_t i) { order[place[chunk][share_of(keys[i])]++] = static_cast<std::uint32_t>(i); });
  });
  const VoxelCall call{state.options.voxel_mm, scan, poses};
  parallel_for(kShares, [&](std::size_t share) {
    for (std::uint32_t at = begin[share]; at < begin[share + 1]; ++at) {
      const std::uint32_t i = order[at];
      state.shares[share].take(keys[i], centre_of(keys[i], call.voxel_mm), points[i], call);
    }
  });
}

FusedCloud CloudFusion::cloud() {
  state_->close();
  std::vector<FusedCloud> told(kShares);
  std::vector<VoxelAgreement> agreed(kShares);
  parallel_for(kShares, [&](std::size_t share) {
    state_->shares[share].tell(state_->options.voxel_mm, state_->options, state_->largest_chi2, told[share],
                               agreed[share]);
  });
  FusedCloud fused;
  fused.points_in = state_->points;
  VoxelAgreement all;
  for (std::size_t share = 0; share < kShares; ++share) {
    append(fused.points, told[share].points);
    fused.outliers += told[share].outliers;
    fused.few += told[share].few;
    append(all.chi2, agreed[share].chi2);
    append(all.apart_mm2, agreed[share].apart_mm2);
    append(all.stated_mm2, agreed[share].stated_mm2);
  }
  fused.shared = all.chi2.size();
  const double usual = chi_square_quantile(0.5, 1);  // the median of χ²
  fused.disagreement = median_of(all.chi2) / usual;
  fused.apart_mm = std::sqrt(median_of(all.apart_mm2) / usual);
  fused.stated_mm = std::sqrt(median_of(all.stated_mm2));
  return fused;
}

std::size_t CloudFusion::memory_bytes() const {
  std::size_t bytes = 0;
  for (const VoxelStore& share : state_->shares) bytes += share.memory_bytes();
  return bytes;
}

Cloud cloud_of(const FusedCloud& fused) {
  Cloud cloud;
  bool normals = false;
  for (const char* name : {"sigma_mm", "points", "scans", "scan", "incidence_deg", "range_mm"}) {
    cloud.fields.push_back({name, {}});
    cloud.fields.back().values.reserve(fused.points.size());
  }
  for (const FusedPoint& point : fused.points) {
    const Vec3 normal = point.normal.cast<double>();
    const double variance =
        normal.isZero() ? point.covariance.trace() / 3 : normal.dot(point.covariance * normal);
    const double values[] = {std::sqrt(variance),
                             static_cast<double>(point.points),
                             static_cast<double>(point.scans),
                             static_cast<double>(point.scan),
                             point.incidence_deg,
                             point.range_mm};
    for (std::size_t i = 0; i < std::size(values); ++i) cloud.fields[i].values.push_back(values[i]);
    cloud.points.push_back(point.at);
    cloud.normals.push_back(point.normal);
    normals = normals || !point.normal.isZero();
  }
  if (!normals) cloud.normals.clear();
  return cloud;
}

}  // namespace asterism
