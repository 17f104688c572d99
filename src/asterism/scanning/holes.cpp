// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/holes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/neighbours.hpp"

namespace asterism {
namespace {

constexpr std::size_t kLinks = 8;  // a place on a plane has six around it, and some luck
constexpr std::size_t kLookAt = 3 * kLinks;
/// No link is longer than so many edges of the square that a sample stands for: parts that do not touch stay
/// apart.
constexpr double kLongestLink = 3;

/// Sets that are joined step by step; each is named by its lowest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t of(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::vector<std::uint32_t> links_of(std::uint32_t from, std::span<const SurfaceSample> samples,
                                    const Neighbours& tree, double lowest_cosine) {
  std::vector<std::uint32_t> links;
  const SurfaceSample& here = samples[from];
  const double longest = kLongestLink * std::sqrt(here.area_mm2);
  for (const std::size_t other : tree.few_nearest(here.at, kLookAt)) {
    if ((samples[other].at - here.at).norm() > longest || links.size() == kLinks) break;
    if (other == from || samples[other].normal.dot(here.normal) < lowest_cosine) continue;
    links.push_back(static_cast<std::uint32_t>(other));
  }
  return links;
}

std::size_t farthest_from(const Vec3& place, const Hole& hole, std::span<const SurfaceSample> samples) {
  return *std::max_element(hole.samples.begin(), hole.samples.end(), [&](auto a, auto b) {
    return (samples[a].at - place).squaredNorm() < (samples[b].at - place).squaredNorm();
  });
}

void measure(Hole& hole, std::span<const SurfaceSample> samples) {
  Vec3 facing = Vec3::Zero();
  for (const std::uint32_t s : hole.samples) {
    hole.area_mm2 += samples[s].area_mm2;
    hole.centre += samples[s].area_mm2 * samples[s].at;
    facing += samples[s].area_mm2 * samples[s].normal;
  }
  hole.centre /= hole.area_mm2;
  constexpr double kFacesAllWays = 0.1;  // a mean of unit normals that is shorter points nowhere
  if (facing.norm() > kFacesAllWays * hole.area_mm2) hole.normal = facing.normalized();
  const Vec3& end = samples[farthest_from(hole.centre, hole, samples)].at;
  hole.across_mm = (samples[farthest_from(end, hole, samples)].at - end).norm();
}

}  // namespace

std::vector<Hole> holes_of(std::span<const SurfaceSample> samples, std::span<const std::uint8_t> measured,
                           double max_turn_deg) {
  require(samples.size() == measured.size(), "each sample is measured or not");
  std::vector<Vec3> places;
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    places.push_back(samples[i].at);
    if (measured[i] == 0 && samples[i].worth() > 0) open.push_back(i);
  }
  const Neighbours tree(places);
  std::vector<std::vector<std::uint32_t>> links(open.size());
  parallel_for(open.size(), [&](std::size_t i) {
    links[i] = links_of(open[i], samples, tree, std::cos(rad_from_deg(max_turn_deg)));
  });
  Sets sets(samples.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    for (const std::uint32_t other : links[i]) {
      if (measured[other] == 0 && samples[other].worth() > 0) sets.join(open[i], other);
    }
  }
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> hole_of(samples.size(), kNone);
  std::vector<Hole> holes;
  for (const std::uint32_t i : open) {
    std::size_t& hole = hole_of[sets.of(i)];
    if (hole == kNone) {
      hole = holes.size();
      holes.emplace_back();
    }
    holes[hole].samples.push_back(i);
  }
  for (Hole& hole : holes) measure(hole, samples);
  std::stable_sort(holes.begin(), holes.end(),
                   [](const Hole& a, const Hole& b) { return a.area_mm2 > b.area_mm2; });
  return holes;
}

}  // namespace asterism
