// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <unordered_map>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// An edge with the way a triangle runs along it.
struct Run {
  std::uint32_t low, high;
  bool upwards;
  [[nodiscard]] bool along(const Run& other) const { return low == other.low && high == other.high; }
};

std::vector<Run> runs_of(const TriangleMesh& mesh) {
  std::vector<Run> runs;
  runs.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const bool is_line =
        triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    for (std::size_t k = 0; k < 3 && !is_line; ++k) {
      const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
      runs.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(runs.begin(), runs.end(),
            [](const Run& a, const Run& b) { return a.low < b.low || (a.low == b.low && a.high < b.high); });
  return runs;
}

void count_edges(const TriangleMesh& mesh, MeshFacts& facts) {
  const std::vector<Run> runs = runs_of(mesh);
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i + 1;
    while (end < runs.size() && runs[end].along(runs[i])) ++end;
    if (end - i == 1) ++facts.boundary_edges;
    if (end - i > 2) ++facts.non_manifold_edges;
    if (end - i == 2 && runs[i].upwards == runs[i + 1].upwards) ++facts.flipped_edges;
    i = end;
  }
}

/// A place by the bits of its coordinates (0 and −0 alike).
struct PlaceKey {
  std::array<std::uint64_t, 3> bits;
  explicit PlaceKey(const Vec3& place) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = place(axis) + 0.0;
      std::memcpy(&bits[static_cast<std::size_t>(axis)], &value, sizeof value);
    }
  }
  [[nodiscard]] bool operator==(const PlaceKey&) const = default;
};
struct PlaceHash {
  std::size_t operator()(const PlaceKey& key) const {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const std::uint64_t word : key.bits) hash = (hash ^ word ^ word >> 29) * 0x9e3779b97f4a7c15U;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

}  // namespace

Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle) {
  const Vec3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a);
}

MeshFacts facts_of(const TriangleMesh& mesh) {
  MeshFacts facts;
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  if (mesh.empty()) return facts;
  facts.lowest = facts.highest = mesh.corner(0, 0);
  const Vec3 origin = facts.lowest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 twice = area_vector(mesh, t);
    facts.area_mm2 += 0.5 * twice.norm();
    facts.volume_mm3 += twice.dot(mesh.corner(t, 0) - origin) / 6;
    facts.degenerate += twice.norm() == 0;
    for (int k = 0; k < 3; ++k) {
      facts.lowest = facts.lowest.cwiseMin(mesh.corner(t, k));
      facts.highest = facts.highest.cwiseMax(mesh.corner(t, k));
    }
  }
  count_edges(mesh, facts);
  return facts;
}

TriangleMesh moved(TriangleMesh mesh, const RigidMotion& a_from_b) {
  for (Vec3& vertex : mesh.vertices) vertex = a_from_b * vertex;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  require(factor > 0, "a surface is scaled by a positive factor");
  for (Vec3& vertex : mesh.vertices) vertex *= factor;
  return mesh;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh joined;
  std::unordered_map<PlaceKey, std::uint32_t, PlaceHash> places;
  places.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> now(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(joined.vertices.size());
    const auto [found, added] = places.emplace(PlaceKey(mesh.vertices[i]), next);
    if (added) joined.vertices.push_back(mesh.vertices[i]);
    now[i] = found->second;
  }
  joined.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) joined.triangles.push_back({now[t[0]], now[t[1]], now[t[2]]});
  return joined;
}

TriangleMesh surface_of_revolution(const std::vector<ProfilePoint>& profile, int sides) {
  require(profile.size() >= 2 && sides >= 3, "a turned profile has two points, its surface three sides");
  TriangleMesh mesh;
  std::vector<std::uint32_t> first(profile.size());  // of each ring; a tip has one vertex
  for (std::size_t i = 0; i < profile.size(); ++i) {
    first[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    const int around = profile[i].radius_mm > 0 ? sides : 1;
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.vertices.emplace_back(profile[i].radius_mm * std::cos(angle),
                                 profile[i].radius_mm * std::sin(angle), profile[i].height_mm);
    }
  }
  const auto vertex = [&](std::size_t i, int k) {
    return profile[i].radius_mm > 0 ? first[i] + static_cast<std::uint32_t>(k % sides) : first[i];
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::size_t j = (i + 1) % profile.size();
    for (int k = 0; k < sides; ++k) {
      const std::uint32_t a = vertex(i, k), b = vertex(i, k + 1), c = vertex(j, k + 1), d = vertex(j, k);
      if (a != b) mesh.triangles.push_back({a, b, c});
      if (c != d) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

}  // namespace asterism
