// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/surface_normals.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace asterism {
namespace {

/// A sum of unit normals that is shorter has no direction of its own.
constexpr double kShortestSum = 1e-9;

/// A triangle whose height is less than this share of its longest side is a line: what single precision of a
/// file makes of three corners in a row has a normal by chance.
constexpr double kThinnest = 1e-7;

/// Unit; zero where there is no area.
Vec3 normal_of(const TriangleMesh& mesh, std::size_t t) {
  const Vec3 twice = area_vector(mesh, t);
  double longest2 = 0;
  for (int k = 0; k < 3; ++k) {
    longest2 = std::max(longest2, (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).squaredNorm());
  }
  return twice.norm() > kThinnest * longest2 ? twice.normalized() : Vec3::Zero();
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

SurfaceNormals::SurfaceNormals(const TriangleMesh& surface) {
  const TriangleMesh mesh = welded(surface);
  corners_.assign(mesh.vertices.size(), Vec3::Zero());
  std::unordered_map<std::uint64_t, std::uint32_t> edge_between;
  edge_between.reserve(2 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3& normal = faces_.emplace_back(normal_of(mesh, t));
    auto& mine = edge_and_corner_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
      const auto [edge, is_new] = edge_between.emplace(key, static_cast<std::uint32_t>(edges_.size()));
      if (is_new) edges_.emplace_back(Vec3::Zero());
      edges_[edge->second] += normal;
      const Vec3& from = mesh.vertices[a];
      const Vec3& before = mesh.vertices[mesh.triangles[t][(k + 2) % 3]];
      corners_[a] += angle_between(mesh.vertices[b] - from, before - from) * normal;
      mine[k] = edge->second;
      mine[3 + k] = a;
    }
  }
}

Vec3 SurfaceNormals::at(std::size_t triangle, Feature feature) const {
  if (feature == Feature::Face) return faces_[triangle];
  const auto which = static_cast<std::size_t>(feature) - 1;
  const std::uint32_t index = edge_and_corner_[triangle][which];
  const Vec3& sum = which < 3 ? edges_[index] : corners_[index];
  const double length = sum.norm();
  return length > kShortestSum ? Vec3(sum / length) : faces_[triangle];
}

}  // namespace asterism
