// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/display_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// Which of the six directions along the axes a vertex's normal is nearest to: both faces of a thin wall lie
/// in one cell, yet must not become one.
std::vector<std::int64_t> facings(const TriangleMesh& surface) {
  std::vector<Vec3> normals(surface.vertices.size(), Vec3::Zero());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t corner : surface.triangles[t]) normals[corner] += area_vector(surface, t);
  std::vector<std::int64_t> facing;
  facing.reserve(normals.size());
  for (const Vec3& normal : normals) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    facing.push_back(2 * axis + (normal[axis] < 0 ? 1 : 0));
  }
  return facing;
}

using Key = std::array<std::int64_t, 4>;

std::vector<Key> keys_of(const TriangleMesh& surface, const std::vector<std::int64_t>& facing,
                         double cell_mm) {
  std::vector<Key> keys;
  keys.reserve(surface.vertices.size());
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const Vec3 cell = (surface.vertices[i] / cell_mm).array().floor();
    keys.push_back({static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                    static_cast<std::int64_t>(cell.z()), facing[i]});
  }
  return keys;
}

double larger(double a, double b) { return std::isnan(a) ? b : std::isnan(b) ? a : std::max(a, b); }

DisplayMesh clustered(const TriangleMesh& surface, const std::vector<double>& value,
                      const std::vector<Key>& keys) {
  std::vector<std::uint32_t> order(surface.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  DisplayMesh coarse;
  std::vector<std::uint32_t> cluster(surface.vertices.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    Vec3 sum = Vec3::Zero();
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (; end < order.size() && keys[order[end]] == keys[order[first]]; ++end) {
      cluster[order[end]] = static_cast<std::uint32_t>(coarse.surface.vertices.size());
      sum += surface.vertices[order[end]];
      if (!value.empty()) largest = larger(largest, value[order[end]]);
    }
    coarse.surface.vertices.push_back(sum / static_cast<double>(end - first));
    if (!value.empty()) coarse.value.push_back(largest);
    first = end;
  }
  std::set<std::array<std::uint32_t, 3>> written;
  for (const auto& triangle : surface.triangles) {
    std::array<std::uint32_t, 3> corners = {cluster[triangle[0]], cluster[triangle[1]], cluster[triangle[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (written.insert(corners).second) coarse.surface.triangles.push_back(corners);
  }
  return coarse;
}

}  // namespace

DisplayMesh thinned(const TriangleMesh& surface, const std::vector<double>& value, std::size_t most) {
  require(most > 0, "a surface is thinned to some triangles");
  require(value.empty() || value.size() == surface.vertices.size(), "a mesh has a value a vertex or none");
  if (surface.triangles.size() <= most) return {surface, value, 0};
  const std::vector<std::int64_t> facing = facings(surface);
  // A cell of a plane becomes two triangles; the facts' area sets where to begin.
  const double start_mm = std::sqrt(2 * facts_of(surface).area_mm2 / static_cast<double>(most));
  for (double cell_mm = std::max(start_mm, 1e-3);; cell_mm *= 1.2) {
    DisplayMesh coarse = clustered(surface, value, keys_of(surface, facing, cell_mm));
    if (coarse.surface.triangles.size() > most) continue;
    coarse.cell_mm = cell_mm;
    return coarse;
  }
}

}  // namespace asterism
