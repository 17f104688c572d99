// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/voxel_store.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace asterism {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;
constexpr VoxelKey kEmpty = ~VoxelKey{0};
constexpr std::uint32_t kMostParts = 8;    // a voxel keeps; then those that agree become one
constexpr float kSameFacing = 0.7071068F;  // cos 45°
constexpr float kLeastVariance = 1e-12F;

/// Without a normal a point joins the first.
bool faces_alike(const Vec3f& sum, const Vec3f& normal) {
  const float dot = sum.dot(normal), size2 = sum.squaredNorm();
  if (dot > 0 && dot * dot > kSameFacing * kSameFacing * size2) return true;
  return size2 == 0 || normal.squaredNorm() == 0;
}

Upper upper_of(const Mat3& m) {
  return {static_cast<float>(m(0, 0)), static_cast<float>(m(0, 1)), static_cast<float>(m(0, 2)),
          static_cast<float>(m(1, 1)), static_cast<float>(m(1, 2)), static_cast<float>(m(2, 2))};
}

Mat3 matrix_of(const Upper& noise, const Upper& systematic) {
  Upper m = noise;
  add_to(m, 1, systematic);
  Mat3 all;
  all << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return all;
}

}  // namespace

Vec3 centre_of(VoxelKey key, double voxel_mm) {
  constexpr VoxelKey kMask = (VoxelKey{1} << 21) - 1;
  const auto at = [&](int shift) {
    return (static_cast<double>(static_cast<std::int64_t>(key >> shift & kMask) - kVoxelOffset) + 0.5) *
           voxel_mm;
  };
  return {at(42), at(21), at(0)};
}

void VoxelStore::grow() {
  const std::vector<VoxelKey> keys = std::exchange(keys_, {});
  const std::vector<std::uint32_t> heads = std::exchange(heads_, {});
  const std::size_t size = std::max<std::size_t>(64, 2 * keys.size());
  keys_.assign(size, kEmpty);
  heads_.assign(size, kNone);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == kEmpty) continue;
    std::size_t at = hash_of(keys[i]) & (size - 1);
    while (keys_[at] != kEmpty) at = (at + 1) & (size - 1);
    keys_[at] = keys[i];
    heads_[at] = heads[i];
  }
}

std::uint32_t& VoxelStore::head_of(VoxelKey key) {
  if (3 * used_ >= 2 * keys_.size()) grow();
  const std::size_t mask = keys_.size() - 1;
  std::size_t at = hash_of(key) & mask;
  while (keys_[at] != kEmpty && keys_[at] != key) at = (at + 1) & mask;
  if (keys_[at] == kEmpty) {
    keys_[at] = key;
    ++used_;
  }
  return heads_[at];
}

std::uint32_t VoxelStore::slot_of(VoxelKey key, const Vec3f& normal) {
  // Points come line by line: the next one mostly falls where the last one fell.
  if (key == last_key_ && faces_alike(slots_[last_slot_].normals, normal)) return last_slot_;
  last_key_ = key;
  last_slot_ = find_slot(key, normal);
  return last_slot_;
}

std::uint32_t VoxelStore::find_slot(VoxelKey key, const Vec3f& normal) {
  std::uint32_t& head = head_of(key);
  std::uint32_t last = kNone;
  for (std::uint32_t at = head; at != kNone; at = slots_[at].next) {
    if (faces_alike(slots_[at].normals, normal)) return at;
    last = at;
  }
  const auto slot = static_cast<std::uint32_t>(slots_.size());
  slots_.push_back({key, Vec3f::Zero(), kNone, kNone, kNone, 0});
  (last == kNone ? head : slots_[last].next) = slot;
  return slot;
}

std::uint32_t VoxelStore::open_for(std::uint32_t slot, const Vec3& centre, const CarriedPoint& point,
                                   const VoxelCall& call) {
  const ScannerPose& pose = call.poses[point.pose];
  const Vec3 arm = centre - pose.workpiece_from_scanner.translation;
  const auto at_centre = [&](const Mat6& covariance) {
    if (covariance.isZero(0)) return Upper{};
    Mat36 jacobian;
    jacobian << -skew(arm), Mat3::Identity();
    return upper_of(jacobian * covariance * jacobian.transpose());
  };
  Open open{};
  open.slot = slot;
  open.weighted_at.setZero();
  open.normals.setZero();
  open.noise = at_centre(pose.noise);
  open.systematic = at_centre(pose.systematic);
  open.scan = call.scan;
  open_.push_back(open);
  return static_cast<std::uint32_t>(open_.size() - 1);
}

void VoxelStore::take(VoxelKey key, const Vec3& centre, const CarriedPoint& point, const VoxelCall& call) {
  const std::uint32_t at = slot_of(key, point.normal);
  if (slots_[at].open == kNone) slots_[at].open = open_for(at, centre, point, call);
  slots_[at].normals += point.normal;
  Open& open = open_[slots_[at].open];
  const Upper& noise = point.scanner_mm2;
  const float variance =
      point.normal.isZero() ? (noise[0] + noise[3] + noise[5]) / 3 : along(noise, point.normal);
  const float weight = 1 / std::max(variance, kLeastVariance);
  open.weight += weight;
  open.weighted_at += weight * (point.at - centre).cast<float>();
  add_to(open.weighted_noise, weight * weight, noise);
  open.normals += point.normal;
  open.range_mm += point.range_mm;
  open.cos_incidence += point.cos_incidence;
  ++open.points;
}

void VoxelStore::append(Slot& slot, const VoxelPart& part) {
  std::uint32_t at = free_;
  if (at == kNone) {
    at = static_cast<std::uint32_t>(parts_.size());
    parts_.emplace_back();
  } else {
    free_ = parts_[at].before;
  }
  parts_[at] = {part, slot.part};
  slot.part = at;
  ++slot.parts;
}

std::vector<VoxelPart> VoxelStore::parts_of(const Slot& slot) const {
  std::vector<VoxelPart> parts(slot.parts);
  std::uint32_t at = slot.part;
  for (std::size_t i = parts.size(); i-- > 0; at = parts_[at].before) parts[i] = parts_[at].part;
  return parts;
}

void VoxelStore::settle(Slot& slot, float largest_chi2) {
  std::vector<VoxelPart> parts = parts_of(slot);
  while (slot.part != kNone) {
    const std::uint32_t at = slot.part;
    slot.part = parts_[at].before;
    parts_[at].before = free_;
    free_ = at;
  }
  slot.parts = 0;
  const AgreedParts agreed = agreement_of(parts, largest_chi2);
  refused_ += agreed.refused;
  append(slot, agreed.all);
}

void VoxelStore::close_part(float largest_chi2) {
  for (const Open& open : open_) {
    Slot& slot = slots_[open.slot];
    VoxelPart part;
    part.at = open.weighted_at / open.weight;
    part.noise = open.noise;
    add_to(part.noise, 1 / (open.weight * open.weight), open.weighted_noise);
    part.systematic = open.systematic;
    part.normals = open.normals;
    part.range_mm = open.range_mm;
    part.cos_incidence = open.cos_incidence;
    part.points = part.scan_points = open.points;
    part.scan = part.last_scan = open.scan;
    part.scans = 1;
    slot.open = kNone;
    append(slot, part);
    if (slot.parts >= kMostParts) settle(slot, largest_chi2);
  }
  open_.clear();
}

void VoxelStore::tell(double voxel_mm, const CloudFusionOptions& options, float largest_chi2,
                      FusedCloud& fused, VoxelAgreement& agreement) const {
  fused.outliers += refused_;
  for (const Slot& slot : slots_) {
    std::vector<VoxelPart> parts = parts_of(slot);
    const AgreedParts agreed = agreement_of(parts, largest_chi2);
    const VoxelPart& all = agreed.all;
    fused.outliers += agreed.refused;
    if (agreed.shared) {
      agreement.chi2.push_back(agreed.chi2);
      agreement.apart_mm2.push_back(agreed.apart_mm2);
      agreement.stated_mm2.push_back(agreed.stated_mm2);
    }
    if (all.points < static_cast<std::uint32_t>(options.min_points)) {
      fused.few += all.points;
      continue;
    }
    FusedPoint point;
    point.at = centre_of(slot.key, voxel_mm) + all.at.cast<double>();
    point.normal = agreed.normal;
    point.covariance = matrix_of(all.noise, all.systematic);
    point.points = all.points;
    point.scans = all.scans;
    point.scan = all.scan;
    const auto count = static_cast<float>(all.points);
    point.incidence_deg =
        static_cast<float>(deg_from_rad(std::acos(std::min(1.F, all.cos_incidence / count))));
    point.range_mm = all.range_mm / count;
    fused.points.push_back(point);
  }
}

std::size_t VoxelStore::memory_bytes() const {
  return keys_.capacity() * sizeof(VoxelKey) + heads_.capacity() * sizeof(std::uint32_t) +
         slots_.capacity() * sizeof(Slot) + open_.capacity() * sizeof(Open) +
         parts_.capacity() * sizeof(Linked);
}

}  // namespace asterism
