// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/measurability.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

constexpr std::size_t kBlock = 64;      // samples looked at together: one word of a row
constexpr std::size_t kChunk = 16;      // viewpoints a task
constexpr double kGrazing = 0.0871557;  // cos 85°
constexpr double kOffSkin_mm = 0.05;    // a line of sight begins so far before the surface

/// A block's samples lie in a ball.
struct Block {
  Vec3 centre;
  double radius;
};

std::vector<Block> blocks_of(std::span<const SurfaceSample> samples) {
  std::vector<Block> blocks;
  for (std::size_t first = 0; first < samples.size(); first += kBlock) {
    const auto some = samples.subspan(first, std::min(kBlock, samples.size() - first));
    Vec3 low = some[0].at, high = some[0].at;
    for (const SurfaceSample& sample : some) {
      low = low.cwiseMin(sample.at);
      high = high.cwiseMax(sample.at);
    }
    Block block{0.5 * (low + high), 0};
    for (const SurfaceSample& sample : some) {
      block.radius = std::max(block.radius, (sample.at - block.centre).norm());
    }
    blocks.push_back(block);
  }
  return blocks;
}

/// The frustum's numbers.
struct Frame {
  Mat3 rotation;  // scanner_from_workpiece
  Vec3 origin, left_eye, right_eye;
  double tan_x, tan_y, near_mm, far_mm, min_cosine;
};

Frame frame_of(const Scanner& scanner, const RigidMotion& workpiece_from_scanner) {
  const Vec3 half(0.5 * scanner.baseline_mm, 0, 0);
  return {workpiece_from_scanner.rotation.toRotationMatrix().transpose(),
          workpiece_from_scanner.translation,
          workpiece_from_scanner * Vec3(-half),
          workpiece_from_scanner * half,
          0.5 * scanner.field_width_mm / scanner.stand_off_mm,
          0.5 * scanner.field_height_mm / scanner.stand_off_mm,
          scanner.near_mm,
          scanner.far_mm,
          std::cos(rad_from_deg(scanner.max_incidence_deg))};
}

bool faces(const SurfaceSample& sample, const Vec3& eye, double min_cosine) {
  const Vec3 way = eye - sample.at;
  return sample.normal.dot(way) >= min_cosine * way.norm();
}

LimitMask failing(const Frame& frame, const SurfaceSample& sample) {
  const Vec3 p = frame.rotation * (sample.at - frame.origin);
  LimitMask fails = 0;
  if (!(p.z() >= frame.near_mm && p.z() <= frame.far_mm)) fails |= mask_of(ScanLimit::Range);
  if (!(std::abs(p.x()) <= frame.tan_x * p.z() && std::abs(p.y()) <= frame.tan_y * p.z())) {
    fails |= mask_of(ScanLimit::Field);
  }
  if (!faces(sample, frame.origin, frame.min_cosine)) fails |= mask_of(ScanLimit::Incidence);
  if (!(faces(sample, frame.left_eye, kGrazing) && faces(sample, frame.right_eye, kGrazing))) {
    fails |= mask_of(ScanLimit::Sight);
  }
  return fails;
}

/// Can some of the block be within range and field?
bool may_hold(const Frame& frame, const Block& block, const AskedLimits& asked) {
  const Vec3 p = frame.rotation * (block.centre - frame.origin);
  const double r = block.radius;
  if (asked[ScanLimit::Range] && (p.z() + r < frame.near_mm || p.z() - r > frame.far_mm)) return false;
  if (!asked[ScanLimit::Field]) return true;
  const double deep = p.z() + r;
  return deep > 0 && std::abs(p.x()) - r <= frame.tan_x * deep && std::abs(p.y()) - r <= frame.tan_y * deep;
}

/// Takes out of a row what cannot be seen from one place.
void take_out_hidden_from(const Vec3& eye, std::span<const SurfaceSample> samples, const RayScene& hiding,
                          std::span<std::uint64_t> row) {
  std::vector<Vec3> from;
  std::vector<std::size_t> which;
  for_each_bit(row, [&](std::size_t i) {
    from.push_back(samples[i].at + kOffSkin_mm * samples[i].normal);
    which.push_back(i);
  });
  std::vector<std::uint8_t> hidden(from.size());
  hiding.blocked(from, eye, hidden);
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (hidden[i] != 0) clear_bit(row, which[i]);
  }
}

template <class Work>
void for_chunks(std::size_t count, const Work& work) {
  parallel_for((count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t last = std::min(count, (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i) work(i);
  });
}

}  // namespace

LimitMask failing_limits(const Scanner& scanner, const RigidMotion& scanner_from_workpiece,
                         const SurfaceSample& sample) {
  return failing(frame_of(scanner, scanner_from_workpiece.inverse()), sample);
}

BitRows measured_samples(std::span<const Viewpoint> views, std::span<const SurfaceSample> samples,
                         const Scanner& scanner, const RayScene& hiding, const AskedLimits& asked) {
  const std::vector<Block> blocks = blocks_of(samples);
  LimitMask counts = 0;
  for (const ScanLimit limit : {ScanLimit::Range, ScanLimit::Field, ScanLimit::Incidence, ScanLimit::Sight}) {
    if (asked[limit]) counts |= mask_of(limit);
  }
  BitRows rows(views.size(), samples.size());
  for_chunks(views.size(), [&](std::size_t view) {
    const Frame frame = frame_of(scanner, views[view].workpiece_from_scanner);
    const std::span<std::uint64_t> row = rows.row(view);
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      if (!may_hold(frame, blocks[block], asked)) continue;
      const std::size_t last = std::min(samples.size(), (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < last; ++i) {
        if ((failing(frame, samples[i]) & counts) == 0) set_bit(row, i);
      }
    }
    if (!asked[ScanLimit::Sight] || hiding.empty()) return;
    take_out_hidden_from(frame.left_eye, samples, hiding, row);
    take_out_hidden_from(frame.right_eye, samples, hiding, row);
  });
  return rows;
}

void take_out_hidden(std::span<const Viewpoint> views, std::span<const SurfaceSample> samples,
                     const Scanner& scanner, const RayScene& hiding, BitRows& rows) {
  if (hiding.empty()) return;
  for_chunks(views.size(), [&](std::size_t view) {
    const Frame frame = frame_of(scanner, views[view].workpiece_from_scanner);
    take_out_hidden_from(frame.left_eye, samples, hiding, rows.row(view));
    take_out_hidden_from(frame.right_eye, samples, hiding, rows.row(view));
  });
}

bool in_sight(const Scanner& scanner, const RigidMotion& workpiece_from_scanner, const SurfaceSample& sample,
              const RayScene& hiding) {
  if (hiding.empty()) return true;
  const Frame frame = frame_of(scanner, workpiece_from_scanner);
  const Vec3 from = sample.at + kOffSkin_mm * sample.normal;
  return !hiding.blocked(from, frame.left_eye) && !hiding.blocked(from, frame.right_eye);
}

bool is_clear(const Scanner& scanner, const Vec3& origin, const SurfaceTree& surface) {
  return !surface.nearest(origin, scanner.clearance_mm);
}

}  // namespace asterism
