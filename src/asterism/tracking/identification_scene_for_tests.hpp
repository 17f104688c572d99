// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "asterism/core/random.hpp"
#include "asterism/tracking/identification.hpp"

// The bodies and scenes of identification's tests.

namespace asterism::identification_scene {

inline constexpr double kSigma = 0.05;

inline Body body_of(const std::string& name, const std::vector<Vec3>& positions) {
  Body body{name, {}};
  for (const Vec3& position : positions) {
    body.targets.push_back({"T" + std::to_string(body.targets.size() + 1), position, {}, {}, {}});
  }
  return body;
}

// Table 1 S3, S1 and Table 9 S4 (exactly symmetric) of Machines 2025, 13, 592; a probe; two small ones.
inline const Body kPlatform = body_of("platform", {{200, -100, 590},
                                                   {-100, 300, 610},
                                                   {-200, 100, 600},
                                                   {0, -250, 605},
                                                   {210, 180, 580},
                                                   {-200, -240, 590}});
inline const Body kNearlyTurned = body_of(
    "nearly",
    {{250, 0, 600}, {0, 300, 610}, {-250, 0, 590}, {0, -300, 605}, {220, 220, 580}, {-220, -220, 605}});
inline const Body kSymmetric =
    body_of("symmetric", {{220, 220, 580}, {220, -220, 590}, {-220, 220, 595}, {-220, -220, 605}});
inline const Body kProbe =
    body_of("probe", {{0, 0, 0}, {61, 0, 10}, {12, 95, -20}, {-40, 50, 130}, {30, -70, 90}});
inline const Body kTriangle = body_of("triangle", {{0, 0, 0}, {70, 0, 0}, {20, 50, 0}});
inline const Body kRod = body_of("rod", {{0, 0, 0}, {50, 0, 0}, {105, 0, 0}, {190, 0, 0}});

inline const RigidMotion kThere{exp_rotation(Vec3(0.3, -0.4, 1.1)), Vec3(120, -80, 2300)};
inline const RigidMotion kElsewhere{exp_rotation(Vec3(-0.8, 1.2, 0.2)), Vec3(-500, 300, 2600)};

/// What is seen of bodies, and what of it is true.
struct Seen {
  std::vector<Point> points;
  std::vector<std::pair<int, int>> truth;  // body, target
  RandomStream random{11, 0};

  void add(const Vec3& place, std::pair<int, int> of = {-1, -1}) {
    const Vec3 noise(random.normal(), random.normal(), random.normal());
    points.push_back({place + kSigma * noise, kSigma * kSigma * Mat3::Identity(), 0, -1, -1});
    truth.push_back(of);
  }
  void add(int index, const Body& body, const RigidMotion& tracker_from_body,
           const std::vector<int>& targets) {
    for (const int t : targets) {
      add(tracker_from_body * body.targets[static_cast<std::size_t>(t)].position, {index, t});
    }
  }
  void add_ghosts(int count) {
    for (int i = 0; i < count; ++i) {
      add(Vec3(random.uniform(-1000, 1000), random.uniform(-1000, 1000), random.uniform(1700, 3200)));
    }
  }
};

inline std::vector<int> all_targets(const Body& body) {
  std::vector<int> targets(body.targets.size());
  std::iota(targets.begin(), targets.end(), 0);
  return targets;
}

inline testing::AssertionResult all_right(const BodyLabels& labels, const Seen& seen) {
  for (const auto& label : labels.points) {
    if (seen.truth[static_cast<std::size_t>(label.point)] == std::make_pair(labels.body, label.target))
      continue;
    return testing::AssertionFailure()
           << "point " << label.point << " is not target " << label.target << " of body " << labels.body;
  }
  return testing::AssertionSuccess();
}

inline PriorPose prior_at(const RigidMotion& tracker_from_body, double sigma_rad, double sigma_mm) {
  Vec6 variances;
  variances << Vec3::Constant(sigma_rad * sigma_rad), Vec3::Constant(sigma_mm * sigma_mm);
  return {tracker_from_body, variances.asDiagonal()};
}

inline std::vector<BodyLabels> identify(const Seen& seen, const std::vector<Body>& bodies,
                                        const std::vector<std::optional<PriorPose>>& priors = {}) {
  return asterism::identify(seen.points, BodyCatalogue(bodies), {}, priors);
}

}  // namespace asterism::identification_scene
