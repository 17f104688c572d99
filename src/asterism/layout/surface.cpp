// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vec3 radial(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad), 0}; }

/// The angle within [from, to] that is nearest to that of (x, y).
double nearest_angle(double x, double y, double from_rad, double to_rad) {
  const double angle = x == 0 && y == 0 ? from_rad : std::atan2(y, x);
  const double after = angle - from_rad - kTurn * std::floor((angle - from_rad) / kTurn);  // in [0, turn)
  const double span = to_rad - from_rad;
  if (after <= span) return from_rad + after;
  return after - span < kTurn - after ? to_rad : from_rad;
}

Place nearest_on(const CylinderSide& side, const Vec3& point) {
  const Vec3 off = point - side.base_mm;
  const Vec3 outwards = radial(nearest_angle(off.x(), off.y(), side.from_rad, side.to_rad));
  const Vec3 up(0, 0, std::clamp(off.z(), 0.0, side.height_mm));
  return {side.base_mm + side.radius_mm * outwards + up, outwards};
}

Place nearest_on(const Annulus& ring, const Vec3& point) {
  const Vec3 off = point - ring.centre_mm;
  const Vec3 along = radial(nearest_angle(off.x(), off.y(), ring.from_rad, ring.to_rad));
  // Beyond an edge of the sector the nearest place is the foot of the perpendicular on that edge.
  const double distance = std::clamp(along.dot(off), ring.inner_radius_mm, ring.outer_radius_mm);
  return {ring.centre_mm + distance * along, Vec3::UnitZ()};
}

Place nearest_on(const Plate& plate, const Vec3& point) {
  Vec3 in_plate = plate.body_from_plate.inverse() * point;
  in_plate.x() = std::clamp(in_plate.x(), -0.5 * plate.width_mm, 0.5 * plate.width_mm);
  in_plate.y() = std::clamp(in_plate.y(), -0.5 * plate.height_mm, 0.5 * plate.height_mm);
  in_plate.z() = 0;
  return {plate.body_from_plate * in_plate, plate.body_from_plate.rotation * Vec3::UnitZ()};
}

Place nearest_on(const CylinderRoom& room, const Vec3& point) {
  Vec3 off = point - room.base_mm;
  const double radius = std::hypot(off.x(), off.y());
  if (radius > room.radius_mm) off.head<2>() *= room.radius_mm / radius;
  off.z() = std::clamp(off.z(), 0.0, room.height_mm);
  const Vec3 outwards = radius > 0 ? Vec3(off.x(), off.y(), 0).normalized() : Vec3(Vec3::Zero());
  const Vec3 normal = std::sin(room.tilt_rad) * outwards + std::cos(room.tilt_rad) * Vec3::UnitZ();
  return {room.base_mm + off, radius > 0 ? normal : Vec3(Vec3::UnitZ())};
}

double area_of(const CylinderSide& side) {
  return (side.to_rad - side.from_rad) * side.radius_mm * side.height_mm;
}
double area_of(const Annulus& ring) {
  return 0.5 * (ring.to_rad - ring.from_rad) *
         (ring.outer_radius_mm * ring.outer_radius_mm - ring.inner_radius_mm * ring.inner_radius_mm);
}
double area_of(const Plate& plate) { return plate.width_mm * plate.height_mm; }
double area_of(const CylinderRoom& room) { return 0.5 * kTurn * room.radius_mm * room.radius_mm; }

Vec3 random_in(const CylinderSide& side, RandomStream& random) {
  const double angle = random.uniform(side.from_rad, side.to_rad);
  return side.base_mm + side.radius_mm * radial(angle) + Vec3(0, 0, random.uniform(0, side.height_mm));
}
Vec3 random_in(const Annulus& ring, RandomStream& random) {
  const double angle = random.uniform(ring.from_rad, ring.to_rad);
  const double inner = ring.inner_radius_mm * ring.inner_radius_mm;
  const double outer = ring.outer_radius_mm * ring.outer_radius_mm;
  return ring.centre_mm + std::sqrt(random.uniform(inner, outer)) * radial(angle);
}
Vec3 random_in(const Plate& plate, RandomStream& random) {
  const double x = random.uniform(-0.5, 0.5) * plate.width_mm;
  return plate.body_from_plate * Vec3(x, random.uniform(-0.5, 0.5) * plate.height_mm, 0);
}
Vec3 random_in(const CylinderRoom& room, RandomStream& random) {
  const double angle = random.uniform(0, kTurn);
  const double radius = room.radius_mm * std::sqrt(random.uniform());
  return room.base_mm + radius * radial(angle) + Vec3(0, 0, random.uniform(0, room.height_mm));
}

}  // namespace

Place nearest_place(const DeployableSurface& surface, const Vec3& point) {
  require(!surface.patches.empty(), "a surface has a patch");
  Place nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface.patches.size(); ++i) {
    Place place =
        std::visit([&](const auto& patch) { return nearest_on(patch, point); }, surface.patches[i].patch);
    const double distance = (place.position_mm - point).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = place;
    nearest.patch = i;
  }
  return nearest;
}

std::array<Vec3, 2> along_surface(const Vec3& normal) {
  const Vec3 aside = std::abs(normal.z()) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  const Vec3 u = normal.cross(aside).normalized();
  return {u, normal.cross(u)};
}

bool kept_out(const DeployableSurface& surface, const Vec3& point, double clearance_mm) {
  return std::any_of(surface.keep_outs.begin(), surface.keep_outs.end(), [&](const KeepOut& keep_out) {
    return distance_from(keep_out.shape, keep_out.body_from_shape.inverse() * point) < clearance_mm;
  });
}

std::optional<Place> nearest_allowed_place(const DeployableSurface& surface, const Vec3& point,
                                           double clearance_mm) {
  const Place start = nearest_place(surface, point);
  if (!kept_out(surface, start.position_mm, clearance_mm)) return start;
  const auto [u, v] = along_surface(start.normal);
  const Bounds bounds = bounds_of(surface);
  const double farthest = (bounds.highest - bounds.lowest).norm();
  for (double step = 1.0; step <= farthest; step *= 1.25) {
    std::optional<Place> best;
    double best_off = std::numeric_limits<double>::infinity();
    for (int direction = 0; direction < 16; ++direction) {
      const double angle = kTurn * direction / 16;
      const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
      double allowed = step;
      if (kept_out(surface, nearest_place(surface, start.position_mm + step * way).position_mm,
                   clearance_mm)) {
        continue;
      }
      double forbidden = step / 1.25;
      for (int halving = 0; halving < 20; ++halving) {
        const double middle = 0.5 * (allowed + forbidden);
        const Place place = nearest_place(surface, start.position_mm + middle * way);
        (kept_out(surface, place.position_mm, clearance_mm) ? forbidden : allowed) = middle;
      }
      const Place place = nearest_place(surface, start.position_mm + allowed * way);
      const double off = (place.position_mm - start.position_mm).norm();
      if (!(off < best_off)) continue;
      best_off = off;
      best = place;
    }
    if (best) return best;
  }
  return std::nullopt;
}

double area_mm2(const Patch& patch) {
  return std::visit([](const auto& kind) { return area_of(kind); }, patch);
}

std::optional<Place> random_place(const DeployableSurface& surface, double clearance_mm,
                                  RandomStream& random) {
  require(!surface.patches.empty(), "a surface has a patch");
  double whole = 0;
  for (const NamedPatch& named : surface.patches) whole += area_mm2(named.patch);
  for (int tries = 0; tries < 1000; ++tries) {
    double left = whole * random.uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < surface.patches.size() && left >= area_mm2(surface.patches[chosen].patch)) {
      left -= area_mm2(surface.patches[chosen++].patch);
    }
    const Patch& patch = surface.patches[chosen].patch;
    const Vec3 point = std::visit([&](const auto& kind) { return random_in(kind, random); }, patch);
    if (kept_out(surface, point, clearance_mm)) continue;
    Place place = std::visit([&](const auto& kind) { return nearest_on(kind, point); }, patch);
    place.patch = chosen;
    return place;
  }
  return std::nullopt;
}

Bounds bounds_of(const DeployableSurface& surface) {
  Bounds bounds = {Vec3::Constant(std::numeric_limits<double>::infinity()),
                   Vec3::Constant(-std::numeric_limits<double>::infinity())};
  const auto hold = [&](const Vec3& point) {
    bounds.lowest = bounds.lowest.cwiseMin(point);
    bounds.highest = bounds.highest.cwiseMax(point);
  };
  const auto hold_cylinder = [&](const Vec3& base, double radius, double height) {
    hold(base - Vec3(radius, radius, 0));
    hold(base + Vec3(radius, radius, height));
  };
  for (const NamedPatch& named : surface.patches) {
    if (const auto* side = std::get_if<CylinderSide>(&named.patch)) {
      hold_cylinder(side->base_mm, side->radius_mm, side->height_mm);
    } else if (const auto* ring = std::get_if<Annulus>(&named.patch)) {
      hold_cylinder(ring->centre_mm, ring->outer_radius_mm, 0);
    } else if (const auto* room = std::get_if<CylinderRoom>(&named.patch)) {
      hold_cylinder(room->base_mm, room->radius_mm, room->height_mm);
    } else if (const auto* plate = std::get_if<Plate>(&named.patch)) {
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          hold(plate->body_from_plate * Vec3(x * plate->width_mm, y * plate->height_mm, 0));
        }
      }
    }
  }
  return bounds;
}

}  // namespace asterism
