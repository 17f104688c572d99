// SPDX-License-Identifier: Apache-2.0
#include "asterism/evaluation/verified_body.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "asterism/core/result.hpp"
#include "asterism/geometry/point_sets.hpp"

namespace asterism {
namespace {

std::size_t mover_named(const Cell& cell, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cell.movers.size(); ++i) {
    if (cell.movers[i].body.name == name) return i;
    names.push_back(cell.movers[i].body.name);
  }
  throw InputError(cell.name,
                   fmt::format("verification asks for body `{}`, which is not there; bodies are: {}", name,
                               fmt::join(names, ", ")));
}

std::vector<WorkPoint> named_points(const Cell& cell, const std::string& body) {
  if (!cell.verification.points.empty()) return cell.verification.points;
  if (cell.layout && cell.layout->body == body && !cell.layout->points.empty()) return cell.layout->points;
  if (cell.workpiece && cell.workpiece->body == body && cell.workpiece->surface)
    return corners_of_part(*cell.workpiece);
  return {};
}

}  // namespace

VerifiedBody verification_of(const Cell& cell) {
  if (cell.movers.empty()) throw InputError(cell.name, "has no body whose pose could be verified");
  VerifiedBody verified;
  if (!cell.verification.body.empty()) {
    verified.mover = mover_named(cell, cell.verification.body);
  } else if (cell.platform) {
    verified.mover = mover_named(cell, cell.platform->body);
  }
  const Body& body = cell.movers[verified.mover].body;
  verified.points = {{"target centroid", centroid_of(positions_of(body.targets))},
                     {body.name + " origin", Vec3::Zero()}};
  for (WorkPoint& point : named_points(cell, body.name)) verified.points.push_back(std::move(point));
  return verified;
}

std::vector<WorkPoint> corners_of_part(const Solid& part) {
  if (part.surface->vertices.empty()) return {};
  Vec3 lowest = part.surface->vertices.front(), highest = lowest;
  for (const Vec3& vertex : part.surface->vertices) {
    lowest = lowest.cwiseMin(vertex);
    highest = highest.cwiseMax(vertex);
  }
  std::vector<WorkPoint> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? highest.x() : lowest.x(), i & 2 ? highest.y() : lowest.y(),
                      i & 4 ? highest.z() : lowest.z());
    corners.push_back({fmt::format("{} corner {}", part.name.empty() ? "part" : part.name, i + 1),
                       part.carrier_from_solid * corner});
  }
  return corners;
}

}  // namespace asterism
