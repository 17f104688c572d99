// SPDX-License-Identifier: Apache-2.0
#include "asterism/geometry/surface_tree.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/embree_scene.hpp"
#include "asterism/geometry/space_curve.hpp"
#include "asterism/geometry/surface_normals.hpp"

namespace asterism {
namespace {

/// A triangle as the search wants it, in the tree's own frame.
struct Face {
  Vec3 a, ab, ac, normal;
  std::size_t number;  // in the surface as given
};

struct Foot {
  double mm2;
  Vec3 at;
  Feature feature;
};

Foot foot_on_edge(const Vec3& from_a, const Vec3& along, double share, Feature feature) {
  const Vec3 at = share * along;
  return {(from_a - at).squaredNorm(), at, feature};
}

/// The point of a triangle that is nearest to `from_a` (both as seen from its corner a), by the region in
/// whose prism the point lies (Ericson, Real-Time Collision Detection (2005) 5.1.5).
Foot foot_on(const Face& face, const Vec3& from_a) {
  const Vec3 &ab = face.ab, &ac = face.ac;
  const double d1 = ab.dot(from_a), d2 = ac.dot(from_a);
  if (d1 <= 0 && d2 <= 0) return {from_a.squaredNorm(), Vec3::Zero(), Feature::CornerA};
  const Vec3 from_b = from_a - ab;
  const double d3 = ab.dot(from_b), d4 = ac.dot(from_b);
  if (d3 >= 0 && d4 <= d3) return {from_b.squaredNorm(), ab, Feature::CornerB};
  if (d1 * d4 - d3 * d2 <= 0 && d1 >= 0 && d3 <= 0) {
    return foot_on_edge(from_a, ab, d1 / (d1 - d3), Feature::EdgeAB);
  }
  const Vec3 from_c = from_a - ac;
  const double d5 = ab.dot(from_c), d6 = ac.dot(from_c);
  if (d6 >= 0 && d5 <= d6) return {from_c.squaredNorm(), ac, Feature::CornerC};
  if (d5 * d2 - d1 * d6 <= 0 && d2 >= 0 && d6 <= 0) {
    return foot_on_edge(from_a, ac, d2 / (d2 - d6), Feature::EdgeCA);
  }
  if (d3 * d6 - d5 * d4 <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    Foot foot = foot_on_edge(from_b, ac - ab, (d4 - d3) / ((d4 - d3) + (d5 - d6)), Feature::EdgeBC);
    foot.at += ab;
    return foot;
  }
  const double height = face.normal.dot(from_a);
  return {height * height, from_a - height * face.normal, Feature::Face};
}

/// The nearest triangle so far; of two equally near ones the first counts, so that the order in which they
/// are met does not matter.
struct Search {
  const std::vector<Face>* faces;
  Vec3 point;
  double rounding_mm;  // what single precision may make of a distance
  double best_mm2;
  std::size_t best = 0;
  bool found = false;
  Foot foot{};

  bool offer(std::size_t candidate) {
    const Face& face = (*faces)[candidate];
    const Vec3 from_a = point - face.a;
    const double height = face.normal.dot(from_a);
    if (height * height > best_mm2) return false;
    const Foot there = foot_on(face, from_a);
    if (there.mm2 > best_mm2 || (found && there.mm2 == best_mm2 && candidate >= best)) return false;
    best_mm2 = there.mm2;
    best = candidate;
    foot = there;
    found = true;
    return true;
  }
  /// No triangle that might count lies farther away for Embree.
  [[nodiscard]] float radius() const {
    return static_cast<float>((std::sqrt(best_mm2) + rounding_mm) * (1 + 1e-6));
  }
};

bool offer_to_search(RTCPointQueryFunctionArguments* asked) {
  auto* search = static_cast<Search*>(asked->userPtr);
  if (!search->offer(asked->primID)) return false;
  asked->query->radius = search->radius();
  return true;
}

constexpr std::size_t kChunk = 65536;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

struct SurfaceTree::Tree {
  Vec3 centre = Vec3::Zero();  // origin of the tree's frame: a part far off loses no digits
  double half_mm = 0;
  std::vector<Face> faces;  // those that have an area
  SurfaceNormals normals;
  RTCScene scene;

  explicit Tree(const TriangleMesh& surface) : normals(surface), scene(rtcNewScene(embree_device())) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    if (!surface.empty()) add_faces(surface);
    const FlushDenormals flush;
    rtcCommitScene(scene);
  }
  ~Tree() { rtcReleaseScene(scene); }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  void add_faces(const TriangleMesh& surface) {
    Vec3 lowest = surface.corner(0, 0), highest = lowest;
    for (const Vec3& vertex : surface.vertices) {
      lowest = lowest.cwiseMin(vertex);
      highest = highest.cwiseMax(vertex);
    }
    centre = 0.5 * (lowest + highest);
    half_mm = 0.5 * (highest - lowest).maxCoeff();
    TriangleMesh here;
    here.vertices.reserve(surface.vertices.size());
    for (const Vec3& vertex : surface.vertices) here.vertices.emplace_back(vertex - centre);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (normals.face(t).isZero()) continue;
      here.triangles.push_back(surface.triangles[t]);
      const std::size_t last = here.triangles.size() - 1;
      const Vec3& a = here.corner(last, 0);
      faces.push_back({a, here.corner(last, 1) - a, here.corner(last, 2) - a, normals.face(t), t});
    }
    if (!faces.empty()) add_surface(scene, here);
  }

  /// `hint` is a face that may be near, or none; it saves time and changes nothing.
  [[nodiscard]] Search search(const Vec3& point, double within_mm, std::size_t hint) const {
    const Vec3 here = point - centre;
    // Point and corners are each rounded to 24 bits, along three axes.
    const double rounding_mm = 4e-7 * std::max(here.cwiseAbs().maxCoeff(), half_mm);
    Search search{&faces, here, rounding_mm, within_mm * within_mm};
    if (faces.empty() || !point.allFinite()) return search;
    if (hint != kNone) search.offer(hint);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query;
    const Vec3f place = here.cast<float>();
    query.x = place.x();
    query.y = place.y();
    query.z = place.z();
    query.time = 0;
    query.radius = search.radius();
    rtcPointQuery(scene, &query, &context, offer_to_search, &search);
    return search;
  }

  /// Along a curve through a cube somewhat wider than the surface.
  [[nodiscard]] std::vector<std::uint32_t> order(std::span<const Vec3> points) const {
    const double half = std::max(1.5 * half_mm, 1e-9);
    return order_along_curve(points, centre.array() - half, 2 * half);
  }

  [[nodiscard]] double signed_distance(const Search& search, const Vec3& normal) const {
    const Face& face = faces[search.best];
    const double distance = std::sqrt(search.best_mm2);
    return normal.dot(search.point - face.a - search.foot.at) < 0 ? -distance : distance;
  }
};

SurfaceTree::SurfaceTree(const TriangleMesh& surface) : tree_(std::make_shared<const Tree>(surface)) {}

std::optional<NearestOnSurface> SurfaceTree::nearest(const Vec3& point, double within_mm) const {
  require(within_mm >= 0, "a distance is not negative");
  const Search search = tree_->search(point, within_mm, kNone);
  if (!search.found) return std::nullopt;
  const Face& face = tree_->faces[search.best];
  const Vec3 normal = tree_->normals.at(face.number, search.foot.feature);
  return NearestOnSurface{tree_->signed_distance(search, normal), face.number,
                          tree_->centre + face.a + search.foot.at, normal};
}

std::vector<double> SurfaceTree::signed_distances(std::span<const Vec3> points, double within_mm) const {
  require(within_mm >= 0, "a distance is not negative");
  std::vector<double> distances(points.size(), std::numeric_limits<double>::quiet_NaN());
  parallel_for((points.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    const auto here = points.subspan(first, std::min(kChunk, points.size() - first));
    std::size_t hint = kNone;
    // One after its neighbour, a point finds what it looks at still at hand: twice as fast.
    for (const std::uint32_t i : tree_->order(here)) {
      const Search search = tree_->search(here[i], within_mm, hint);
      if (!search.found) continue;
      hint = search.best;
      const Vec3 normal = tree_->normals.at(tree_->faces[hint].number, search.foot.feature);
      distances[first + i] = tree_->signed_distance(search, normal);
    }
  });
  return distances;
}

}  // namespace asterism
