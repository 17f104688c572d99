// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "asterism/scanning/cloud_fusion.hpp"
#include "asterism/scanning/voxel_parts.hpp"

namespace asterism {

/// A voxel by its three numbers, 21 bits each.
using VoxelKey = std::uint64_t;

/// What is common to all points of a call.
struct VoxelCall {
  double voxel_mm;
  std::int32_t scan;
  std::span<const ScannerPose> poses;
};

/// Of each voxel that several parts share (AgreedParts).
struct VoxelAgreement {
  std::vector<float> chi2, apart_mm2, stated_mm2;
};

/// The voxels of one share of space: which share a voxel falls into is told by its key alone, so shares can
/// be filled by as many threads without a lock and in the same order whatever their number.
class VoxelStore {
 public:
  void take(VoxelKey key, const Vec3& centre, const CarriedPoint& point, const VoxelCall& call);
  /// The part of the scan that was being taken is done: each of its voxels now holds it against the others.
  void close_part(float largest_chi2);
  /// Adds its points to `fused`, and what shared voxels tell of the scans' agreement.
  void tell(double voxel_mm, const CloudFusionOptions& options, float largest_chi2, FusedCloud& fused,
            VoxelAgreement& agreement) const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// Points of the part that is being taken.
  struct Open {
    std::uint32_t slot;
    float weight;
    Vec3f weighted_at;
    Upper weighted_noise;     // Σ w² C
    Upper noise, systematic;  // of the pose, at the voxel's centre
    Vec3f normals;
    float range_mm, cos_incidence;
    std::uint32_t points;
    std::int32_t scan;
  };
  /// What faces one way in a voxel.
  struct Slot {
    VoxelKey key;
    Vec3f normals;        // sum
    std::uint32_t next;   // the voxel's next one
    std::uint32_t open;   // among the open ones
    std::uint32_t part;   // its last part
    std::uint32_t parts;  // how many
  };
  struct Linked {
    VoxelPart part;
    std::uint32_t before;  // the part before it; of a free one, the next free one
  };

  [[nodiscard]] std::uint32_t& head_of(VoxelKey key);
  void grow();
  std::uint32_t slot_of(VoxelKey key, const Vec3f& normal);
  std::uint32_t find_slot(VoxelKey key, const Vec3f& normal);
  std::uint32_t open_for(std::uint32_t slot, const Vec3& centre, const CarriedPoint& point,
                         const VoxelCall& call);
  void append(Slot& slot, const VoxelPart& part);
  [[nodiscard]] std::vector<VoxelPart> parts_of(const Slot& slot) const;
  void settle(Slot& slot, float largest_chi2);

  std::vector<VoxelKey> keys_;  // open addressing
  std::vector<std::uint32_t> heads_;
  std::size_t used_ = 0;
  std::vector<Slot> slots_;
  std::vector<Open> open_;
  std::vector<Linked> parts_;
  std::uint32_t free_ = 0xFFFFFFFF;
  std::size_t refused_ = 0;
  VoxelKey last_key_ = ~VoxelKey{0};
  std::uint32_t last_slot_ = 0;
};

[[nodiscard]] inline std::uint64_t hash_of(VoxelKey key) {
  key *= 0x9E3779B97F4A7C15ULL;
  return key ^ (key >> 29);
}
constexpr std::int64_t kVoxelOffset = std::int64_t{1} << 20;
[[nodiscard]] Vec3 centre_of(VoxelKey key, double voxel_mm);

}  // namespace asterism
