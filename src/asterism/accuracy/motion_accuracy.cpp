// SPDX-License-Identifier: Apache-2.0
#include "asterism/accuracy/motion_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asterism/accuracy/point_information.hpp"
#include "asterism/core/result.hpp"

namespace asterism {
namespace {

/// What one loss, or none, is called: the first and the second target; kMaxTargets = none.
double code_of(std::size_t first, std::size_t second) {
  return static_cast<double>(first * (kMaxTargets + 1) + second);
}

/// The square of the largest error at a point in four poses, and which loss brought it.
struct alignas(kLanesAlignment) WorstAtPoint {
  DoubleLanes square, code;
};

/// The worst that a number of losses does.
struct alignas(kLanesAlignment) WorstLanes {
  MaskLanes undetermined;
  std::vector<WorstAtPoint> at;  // by point
};

/// All that the poses share, and room to work in.
struct Kernel {
  std::vector<TargetForLanes> targets;
  std::vector<Vec3> arms;  // of the targets, from their mean
  std::vector<PointForLanes> points;
  std::array<LensForLanes, 2> lenses;
  CentreVariance variance;
  double max_rotation_variance;
  int losses;

  std::vector<std::size_t> present;           // targets seen in any of the four poses
  std::vector<InformationLanes> share, rest;  // of present[i]; of present[i], present[i + 1] …
  std::vector<WorstLanes> worst;              // by number of losses

  ASTERISM_INLINE void consider(const InformationLanes& info, double code, WorstLanes& out) const {
    const ErrorLanes error = error_of(info, max_rotation_variance);
    out.undetermined |= ~error.determined;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const DoubleLanes square = square_at(error, points[j]);
      WorstAtPoint& worst_here = out.at[j];
      const MaskLanes larger = error.determined & (square > worst_here.square);
      worst_here.square = larger ? square : worst_here.square;
      worst_here.code = larger ? DoubleLanes{} + code : worst_here.code;
    }
  }

  ASTERISM_INLINE void lose_one() {
    InformationLanes before{};
    for (std::size_t i = 0; i < present.size(); ++i) {
      InformationLanes left = before;
      add(left, rest[i + 1]);
      consider(left, code_of(present[i], kMaxTargets), worst[1]);
      add(before, share[i]);
    }
  }

  ASTERISM_INLINE void lose_two() {
    InformationLanes before{};
    for (std::size_t i = 0; i < present.size(); ++i) {
      InformationLanes between = before;  // all before j but i
      for (std::size_t j = i + 1; j < present.size(); ++j) {
        InformationLanes left = between;
        add(left, rest[j + 1]);
        consider(left, code_of(present[i], present[j]), worst[2]);
        add(between, share[j]);
      }
      add(before, share[i]);
    }
  }

  void clear() {
    for (WorstLanes& of : worst) {
      std::fill(of.at.begin(), of.at.end(), WorstAtPoint{});
      of.undetermined = MaskLanes{};
    }
  }

  /// `masks` are of the four poses.
  ASTERISM_CLONES static void run(Kernel& k, const std::array<const MotionLanes*, 2>& cameras,
                                  const std::array<std::array<TargetMask, kDoubleLanes>, 2>& masks);
};

ASTERISM_CLONES void Kernel::run(Kernel& k, const std::array<const MotionLanes*, 2>& cameras,
                                 const std::array<std::array<TargetMask, kDoubleLanes>, 2>& masks) {
  k.present.clear();
  for (std::size_t i = 0; i < k.targets.size(); ++i) {
    SeenLanes seen{};
    bool any = false;
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) {
        const bool is_seen = (masks[side][lane] >> i & 1U) != 0;
        seen[side][lane] = is_seen ? -1 : 0;
        any = any || is_seen;
      }
    }
    if (!any) continue;
    const SymmetricLanes m = point_information(k.targets[i], cameras, k.lenses, seen, k.variance);
    lift(m, k.arms[i], k.share[k.present.size()]);
    k.present.push_back(i);
  }
  const std::size_t count = k.present.size();
  k.rest[count] = InformationLanes{};
  for (std::size_t i = count; i-- > 0;) {
    k.rest[i] = k.rest[i + 1];
    add(k.rest[i], k.share[i]);
  }
  k.clear();
  k.consider(k.rest[0], code_of(kMaxTargets, kMaxTargets), k.worst[0]);
  // A pose that is not determined as it is, is not after a loss: so also when no loss is left to try.
  for (WorstLanes& of : k.worst) of.undetermined |= k.worst[0].undetermined;
  if (k.losses >= 1) k.lose_one();
  if (k.losses >= 2) k.lose_two();
}

Kernel kernel_of(std::span<const Target> targets, const StereoRig& rig, std::span<const Vec3> points,
                 const AccuracyOptions& options) {
  const double max_sigma = rad_from_deg(options.max_sigma_deg);
  Kernel k{{},
           {},
           {},
           {LensForLanes(rig.left), LensForLanes(rig.right)},
           CentreVariance(options),
           max_sigma * max_sigma,
           options.losses,
           {},
           {},
           {},
           {}};
  Vec3 mean = Vec3::Zero();
  for (const Target& target : targets) {
    k.targets.push_back(target_for_lanes(target, options));
    mean += target.position;
  }
  if (!targets.empty()) mean /= static_cast<double>(targets.size());
  for (const Target& target : targets) k.arms.push_back(target.position - mean);
  for (const Vec3& point : points) k.points.emplace_back(Vec3(point - mean));
  if (points.empty()) k.points.emplace_back(Vec3(Vec3::Zero()));
  k.present.reserve(targets.size());
  k.share.resize(targets.size());
  k.rest.resize(targets.size() + 1);
  k.worst.resize(static_cast<std::size_t>(options.losses) + 1);
  for (WorstLanes& of : k.worst) of.at.resize(k.points.size());
  return k;
}

std::vector<std::size_t> losses_of(double code) {
  const auto whole = static_cast<std::size_t>(code);
  std::vector<std::size_t> lost;
  for (const std::size_t target : {whole / (kMaxTargets + 1), whole % (kMaxTargets + 1)}) {
    if (target < kMaxTargets) lost.push_back(target);
  }
  return lost;
}

/// Takes over one pose.
void collect(const WorstLanes& worst, std::size_t pose, ErrorOverMotion& over) {
  const std::size_t lane = pose % kDoubleLanes;
  if (worst.undetermined[lane] != 0) {
    ++over.undetermined;
    over.by_pose_mm.push_back(std::numeric_limits<double>::infinity());
    return;
  }
  double largest = 0;
  for (std::size_t j = 0; j < worst.at.size(); ++j) {
    const double error = std::sqrt(worst.at[j].square[lane]);
    over.mean_mm += error;
    largest = std::max(largest, error);
    if (over.worst && error <= over.worst->mm) continue;
    over.worst = WorstError{error, pose, j, losses_of(worst.at[j].code[lane])};
  }
  over.by_pose_mm.push_back(largest);
}

}  // namespace

MotionAccuracy predict_accuracy(std::span<const Target> targets, const SeenMotion& motion,
                                const MotionVisibility& visibility, std::span<const Vec3> points,
                                const AccuracyOptions& options) {
  require(targets.size() <= kMaxTargets, "a body has at most 64 targets");
  require(visibility.poses() == motion.poses(), "visibility and motion are of the same poses");
  require(options.losses >= 0 && options.losses <= 2, "at most two losses are looked at");
  Kernel k = kernel_of(targets, motion.rig, points, options);
  MotionAccuracy accuracy{std::vector<ErrorOverMotion>(k.worst.size())};
  for (ErrorOverMotion& over : accuracy.after) over.by_pose_mm.reserve(motion.poses());
  for (std::size_t pose = 0; pose < motion.poses(); ++pose) {
    if (pose % kDoubleLanes == 0) {
      std::array<std::array<TargetMask, kDoubleLanes>, 2> masks;
      for (std::size_t lane = 0; lane < kDoubleLanes; ++lane) {
        const std::size_t at = std::min(pose + lane, motion.poses() - 1);
        for (std::size_t side = 0; side < 2; ++side) {
          masks[side][lane] = options.single_views ? visibility.seen[at][side] : visibility.both(at);
        }
      }
      const std::size_t block = pose / kDoubleLanes;
      Kernel::run(k, {&motion.camera_from_body[0][block], &motion.camera_from_body[1][block]}, masks);
    }
    for (std::size_t m = 0; m < k.worst.size(); ++m) collect(k.worst[m], pose, accuracy.after[m]);
  }
  for (ErrorOverMotion& over : accuracy.after) {
    const double determined = static_cast<double>((motion.poses() - over.undetermined) * k.points.size());
    if (determined > 0) over.mean_mm /= determined;
  }
  return accuracy;
}

}  // namespace asterism
