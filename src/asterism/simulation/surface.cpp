// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace asterism {
namespace {

const double kSmooth = std::cos(rad_from_deg(30));

/// Which triangles meet at each vertex: those of vertex v are triangles[first[v]] … triangles[first[v + 1] −
/// 1].
struct Meetings {
  std::vector<std::size_t> first;
  std::vector<std::size_t> triangles;
};

Meetings meetings_of(const TriangleMesh& mesh) {
  Meetings meetings;
  meetings.first.assign(mesh.vertices.size() + 1, 0);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) ++meetings.first[vertex + 1];
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) meetings.first[v + 1] += meetings.first[v];
  std::vector<std::size_t> next(meetings.first.begin(), meetings.first.end() - 1);
  meetings.triangles.resize(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) meetings.triangles[next[vertex]++] = t;
  }
  return meetings;
}

/// Each normal is the mean of those triangles around the corner that turn little from its own, by their area.
void add_smooth_triangles(const TriangleMesh& mesh, DrawnSurface& drawn) {
  const Meetings meetings = meetings_of(mesh);
  std::vector<Vec3> area, unit;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    area.push_back(area_vector(mesh, t));
    unit.push_back(area.back().normalized());
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (area[t].norm() == 0) continue;
    DrawnSurface::Triangle triangle;
    triangle.corner = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle.corner[k];
      Vec3 sum = Vec3::Zero();
      for (std::size_t m = meetings.first[vertex]; m < meetings.first[vertex + 1]; ++m) {
        const std::size_t other = meetings.triangles[m];
        if (unit[other].dot(unit[t]) >= kSmooth) sum += area[other];
      }
      triangle.normal[k] = sum.normalized();
    }
    drawn.triangles.push_back(triangle);
  }
}

/// Halves the longest edges until none is too long. Neighbours halve a shared edge at one and the same place.
void divide(DrawnSurface& drawn, double longest_mm) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves;
  const auto half_between = [&](std::uint32_t a, std::uint32_t b) {
    const auto [found, added] =
        halves.emplace(std::minmax(a, b), static_cast<std::uint32_t>(drawn.places.size()));
    if (added) drawn.places.emplace_back(0.5 * (drawn.places[a] + drawn.places[b]));
    return found->second;
  };
  for (std::size_t t = 0; t < drawn.triangles.size();) {
    const DrawnSurface::Triangle whole = drawn.triangles[t];
    std::size_t longest = 0;
    double length = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double edge = (drawn.places[whole.corner[k]] - drawn.places[whole.corner[(k + 1) % 3]]).norm();
      if (edge > length) {
        length = edge;
        longest = k;
      }
    }
    if (length <= longest_mm) {
      ++t;
      continue;
    }
    const std::size_t next = (longest + 1) % 3;
    const std::uint32_t middle = half_between(whole.corner[longest], whole.corner[next]);
    const Vec3 normal = whole.normal[longest] + whole.normal[next];
    DrawnSurface::Triangle one = whole, other = whole;
    one.corner[next] = other.corner[longest] = middle;
    one.normal[next] = other.normal[longest] = normal.normalized();
    drawn.triangles[t] = one;
    drawn.triangles.push_back(other);
  }
}

}  // namespace

DrawnSurface drawn_surface(const TriangleMesh& mesh, int carrier, double level, double longest_mm) {
  const TriangleMesh joined = welded(mesh);
  const MeshFacts facts = facts_of(joined);
  DrawnSurface drawn;
  drawn.carrier = carrier;
  drawn.places = joined.vertices;
  drawn.level = level;
  drawn.closed = facts.closed() && facts.volume_mm3 > 0;
  add_smooth_triangles(joined, drawn);
  if (longest_mm > 0) divide(drawn, longest_mm);
  return drawn;
}

}  // namespace asterism
