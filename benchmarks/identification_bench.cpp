// SPDX-License-Identifier: Apache-2.0
// Identification on fixed layouts in random poses: how often wrong, how often found, how long.
//   identification_bench [frames]      100,000 frames by default for the scene of record
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/tracking/identification.hpp"
#include "bench.hpp"

namespace asterism {
namespace {

struct Case {
  std::string name;
  std::string scene;
  std::string only = {};  // one body of the file; empty for all
  int hidden = 0;         // targets of each body
  int shown = -1;         // if given, just the first so many targets
  int ghosts = 60;
  double lateral_mm = 0.05;  // σ across the line of sight and along it
  double depth_mm = 0.05;
  double stated = 1;  // stated σ over true σ
  std::size_t frames = 10000;
  bool absent = false;  // the bodies are not there at all: ghosts in their number's place
};

std::vector<Body> read_scene(const Case& c) {
  std::ifstream file(std::filesystem::path(ASTERISM_SCENES) / (c.scene + ".csv"));
  if (!file) throw InputError(c.scene, "no such scene");
  std::vector<Body> bodies;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream cells(line);
    std::string body;
    Target target;
    cells >> body >> target.id >> target.position.x() >> target.position.y() >> target.position.z();
    if (!c.only.empty() && body != c.only) continue;
    if (bodies.empty() || bodies.back().name != body) bodies.push_back({body, {}});
    bodies.back().targets.push_back(target);
  }
  return bodies;
}

struct Frame {
  std::vector<Point> points;
  std::vector<std::pair<int, int>> truth;  // body and target of each point; −1 for ghosts
};

Quaternion any_attitude(RandomStream& random) {
  const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
  return Quaternion(q.normalized());
}

/// In a volume of 2 × 2 × 1.5 m whose middle is 2.5 m before the tracker.
Vec3 any_place(RandomStream& random, double share) {
  return Vec3(share * random.uniform(-1000, 1000), share * random.uniform(-1000, 1000),
              2500 + share * random.uniform(-750, 750));
}

Point seen_at(const Vec3& place, const Case& c, RandomStream& random) {
  Mat3 axes;
  axes.col(2) = place.normalized();
  axes.col(0) = axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  const Vec3 sigma(c.lateral_mm, c.lateral_mm, c.depth_mm);
  const Vec3 noise(random.normal(), random.normal(), random.normal());
  Point point;
  point.in_tracker = place + axes * sigma.cwiseProduct(noise);
  point.covariance = c.stated * c.stated * axes * sigma.cwiseAbs2().asDiagonal() * axes.transpose();
  return point;
}

Frame frame_of(const std::vector<Body>& bodies, const Case& c, std::uint64_t index) {
  RandomStream random(2025, index);
  std::vector<std::pair<Point, std::pair<int, int>>> all;
  int ghosts = c.ghosts;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::vector<int> targets(bodies[b].targets.size());
    for (std::size_t t = 0; t < targets.size(); ++t) targets[t] = static_cast<int>(t);
    if (c.shown >= 0) targets.resize(static_cast<std::size_t>(c.shown));
    for (int h = 0; h < c.hidden; ++h) {
      targets.erase(targets.begin() + random.below(static_cast<std::uint32_t>(targets.size())));
    }
    if (c.absent) {
      ghosts += static_cast<int>(targets.size());
      continue;
    }
    const RigidMotion tracker_from_body{any_attitude(random), any_place(random, 0.7)};
    for (const int t : targets) {
      const Vec3 place = tracker_from_body * bodies[b].targets[static_cast<std::size_t>(t)].position;
      all.push_back({seen_at(place, c, random), {static_cast<int>(b), t}});
    }
  }
  for (int g = 0; g < ghosts; ++g) all.push_back({seen_at(any_place(random, 1.0), c, random), {-1, -1}});
  for (std::size_t i = all.size(); i > 1; --i)
    std::swap(all[i - 1], all[random.below(static_cast<std::uint32_t>(i))]);
  Frame frame;
  for (const auto& [point, truth] : all) {
    frame.points.push_back(point);
    frame.truth.push_back(truth);
  }
  return frame;
}

struct Tally {
  std::size_t wrong = 0, sought = 0, found = 0, ambiguous = 0;
  std::vector<double> seconds;
};

/// Time this thread has run: what else the machine does is not counted.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void score(const Frame& frame, const std::vector<BodyLabels>& labels, Tally& tally) {
  for (const auto& body : labels) {
    if (body.status == LabelStatus::Ambiguous) {
      ++tally.ambiguous;
      continue;
    }
    bool right = true;
    for (const auto& label : body.points) {
      if (frame.truth[static_cast<std::size_t>(label.point)] != std::make_pair(body.body, label.target))
        right = false;
    }
    ++(right ? tally.found : tally.wrong);
  }
}

void run(const Case& c, bench::Table& table) {
  const auto bodies = read_scene(c);
  const IdentificationOptions options;
  const BodyCatalogue catalogue(bodies, options);
  Tally tally;
  for (std::size_t i = 0; i < c.frames; ++i) {
    const Frame frame = frame_of(bodies, c, i);
    const double start = thread_seconds();
    const auto labels = identify(frame.points, catalogue, options);
    tally.seconds.push_back(thread_seconds() - start);
    if (!c.absent) tally.sought += bodies.size();
    score(frame, labels, tally);
  }
  std::sort(tally.seconds.begin(), tally.seconds.end());
  const auto share = [&](std::size_t count) {
    return tally.sought == 0 ? std::string("-")
                             : fmt::format("{:.4f}", 100.0 * static_cast<double>(count) /
                                                         static_cast<double>(tally.sought));
  };
  const auto quantile = [&](double q) {
    return fmt::format("{:.4f}",
                       1e3 * tally.seconds[static_cast<std::size_t>(q * static_cast<double>(c.frames - 1))]);
  };
  table.row({c.name, std::to_string(c.frames), std::to_string(tally.wrong), share(tally.found),
             share(tally.ambiguous), quantile(0.5), quantile(0.99)});
}

}  // namespace
}  // namespace asterism

int main(int count, char** arguments) {
  using namespace asterism;
  const std::size_t frames = count > 1 ? static_cast<std::size_t>(std::atoll(arguments[1])) : 100000;
  bench::Table table("Identification, one thread",
                     {"case", "frames", "wrong bodies", "found %", "ambiguous %", "median ms", "p99 ms"});
  std::vector<Case> cases;
  const auto add = [&](Case c) { cases.push_back(std::move(c)); };
  const std::size_t few = frames / 10;
  add({.name = "3 bodies", .scene = "three_bodies", .hidden = 2, .frames = frames});
  add({.name = "none hidden", .scene = "three_bodies", .frames = few});
  add({.name = "depth 0.3", .scene = "three_bodies", .hidden = 2, .depth_mm = 0.3, .frames = few});
  add({.name = "sigma 0.25",
       .scene = "three_bodies",
       .hidden = 2,
       .lateral_mm = 0.25,
       .depth_mm = 0.25,
       .frames = few});
  add({.name = "stated half",
       .scene = "three_bodies",
       .hidden = 2,
       .lateral_mm = 0.25,
       .depth_mm = 0.5,
       .stated = 0.5,
       .frames = few});
  add({.name = "500 ghosts", .scene = "three_bodies", .hidden = 2, .ghosts = 500, .frames = few / 10});
  add({.name = "1400 ghosts",
       .scene = "three_bodies",
       .hidden = 2,
       .ghosts = 1400,
       .lateral_mm = 0.1,
       .depth_mm = 0.5,
       .frames = few / 100});
  add({.name = "ghosts only", .scene = "three_bodies", .hidden = 2, .frames = few, .absent = true});
  add({.name = "gh. depth 1",
       .scene = "three_bodies",
       .ghosts = 200,
       .lateral_mm = 0.25,
       .depth_mm = 1,
       .frames = few / 10,
       .absent = true});
  add({.name = "25 bodies", .scene = "twenty_five_bodies", .hidden = 1, .frames = few / 10});
  for (const char* layout : {"S1", "S2", "S3", "S4", "S5"}) {
    add({.name = std::string("Table 9 ") + layout,
         .scene = "paper_layouts",
         .only = std::string("table9_") + layout,
         .frames = few});
  }
  for (const char* layout : {"S1", "S2", "S3"}) {
    add({.name = std::string("Table 1 ") + layout,
         .scene = "paper_layouts",
         .only = std::string("table1_") + layout,
         .frames = few});
    add({.name = std::string("T1 ") + layout + ", 4 seen",
         .scene = "paper_layouts",
         .only = std::string("table1_") + layout,
         .shown = 4,
         .frames = few});
  }
  for (const Case& c : cases) run(c, table);
  table.print_json();
  return 0;
}
