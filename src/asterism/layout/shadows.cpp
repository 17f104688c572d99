// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/shadows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

#include "asterism/layout/surface.hpp"

namespace asterism {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Box of a patch's own coordinates, all in mm: along an arc its length.
struct Box3 {
  Vec3 low, high;
};

/// How far along the arc a direction is; what lies beyond it belongs to its nearer end.
double along_arc(double x, double y, double from_rad, double to_rad) {
  const double angle = std::atan2(y, x) - from_rad;
  const double after = angle - kTurn * std::floor(angle / kTurn);
  const double span = to_rad - from_rad;
  if (after <= span) return after;
  return after - span < kTurn - after ? span : 0.0;
}
Vec3 radial(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad), 0}; }

Box3 box_of(const CylinderSide& side) {
  return {Vec3::Zero(), {side.radius_mm * (side.to_rad - side.from_rad), side.height_mm, 0}};
}
Vec3 inside(const CylinderSide& side, const Vec3& point) {
  const Vec3 off = point - side.base_mm;
  return {side.radius_mm * along_arc(off.x(), off.y(), side.from_rad, side.to_rad), off.z(), 0};
}
Vec3 outside(const CylinderSide& side, const Vec3& own) {
  return side.base_mm + side.radius_mm * radial(side.from_rad + own.x() / side.radius_mm) +
         Vec3(0, 0, own.y());
}

Box3 box_of(const Annulus& ring) {
  return {{0, ring.inner_radius_mm, 0},
          {ring.outer_radius_mm * (ring.to_rad - ring.from_rad), ring.outer_radius_mm, 0}};
}
Vec3 inside(const Annulus& ring, const Vec3& point) {
  const Vec3 off = point - ring.centre_mm;
  return {ring.outer_radius_mm * along_arc(off.x(), off.y(), ring.from_rad, ring.to_rad),
          std::hypot(off.x(), off.y()), 0};
}
Vec3 outside(const Annulus& ring, const Vec3& own) {
  return ring.centre_mm + own.y() * radial(ring.from_rad + own.x() / ring.outer_radius_mm);
}

Box3 box_of(const Plate& plate) {
  const Vec3 half(0.5 * plate.width_mm, 0.5 * plate.height_mm, 0);
  return {-half, half};
}
Vec3 inside(const Plate& plate, const Vec3& point) { return plate.body_from_plate.inverse() * point; }
Vec3 outside(const Plate& plate, const Vec3& own) { return plate.body_from_plate * own; }

Box3 box_of(const CylinderRoom& room) {
  return {{-room.radius_mm, -room.radius_mm, 0}, {room.radius_mm, room.radius_mm, room.height_mm}};
}
Vec3 inside(const CylinderRoom& room, const Vec3& point) { return point - room.base_mm; }
Vec3 outside(const CylinderRoom& room, const Vec3& own) { return room.base_mm + own; }

constexpr double kGrowth = 1.05;  // of the step, until the places are few enough

}  // namespace

Shadows::Grid Shadows::grid_of(const NamedPatch& patch, double step_mm) {
  const Box3 box = std::visit([](const auto& kind) { return box_of(kind); }, patch.patch);
  Grid grid{{{patch}, {}}, box.low, box.high - box.low, {}, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const double size = grid.size(static_cast<Eigen::Index>(k));
    grid.count[k] = size > 0 ? static_cast<std::size_t>(std::ceil(size / step_mm)) + 1 : 1;
  }
  return grid;
}

Target Shadows::target_at(const Grid& grid, std::size_t place, double diameter_mm) const {
  Vec3 own = grid.low;
  std::size_t rest = place;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const std::size_t at = rest % grid.count[k];
    rest /= grid.count[k];
    if (grid.count[k] > 1) {
      own(axis) += grid.size(axis) * static_cast<double>(at) / static_cast<double>(grid.count[k] - 1);
    }
  }
  const Vec3 point =
      std::visit([&](const auto& kind) { return outside(kind, own); }, grid.patch.patches[0].patch);
  const Place stands = nearest_place(grid.patch, point);  // a corner of a room's box lies beyond the room
  Target target;
  target.position = stands.position_mm;
  target.normal = stands.normal;
  target.diameter_mm = diameter_mm;
  return target;
}

Shadows::Shadows(const DeployableSurface& surface, double diameter_mm, const Occlusion& occlusion,
                 std::size_t carrier, std::span<const std::vector<RigidMotion>> poses, std::size_t places)
    : surface_(surface), step_mm_(0.5 * diameter_mm) {
  if (occlusion.empty()) return;
  for (;; step_mm_ *= kGrowth) {
    grids_.clear();
    places_ = 0;
    bool coarsest = true;
    for (const NamedPatch& patch : surface.patches) {
      Grid grid = grid_of(patch, step_mm_);
      grid.first = places_;
      places_ += grid.count[0] * grid.count[1] * grid.count[2];
      coarsest = coarsest && step_mm_ >= grid.size.maxCoeff();
      grids_.push_back(std::move(grid));
    }
    if (places_ <= places || coarsest) break;
  }
  words_ = (2 * poses.size() + 63) / 64;
  hidden_.assign(places_ * words_, 0);
  for (const Grid& grid : grids_) {
    const std::size_t count = grid.count[0] * grid.count[1] * grid.count[2];
    for (std::size_t begin = 0; begin < count; begin += kMaxTargets) {
      std::vector<Target> targets;
      for (std::size_t i = begin; i < std::min(count, begin + kMaxTargets); ++i) {
        targets.push_back(target_at(grid, i, diameter_mm));
      }
      const MotionVisibility seen = occlusion.unhidden_targets(targets, carrier, poses);
      for (std::size_t sight = 0; sight < 2 * poses.size(); ++sight) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
          if ((seen.seen[sight / 2][sight % 2] >> i & 1U) != 0) continue;
          hidden_[(grid.first + begin + i) * words_ + sight / 64] |= std::uint64_t{1} << sight % 64;
        }
      }
    }
  }
}

std::array<std::size_t, 4> Shadows::places_around(const Grid& grid, const Vec3& point) {
  const Vec3 own =
      std::visit([&](const auto& kind) { return inside(kind, point); }, grid.patch.patches[0].patch);
  std::array<std::pair<double, std::size_t>, 3> steps;  // how far beyond the lower corner; one place further
  std::size_t place = grid.first, stride = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    steps[k] = {0.0, 0};
    if (grid.count[k] > 1) {
      const auto last = static_cast<double>(grid.count[k] - 1);
      const double at = std::clamp((own(axis) - grid.low(axis)) / grid.size(axis) * last, 0.0, last);
      const double low = std::min(std::floor(at), last - 1);
      place += stride * static_cast<std::size_t>(low);
      steps[k] = {at - low, stride};
    }
    stride *= grid.count[k];
  }
  std::sort(steps.begin(), steps.end(), std::greater<>());
  return {place, place + steps[0].second, place + steps[0].second + steps[1].second,
          place + steps[0].second + steps[1].second + steps[2].second};
}

MotionVisibility Shadows::unhidden_of(MotionVisibility seen, std::span<const Target> targets) const {
  if (empty()) return seen;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Vec3& point = targets[i].position;
    const Grid& grid = grids_[surface_.patches.size() > 1 ? nearest_place(surface_, point).patch : 0];
    const auto around = places_around(grid, point);
    for (std::size_t word = 0; word < words_; ++word) {
      std::uint64_t bits = 0;
      for (const std::size_t place : around) bits |= hidden_[place * words_ + word];
      for (; bits != 0; bits &= bits - 1) {
        const std::size_t sight = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
        seen.seen[sight / 2][sight % 2] &= ~(TargetMask{1} << i);
      }
    }
  }
  return seen;
}

}  // namespace asterism
