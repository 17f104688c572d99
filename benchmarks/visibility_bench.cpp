// SPDX-License-Identifier: Apache-2.0
// What hides targets: our ray rate beside Embree asked directly (same surface, same rays, same order, one
// core), how often single precision and double precision differ, and how long the tracker's view of a casing
// takes: 200 poses of 8 targets with their accuracy, and a map over roll and pitch. Then what solids add to
// the time of a search for layouts, and what the search's table of shadows tells otherwise than the rays.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <atomic>
#include <cmath>
#include <ctime>
#include <numbers>

#include "asterism/accuracy/motion_accuracy.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/geometry/rays_for_tests.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/layout/designer.hpp"
#include "asterism/visibility/watch.hpp"
#include "bench.hpp"

using namespace asterism;

namespace {

/// Embree's own tree of one surface, asked as its manual shows.
struct RawEmbree {
  RTCDevice device = rtcNewDevice("set_affinity=0");
  RTCScene scene = rtcNewScene(device);

  explicit RawEmbree(const TriangleMesh& mesh) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* places = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& vertex : mesh.vertices) {
      for (int axis = 0; axis < 3; ++axis) *places++ = static_cast<float>(vertex(axis));
    }
    auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) *corners++ = corner;
    }
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~RawEmbree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  RawEmbree(const RawEmbree&) = delete;
  RawEmbree& operator=(const RawEmbree&) = delete;

  /// Rays are made ready by the caller: what is timed is the copy that Embree writes to, and its answer.
  std::size_t blocked(const std::vector<RTCRay>& rays) const {
    const unsigned before = _mm_getcsr();
    _mm_setcsr(before | _MM_FLUSH_ZERO_ON | _MM_DENORMALS_ZERO_ON);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::size_t count = 0;
    for (const RTCRay& ready : rays) {
      RTCRay ray = ready;
      rtcOccluded1(scene, &context, &ray);
      count += ray.tfar < 0 ? 1 : 0;
    }
    _mm_setcsr(before);
    return count;
  }
};

RTCRay ray_of(const rays::Way& way) {
  const Vec3 along = way.to - way.from;
  RTCRay ray{};
  ray.org_x = static_cast<float>(way.from.x());
  ray.org_y = static_cast<float>(way.from.y());
  ray.org_z = static_cast<float>(way.from.z());
  ray.dir_x = static_cast<float>(along.x());
  ray.dir_y = static_cast<float>(along.y());
  ray.dir_z = static_cast<float>(along.z());
  ray.tfar = 1;
  ray.mask = ~0U;
  return ray;
}

/// Feet around the inside of the casing's wall, facing half inwards and half up: the near rim hides those on
/// the tracker's side.
std::vector<Target> on_the_wall(int count) {
  std::vector<Target> targets;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2 * std::numbers::pi * (i + 0.5) / count;
    const Vec3 outwards(std::cos(azimuth), std::sin(azimuth), 0);
    Target target;
    target.id = fmt::format("W{}", i + 1);
    target.position = 445 * outwards + Vec3(0, 0, i % 2 == 0 ? 300 : 450);
    target.normal = (Vec3::UnitZ() - outwards).normalized();
    target.diameter_mm = 12;
    targets.push_back(target);
  }
  return targets;
}

/// The built-in cell with the casing as a surface of triangles.
Cell casing_cell() {
  Cell cell = cell_of("engine_casing");
  std::erase_if(cell.obstacles, [](const Obstacle& one) { return one.name == "casing"; });
  Solid part;
  part.name = "casing";
  part.surface = std::make_shared<TriangleMesh>(mesh_of(CasingShape{}));
  part.body = "platform";
  cell.workpiece = part;
  return cell;
}

std::vector<std::vector<RigidMotion>> poses_of(const Cell& cell, int count) {
  const double last_s = (cell.timing.frames - 1) / cell.timing.rate_hz;
  std::vector<std::vector<RigidMotion>> poses;
  for (int i = 0; i < count; ++i) poses.push_back(poses_at(cell, last_s * i / (count - 1)));
  return poses;
}

/// Discs on the wall before both cameras in 200 poses: sixteen rays each, by pose, side, target, ray.
struct Bundles {
  std::vector<Vec3> eyes;                // by pose and side, in the platform's frame
  std::vector<Vec3> starts;              // of all targets
  std::vector<rays::Way> ways() const {  // in order
    std::vector<rays::Way> all;
    for (const Vec3& eye : eyes) {
      for (const Vec3& start : starts) all.push_back({start, eye});
    }
    return all;
  }
};
Bundles bundles(const Cell& cell) {
  Bundles all;
  for (const auto& pose : poses_of(cell, 200)) {
    for (const Side side : {Side::Left, Side::Right}) {
      all.eyes.emplace_back((cell.rig.camera_from_tracker(side) * pose[0]).inverse().translation);
    }
  }
  for (const Target& target : on_the_wall(8)) {
    const Vec3 across = target.normal->unitOrthogonal(), along = target.normal->cross(across);
    for (int i = 0; i < 16; ++i) {
      const double radius = 6 * std::sqrt((i + 0.5) / 16), turn = 2.399963 * i;
      all.starts.emplace_back(target.position + 0.5 * *target.normal + radius * std::cos(turn) * across +
                              radius * std::sin(turn) * along);
    }
  }
  return all;
}

void ray_rate(const Cell& cell) {
  const TriangleMesh& mesh = *cell.workpiece->surface;
  const RayScene scene(mesh);
  const RawEmbree raw(mesh);
  bench::Table table(
      fmt::format("rays to a camera past a casing of {} triangles, one core", scene.triangles()),
      {"order", "blocked", "Embree M/s", "ours M/s", "ratio", "bundles M/s", "ratio"});
  const Bundles all = bundles(cell);
  std::vector<rays::Way> ways = all.ways();
  const auto tell = [&](const std::string& order, const std::function<std::size_t()>& ours,
                        const std::function<std::size_t()>& by_bundles) {
    std::vector<RTCRay> ready;
    for (const rays::Way& way : ways) ready.push_back(ray_of(way));
    std::size_t theirs_count = 0, our_count = 0;
    std::vector<std::function<void()>> calls = {[&] { theirs_count = raw.blocked(ready); },
                                                [&] { our_count = ours(); }};
    if (by_bundles) calls.emplace_back([&] { static_cast<void>(by_bundles()); });
    const auto seconds = bench::median_seconds_in_turn(calls, 15);
    const auto rate = [&](std::size_t i) { return 1e-6 * static_cast<double>(ways.size()) / seconds[i]; };
    table.row(
        {order,
         fmt::format("{:.1f} %{}", 100.0 * static_cast<double>(our_count) / static_cast<double>(ways.size()),
                     our_count == theirs_count ? "" : " (differs)"),
         fmt::format("{:.2f}", rate(0)), fmt::format("{:.2f}", rate(1)),
         fmt::format("{:.3f}", rate(1) / rate(0)), by_bundles ? fmt::format("{:.2f}", rate(2)) : "",
         by_bundles ? fmt::format("{:.3f}", rate(2) / rate(0)) : ""});
  };
  std::vector<std::uint8_t> marks(all.starts.size());
  tell(
      "sorted",
      [&] {
        std::size_t count = 0;
        for (const Vec3& eye : all.eyes) {
          scene.blocked(all.starts, eye, marks);
          for (const std::uint8_t mark : marks) count += mark;
        }
        return count;
      },
      [&] {
        std::size_t count = 0;
        for (const Vec3& eye : all.eyes) {
          std::fill(marks.begin(), marks.end(), 0);
          for (std::size_t i = 0; i < all.starts.size(); i += 16) {
            count += scene.block_bundle(std::span(all.starts).subspan(i, 16), eye, 16,
                                        std::span(marks).subspan(i, 16));
          }
        }
        return count;
      });
  RandomStream random(1, 0);
  for (std::size_t i = ways.size() - 1; i > 0; --i) {
    std::swap(ways[i], ways[random.below(static_cast<std::uint32_t>(i + 1))]);
  }
  tell("random",
       [&] {
         std::size_t count = 0;
         for (const rays::Way& way : ways) count += scene.blocked(way.from, way.to) ? 1 : 0;
         return count;
       },
       {});
  table.print_json();
}

template <class Draw>
void tell_agreement(bench::Table& table, const std::string& name, const TriangleMesh& mesh, std::size_t count,
                    const Draw& draw) {
  const RayScene scene(mesh);
  const auto exactly = [&](const Vec3& from, const Vec3& to) { return blocked_exactly(mesh, from, to); };
  std::atomic<std::size_t> blocked = 0, differ = 0, away = 0;
  parallel_for(count / 1000, [&](std::size_t chunk) {
    RandomStream random(3, chunk);
    for (int i = 0; i < 1000; ++i) {
      const rays::Way way = draw(random);
      const bool exact = exactly(way.from, way.to);
      blocked += exact ? 1 : 0;
      if (scene.blocked(way.from, way.to) == exact) continue;
      ++differ;
      if (!rays::near_edge(way, 0.01, exactly)) ++away;
    }
  });
  const auto share = [&](std::size_t of) {
    return 100.0 * static_cast<double>(of) / static_cast<double>(count);
  };
  table.row({name, fmt::format("{}", mesh.triangles.size()), fmt::format("{}", count),
             fmt::format("{:.1f} %", share(blocked)), fmt::format("{}", differ), fmt::format("{}", away),
             fmt::format("{:.5f} %", 100 - share(away))});
}

void agreement(const Cell& cell) {
  bench::Table table("single against double precision; away = no edge within 0.01 mm",
                     {"surface", "triangles", "rays", "blocked", "differ", "away", "agreement"});
  const TriangleMesh& casing = *cell.workpiece->surface;
  tell_agreement(table, "casing", casing, 1000000,
                 [&](RandomStream& r) { return rays::from_surface(casing, r); });
  RandomStream random(5, 0);
  const TriangleMesh soup = rays::soup(300, random);
  tell_agreement(table, "random triangles", soup, 1000000,
                 [](RandomStream& r) { return rays::within_soup(r); });
  table.print_json();
}

std::string milli(double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); }

void time_to_see(const Cell& cell) {
  const Occlusion occlusion(cell);
  const auto poses = poses_of(cell, 200);
  std::vector<RigidMotion> of_platform;
  for (const auto& pose : poses) of_platform.push_back(pose[0]);
  std::vector<Vec3> points;
  for (const WorkPoint& point : cell.layout->points) points.push_back(point.in_body_mm);
  std::vector<Target> ring = cell.movers[0].body.targets;
  for (const Vec3& more : {Vec3(250, 60, 600), Vec3(40, 240, 590)}) {
    ring.push_back(ring[0]);
    ring.back().position = more;
  }
  bench::Table table("8 targets, 200 poses, 2 cameras, part, pipe, scanner and cable in the way; ms",
                     {"targets", "threads", "seen", "hidden", "in all", "conditions", "rays", "accuracy"});
  for (const bool wall : {false, true}) {
    const std::vector<Target> targets = wall ? on_the_wall(8) : ring;
    for (const int threads : {1, 2}) {
      set_thread_count(threads);
      const SeenMotion motion = seen_motion(of_platform, cell.rig);
      const auto conditions = visible_targets(targets, motion, cell.volume, {});
      const auto seen = occlusion.unhidden_of(conditions, targets, 0, poses);
      int free = 0, hidden = 0;
      for (std::size_t pose = 0; pose < poses.size(); ++pose) {
        for (std::size_t side = 0; side < 2; ++side) {
          free += std::popcount(seen.seen[pose][side]);
          hidden += std::popcount(conditions.seen[pose][side] ^ seen.seen[pose][side]);
        }
      }
      const auto seconds = bench::median_seconds_in_turn(
          {[&] {
             const SeenMotion again = seen_motion(of_platform, cell.rig);
             const auto sights = visible_targets(targets, again, cell.volume, {});
             const auto both = occlusion.unhidden_of(sights, targets, 0, poses);
             static_cast<void>(predict_accuracy(targets, again, both, points, {}));
           },
           [&] { static_cast<void>(visible_targets(targets, motion, cell.volume, {})); },
           [&] { static_cast<void>(occlusion.unhidden_of(conditions, targets, 0, poses)); },
           [&] { static_cast<void>(predict_accuracy(targets, motion, seen, points, {})); }},
          15);
      table.row({wall ? "on the wall" : "on the platform", fmt::format("{}", threads),
                 fmt::format("{}", free), fmt::format("{}", hidden), milli(seconds[0]), milli(seconds[1]),
                 milli(seconds[2]), milli(seconds[3])});
    }
  }
  table.print_json();

  bench::Table others("all of a cell, and a map of roll and pitch; ms", {"what", "threads", "ms"});
  Cell with_wall = cell;
  with_wall.movers[0].body.targets = on_the_wall(8);
  std::vector<double> times;
  for (int i = 0; i < 200; ++i) times.push_back(5.95 * i / 199);
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    const auto seconds = bench::median_seconds_in_turn(
        {[&] { static_cast<void>(Occlusion(with_wall)); },
         [&] { static_cast<void>(watch_cell(with_wall, times, {}, occlusion)); },
         [&] { static_cast<void>(attitude_map(with_wall, 0, 15, 61, {}, occlusion)); }},
        7);
    const auto n = fmt::format("{}", threads);
    others.row({"trees built", n, milli(seconds[0])});
    others.row({"watch, 200 poses", n, milli(seconds[1])});
    others.row({"map, 61 x 61", n, milli(seconds[2])});
  }
  others.print_json();
  set_thread_count(0);
}

double wall_seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// From the cell to the designs that are told, two threads; what the part, the pipe, the scanner and the
/// cable add to it.
void designer(const Cell& cell) {
  Cell open = cell;
  open.workpiece.reset();
  open.fixtures.clear();
  open.obstacles.clear();
  DesignerOptions options;
  options.optimizer.generations = 1000;
  options.optimizer.evaluations = 25000;
  set_thread_count(2);
  bench::Table table(
      "layout search, 25,000 evaluations, 200 poses, 2 threads",
      {"solids", "places", "step mm", "table s", "search s", "told s", "CPU s", "CPU ratio", "front"});
  double cpu_without = 0;
  for (const bool with : {false, true}) {
    const double cpu = cpu_seconds(), begin = wall_seconds();
    const LayoutProblem problem(with ? cell : open, options);
    const double ready = wall_seconds();
    const OptimizationResult found = optimize(problem, options.optimizer);
    const double searched = wall_seconds();
    const DesignResult result = design_result(problem, found);
    const double told = wall_seconds(), cpu_all = cpu_seconds() - cpu;
    if (!with) cpu_without = cpu_all;
    table.row({with ? "with" : "without", fmt::format("{}", problem.shadows().places()),
               fmt::format("{:.1f}", problem.shadows().step_mm()), fmt::format("{:.2f}", ready - begin),
               fmt::format("{:.2f}", searched - ready), fmt::format("{:.2f}", told - searched),
               fmt::format("{:.2f}", cpu_all), fmt::format("{:.2f}", cpu_all / cpu_without),
               fmt::format("{} of {}", result.front.size(), found.front.size())});
  }
  table.print_json();
  set_thread_count(0);
}

/// What the search's table of shadows says of layouts at random beside what the rays say.
void table_of_shadows(const Cell& cell) {
  const LayoutProblem problem(cell, {});
  const LayoutModel& model = problem.model();
  std::size_t seen = 0, hidden = 0, told_besides = 0, missed = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    RandomStream random(5, i);
    const std::vector<Target> targets = problem.targets_of(problem.sample(random));
    const auto before = visible_targets(targets, model.motion, model.volume, {});
    const auto exact = model.visibility_of(targets);
    const auto table = problem.shadows().unhidden_of(before, targets);
    for (std::size_t pose = 0; pose < before.poses(); ++pose) {
      for (std::size_t side = 0; side < 2; ++side) {
        const TargetMask all = before.seen[pose][side], free = exact.seen[pose][side],
                         told = table.seen[pose][side];
        seen += static_cast<std::size_t>(std::popcount(all));
        hidden += static_cast<std::size_t>(std::popcount(all & ~free));
        told_besides += static_cast<std::size_t>(std::popcount(free & ~told));
        missed += static_cast<std::size_t>(std::popcount(told & ~free));
      }
    }
  }
  const auto share = [&](std::size_t of) {
    return fmt::format("{:.3f} %", 100.0 * static_cast<double>(of) / static_cast<double>(seen));
  };
  bench::Table table("the search's table of shadows, 300 layouts at random: shares of the sights asked",
                     {"sights", "hidden", "hidden by table", "table alone", "missed by table"});
  table.row({fmt::format("{}", seen), share(hidden), share(hidden + told_besides - missed),
             share(told_besides), share(missed)});
  table.print_json();
}

}  // namespace

int main() {
  const Cell cell = casing_cell();
  ray_rate(cell);
  time_to_see(cell);
  designer(cell);
  table_of_shadows(cell);
  agreement(cell);
}
