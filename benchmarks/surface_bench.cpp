// SPDX-License-Identifier: Apache-2.0
// How fast a cloud is held against a surface: a million signed distances to the turbine casing (18,460
// triangles, 1.2 m), near it in the order of a scan and at random, and far from it, with CloudCompare's C2M
// on the same points and surface where it is installed; completeness of five million points by 20,000 places;
// the nearest of a million points beside looking at each. ASTERISM_DATA_PATH tells where turbine.off is.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>

#include "asterism/core/random.hpp"
#include "asterism/geometry/mesh_queries.hpp"
#include "asterism/geometry/neighbours.hpp"
#include "asterism/geometry/surface_tree.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/mesh_file.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/surface_samples.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

struct Spent {
  double wall_s, cpu_s;
};

/// The quicker of two runs: the first warms the caches.
Spent spent_on(const std::function<void()>& work) {
  Spent best{1e9, 1e9};
  for (int run = 0; run < 2; ++run) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    work();
    const double cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    best = {std::min(best.wall_s, wall_s), std::min(best.cpu_s, cpu_s)};
  }
  return best;
}

/// Points on the surface, each moved along its normal by normal noise.
std::vector<Vec3> scan_of(const TriangleMesh& surface, std::size_t count, double sigma_mm) {
  std::vector<Vec3> points;
  points.reserve(count);
  for (const SurfaceSample& sample : sample_surface(surface, count, {}, 1)) {
    RandomStream random(2, points.size());
    points.push_back(sample.at + sigma_mm * random.normal() * sample.normal);
  }
  return points;
}

std::vector<Vec3> shuffled(std::vector<Vec3> points) {
  RandomStream random(3, 0);
  for (std::size_t i = points.size(); i > 1; --i) {
    std::swap(points[i - 1], points[random.below(static_cast<std::uint32_t>(i))]);
  }
  return points;
}

std::vector<Vec3> anywhere_in(const MeshFacts& box, std::size_t count) {
  std::vector<Vec3> points;
  RandomStream random(4, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 share(random.uniform(), random.uniform(), random.uniform());
    points.emplace_back(box.lowest + share.cwiseProduct(box.highest - box.lowest));
  }
  return points;
}

struct PeerFound {
  double seconds = 0, mean_mm = 0, sigma_mm = 0;
};

/// What CloudCompare says of its own distances, the time of both its steps; none where it is not installed.
std::optional<PeerFound> cloud_compare(const std::vector<Vec3>& points, const TriangleMesh& surface) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "asterism_surface_bench";
  std::filesystem::create_directories(folder);
  Cloud cloud;
  cloud.points = points;
  write_cloud(folder / "cloud.ply", cloud);
  write_ply(folder / "mesh.ply", surface);
  const std::string command = fmt::format(
      "QT_QPA_PLATFORM=offscreen CloudCompare -SILENT -AUTO_SAVE OFF -O {0}/cloud.ply -O "
      "{0}/mesh.ply -C2M_DIST 2>/dev/null",
      folder.string());
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  PeerFound peer;
  bool found = false;
  char line[512];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    double value = 0, other = 0;
    const char* text = std::strchr(line, ']');
    if (text == nullptr) continue;
    if (std::sscanf(text, "] Time: %lf", &value) == 1) peer.seconds += value;
    if (std::sscanf(text, "] Mean distance = %lf / std deviation = %lf", &value, &other) != 2) continue;
    found = true;
    peer.mean_mm = value;
    peer.sigma_mm = other;
  }
  pclose(pipe);
  std::filesystem::remove_all(folder);
  if (!found) return std::nullopt;
  return peer;
}

void distances(const TriangleMesh& surface, bench::Table& table) {
  const std::size_t million = 1000000;
  const std::vector<Vec3> in_order = scan_of(surface, million, 0.05);
  const std::vector<Vec3> at_random = shuffled(in_order);
  const std::vector<Vec3> far = anywhere_in(facts_of(surface), million);
  std::optional<SurfaceTree> tree;
  const Spent build = spent_on([&] { tree.emplace(surface); });
  table.row({"surface tree", fmt::format("{} triangles", surface.triangles.size()),
             fmt::format("{:.3f}", build.wall_s), fmt::format("{:.3f}", build.cpu_s), "", ""});
  std::vector<double> mm;
  const auto row = [&](const char* what, const std::vector<Vec3>& points, double within_mm) {
    const Spent spent = spent_on([&] { mm = tree->signed_distances(points, within_mm); });
    double sum = 0, squares = 0, count = 0;
    for (const double d : mm) {
      if (std::isnan(d)) continue;
      sum += d;
      squares += d * d;
      ++count;
    }
    const double mean = sum / count;
    table.row({what, "1,000,000", fmt::format("{:.3f}", spent.wall_s), fmt::format("{:.3f}", spent.cpu_s),
               fmt::format("{:.6f}", mean), fmt::format("{:.6f}", std::sqrt(squares / count - mean * mean))});
  };
  row("scan's order", in_order, 5);
  row("random order", at_random, 5);
  row("without limit", at_random, std::numeric_limits<double>::infinity());
  row("anywhere in box", far, std::numeric_limits<double>::infinity());
  if (const auto peer = cloud_compare(at_random, surface)) {
    table.row({"CloudCompare C2M", "1,000,000", fmt::format("{:.2f}", peer->seconds), "",
               fmt::format("{:.6f}", peer->mean_mm), fmt::format("{:.6f}", peer->sigma_mm)});
  }
  double worst = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const Vec3& point = far[i];
    worst = std::max(
        worst, std::abs(std::abs(tree->nearest(point)->signed_distance_mm) - distance_to(surface, point)));
  }
  table.row({"worst, each facet", "200", "", "", fmt::format("{:.1e}", worst), ""});
}

void completeness(const TriangleMesh& surface, bench::Table& table) {
  Cloud cloud;
  cloud.points = scan_of(surface, 5000000, 0.05);
  const auto samples = sample_surface(surface, 20000, {}, 5);
  Completeness found;
  const Spent spent = spent_on([&] { found = completeness_of(cloud, samples, {}); });
  table.row({"completeness", "5,000,000", fmt::format("{:.3f}", spent.wall_s),
             fmt::format("{:.3f}", spent.cpu_s), fmt::format("share {:.4f}", found.share()), ""});
}

void neighbours(const TriangleMesh& surface, bench::Table& table) {
  const std::vector<Vec3> points = scan_of(surface, 1000000, 0.05);
  const std::vector<Vec3> places = shuffled(scan_of(surface, 100000, 0.5));
  std::optional<Neighbours> tree;
  const Spent build = spent_on([&] { tree.emplace(points); });
  table.row({"tree of points", "1,000,000", fmt::format("{:.3f}", build.wall_s),
             fmt::format("{:.3f}", build.cpu_s), ""});
  std::vector<std::size_t> found(places.size());
  const Spent asked = spent_on([&] {
    for (std::size_t i = 0; i < places.size(); ++i) found[i] = tree->nearest(places[i], 1e9).value_or(0);
  });
  table.row({"nearest, one core", "100,000", fmt::format("{:.3f}", asked.wall_s),
             fmt::format("{:.3f}", asked.cpu_s), "", ""});
  constexpr std::size_t kBrute = 100;
  std::size_t wrong = 0;
  const Spent brute = spent_on([&] {
    wrong = 0;
    for (std::size_t i = 0; i < kBrute; ++i) {
      std::size_t best = 0;
      for (std::size_t p = 1; p < points.size(); ++p) {
        if ((points[p] - places[i]).squaredNorm() < (points[best] - places[i]).squaredNorm()) best = p;
      }
      wrong += best != found[i] ? 1 : 0;
    }
  });
  table.row({"looking at each", "100", fmt::format("{:.3f}", brute.wall_s),
             fmt::format("{:.3f}", brute.cpu_s), fmt::format("{} differ", wrong), ""});
}

}  // namespace

int main() {
  const Cell cell = cell_of("turbine_casing");
  const TriangleMesh& surface = *cell.workpiece->surface;
  bench::Table table("A cloud held against the turbine casing (best of two runs)",
                     {"what", "how many", "wall (s)", "CPU (s)", "mean (mm)", "sigma (mm)"});
  distances(surface, table);
  completeness(surface, table);
  neighbours(surface, table);
  table.print_json();
}
