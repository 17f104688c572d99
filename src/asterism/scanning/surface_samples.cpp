// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/cell/shape_distance.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kPurpose = 0x5A3F1E;

/// Every third bit of a number of ten bits.
std::uint32_t spread(std::uint32_t ten_bits) {
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 10; ++i) bits |= ((ten_bits >> i) & 1U) << (3 * i);
  return bits;
}

/// Places in the order of a curve through space (Morton's): neighbours along it are neighbours in space.
std::vector<std::uint32_t> order_along_curve(const TriangleMesh& surface) {
  const MeshFacts facts = facts_of(surface);
  const double edge = std::max((facts.highest - facts.lowest).maxCoeff(), 1e-9);
  std::vector<std::uint32_t> code(surface.triangles.size());
  for (std::size_t t = 0; t < code.size(); ++t) {
    const Vec3 middle = (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) / 3.0;
    const Vec3 cell = 1023.0 * (middle - facts.lowest) / edge;
    code[t] = spread(static_cast<std::uint32_t>(cell.x())) |
              spread(static_cast<std::uint32_t>(cell.y())) << 1 |
              spread(static_cast<std::uint32_t>(cell.z())) << 2;
  }
  std::vector<std::uint32_t> order(code.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return code[a] < code[b]; });
  return order;
}

double weight_of(const Vec3& at, std::span<const ScanRegion> regions) {
  double weight = 1;
  for (const ScanRegion& region : regions) {
    if (distance_from(region.shape, region.workpiece_from_shape.inverse() * at) <= 0) weight = region.weight;
  }
  return weight;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const TriangleMesh& surface, std::size_t count,
                                          std::span<const ScanRegion> regions, std::uint64_t seed) {
  require(count > 0, "a surface is sampled at least once");
  const std::vector<std::uint32_t> order = order_along_curve(surface);
  std::vector<double> until(order.size());  // area up to and with each triangle
  double area = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    until[i] = area += 0.5 * area_vector(surface, order[i]).norm();
  if (!(area > 0)) throw InputError("the surface has no area; a part to be scanned has triangles");

  std::vector<SurfaceSample> samples(count);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(seed, i, kPurpose);
    const double place = area * (static_cast<double>(i) + random.uniform()) / static_cast<double>(count);
    while (at + 1 < until.size() && until[at] <= place) ++at;
    const double before = at > 0 ? until[at - 1] : 0.0;
    // Where the place lies in its triangle's stretch tells how far from the first corner: a large triangle
    // that holds many samples has them spread, too.
    const double share = std::clamp((place - before) / (until[at] - before), 0.0, 1.0);
    const double along = std::sqrt(share), across = random.uniform();
    const std::uint32_t triangle = order[at];
    const Vec3 side = (1 - across) * surface.corner(triangle, 1) + across * surface.corner(triangle, 2);
    SurfaceSample& sample = samples[i];
    sample.at = (1 - along) * surface.corner(triangle, 0) + along * side;
    sample.normal = area_vector(surface, triangle).normalized();
    sample.triangle = triangle;
    sample.area_mm2 = area / static_cast<double>(count);
    sample.weight = weight_of(sample.at, regions);
  }
  return samples;
}

}  // namespace asterism
