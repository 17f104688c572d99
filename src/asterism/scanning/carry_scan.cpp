// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asterism/core/parallel.hpp"
#include "asterism/scanning/carrying.hpp"

namespace asterism {
namespace {

constexpr double kSlot_s = 0.0005;       // 10 m/s² bend a line by 0.3 µm in this time
constexpr double kMostSlots = 2e6;       // of one scan
constexpr std::size_t kChunk = 1 << 14;  // points of one task
constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

/// So many of a scan's points have no pose, for this reason.
void leave_out(NotCarried reason, std::size_t points, CarriedScan& scan) {
  switch (reason) {
    case NotCarried::NoPose:
      scan.no_pose += points;
      return;
    case NotCarried::OutsideRun:
      scan.outside_run += points;
      return;
    case NotCarried::Gap:
      scan.gap += points;
      return;
  }
}

/// Moments so near to one another that two poses and the line between them serve for all.
struct Slot {
  double first_s = std::numeric_limits<double>::infinity();
  double last_s = -std::numeric_limits<double>::infinity();
  std::uint32_t points = 0;
  std::uint32_t pose = kNone;  // where it has one
  Vec6 way = Vec6::Zero();     // from the first moment to the last
  NotCarried reason = NotCarried::NoPose;
  std::uint32_t part = 0;
};

/// Which slot a moment falls into.
struct Slots {
  double start_s = 0, slot_s = kSlot_s;
  std::vector<Slot> all;
  [[nodiscard]] std::size_t of(double time_s) const {
    return std::min(all.size() - 1, static_cast<std::size_t>((time_s - start_s) / slot_s));
  }
};

Slots slots_of(const Scan& scan) {
  Slots slots;
  if (scan.times_s.empty()) {
    slots.start_s = scan.time_s;
    slots.all.push_back({scan.time_s, scan.time_s, static_cast<std::uint32_t>(scan.in_scanner.size())});
    return slots;
  }
  const auto [first, last] = std::minmax_element(scan.times_s.begin(), scan.times_s.end());
  slots.start_s = *first;
  slots.slot_s = std::max(kSlot_s, (*last - *first) / kMostSlots);
  slots.all.resize(static_cast<std::size_t>((*last - *first) / slots.slot_s) + 1);
  for (const double time_s : scan.times_s) {
    Slot& slot = slots.all[slots.of(time_s)];
    slot.first_s = std::min(slot.first_s, time_s);
    slot.last_s = std::max(slot.last_s, time_s);
    ++slot.points;
  }
  return slots;
}

/// The slots' poses, and into which part of the scan each falls.
void find_poses(Slots& slots, const ScanChain& chain, const CarryOptions& options, CarriedScan& to) {
  std::vector<ScannerPose> found(slots.all.size());
  std::vector<std::uint8_t> there(slots.all.size(), 0);
  parallel_for((slots.all.size() + 63) / 64, [&](std::size_t block) {
    for (std::size_t i = 64 * block; i < std::min(slots.all.size(), 64 * (block + 1)); ++i) {
      Slot& slot = slots.all[i];
      if (slot.points == 0) continue;
      const auto first = scanner_pose_at(chain, slot.first_s, options.largest_gap_s);
      const auto last =
          slot.last_s > slot.first_s ? scanner_pose_at(chain, slot.last_s, options.largest_gap_s) : first;
      if (!first || !last) {
        slot.reason = first ? last.error() : first.error();
        continue;
      }
      found[i] = *first;
      slot.way = difference(last->workpiece_from_scanner, first->workpiece_from_scanner);
      there[i] = 1;
    }
  });
  double part_from_s = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slots.all.size(); ++i) {
    Slot& slot = slots.all[i];
    if (there[i] == 0) continue;
    if (slot.first_s > part_from_s + options.independent_s) {
      part_from_s = slot.first_s;
      to.parts.push_back({slot.first_s, {}});
    }
    slot.part = static_cast<std::uint32_t>(to.parts.size() - 1);
    slot.pose = static_cast<std::uint32_t>(to.poses.size());
    to.poses.push_back(found[i]);
  }
}

/// What carries the points of a slot.
struct Carrier {
  Mat3 rotation;
  Vec3 translation;
  Vec3 turn, move;  // from the slot's first moment to its last
  double first_s, per_s;
  std::uint32_t pose, part;
};

std::vector<Carrier> carriers_of(const Slots& slots, const CarriedScan& scan) {
  std::vector<Carrier> carriers(slots.all.size());
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    const Slot& slot = slots.all[i];
    Carrier& carrier = carriers[i];
    carrier.pose = slot.pose;
    if (slot.pose == kNone) continue;
    const RigidMotion& motion = scan.poses[slot.pose].workpiece_from_scanner;
    const double lasts_s = slot.last_s - slot.first_s;
    carrier.rotation = motion.rotation.toRotationMatrix();
    carrier.translation = motion.translation;
    carrier.turn = slot.way.head<3>();
    carrier.move = slot.way.tail<3>();
    carrier.first_s = slot.first_s;
    carrier.per_s = lasts_s > 0 ? 1 / lasts_s : 0;
    carrier.part = slot.part;
  }
  return carriers;
}

CarriedPoint carry_point(const Scan& scan, std::size_t i, const Carrier& carrier, const Scanner& scanner) {
  const Vec3 in_scanner = scan.in_scanner[i].cast<double>();
  const double late = (scan.time_of(i) - carrier.first_s) * carrier.per_s;
  const Vec3 turn = late * carrier.turn;
  const Vec3 arm = carrier.rotation * in_scanner;
  const Vec3 swung = turn.cross(arm);
  CarriedPoint point;
  point.at = arm + swung + 0.5 * turn.cross(swung) + carrier.translation + late * carrier.move;
  point.pose = carrier.pose;
  point.range_mm = static_cast<float>(in_scanner.norm());
  point.normal.setZero();
  point.cos_incidence = 1;
  if (!scan.normals.empty()) {
    const Vec3f& normal = scan.normals[i];
    point.normal = (carrier.rotation * normal.cast<double>()).cast<float>();
    const bool known = point.range_mm > 0 && normal.squaredNorm() > 0;
    if (known) point.cos_incidence = std::abs(normal.dot(scan.in_scanner[i])) / point.range_mm;
  }
  const RangeNoise noise = range_noise(scanner, std::abs(in_scanner.z()), point.cos_incidence);
  // Across alike, so C = l² I + (d² − l²) z zᵀ.
  const double across = noise.lateral_mm * noise.lateral_mm;
  const double more = noise.depth_mm * noise.depth_mm - across;
  const auto z = carrier.rotation.col(2);
  const auto entry = [&](int a, int b) {
    return static_cast<float>((a == b ? across : 0) + more * z[a] * z[b]);
  };
  point.scanner_mm2 = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  return point;
}

}  // namespace

CarriedScan carried(const Scan& scan, const ScanChain& chain, const Scanner& scanner,
                    const CarryOptions& options) {
  CarriedScan to;
  to.scan = scan.number;
  if (scan.in_scanner.empty()) return to;
  Slots slots = slots_of(scan);
  find_poses(slots, chain, options, to);
  for (const Slot& slot : slots.all) {
    if (slot.points > 0 && slot.pose == kNone) leave_out(slot.reason, slot.points, to);
  }
  if (to.parts.empty()) return to;
  const std::vector<Carrier> carriers = carriers_of(slots, to);
  const auto carrier_of = [&](std::size_t i) -> const Carrier& {
    return carriers[scan.times_s.empty() ? 0 : slots.of(scan.times_s[i])];
  };

  // Counted by chunk and part first, so that each chunk writes its own places, in the scan's order.
  const std::size_t points = scan.in_scanner.size(), chunks = (points + kChunk - 1) / kChunk;
  std::vector<std::vector<std::size_t>> place(chunks, std::vector<std::size_t>(to.parts.size(), 0));
  const auto each_of = [&](std::size_t chunk, const auto& take) {
    for (std::size_t i = chunk * kChunk; i < std::min(points, (chunk + 1) * kChunk); ++i) {
      const Carrier& carrier = carrier_of(i);
      if (carrier.pose != kNone) take(i, carrier);
    }
  };
  parallel_for(chunks, [&](std::size_t chunk) {
    each_of(chunk, [&](std::size_t, const Carrier& carrier) { ++place[chunk][carrier.part]; });
  });
  for (std::size_t part = 0; part < to.parts.size(); ++part) {
    std::size_t before = 0;
    for (auto& counts : place) before += std::exchange(counts[part], before);
    to.parts[part].points.resize(before);
  }
  parallel_for(chunks, [&](std::size_t chunk) {
    each_of(chunk, [&](std::size_t i, const Carrier& carrier) {
      to.parts[carrier.part].points[place[chunk][carrier.part]++] = carry_point(scan, i, carrier, scanner);
    });
  });
  return to;
}

}  // namespace asterism
