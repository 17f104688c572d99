// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "asterism/camera/disc_image.hpp"
#include "asterism/tracking/pose.hpp"

// The least-squares problem behind estimate_pose: what each view says of the pose.

namespace asterism {

/// Σ rᵀ W r near a pose: chi_square − 2 gradientᵀ e + eᵀ information e for a small error e of the pose.
struct NormalEquations {
  Mat6 information = Mat6::Zero();
  Vec6 gradient = Vec6::Zero();
  double chi_square = 0;
  int views = 0;

  NormalEquations& operator+=(const NormalEquations& other);
};

/// A view linearised at a pose.
struct LinearView {
  Vec2 residual;    // px, measured − predicted
  Mat23 by_point;   // ∂px / ∂(the target in the tracker's frame)
  Mat26 by_pose;    // ∂px / ∂(ω, δ)
  Vec3 in_tracker;  // mm
  double facing;    // cosine of the incidence; 1 for a target without a normal
};

/// Views sorted by target; those not in use are skipped.
class PoseProblem {
 public:
  PoseProblem(const Body& body, std::span<const TargetView> views, const StereoRig& rig,
              const PoseOptions& options);

  /// Sum over the views in use; empty when one of them lies behind its camera.
  [[nodiscard]] std::optional<NormalEquations> at(const RigidMotion& tracker_from_body) const;
  /// The share of one target (its place among `targets()`).
  [[nodiscard]] std::optional<NormalEquations> at(const RigidMotion& tracker_from_body,
                                                  std::size_t group) const;
  [[nodiscard]] std::optional<LinearView> linearised(const RigidMotion& tracker_from_body,
                                                     std::size_t view) const;

  /// Views [first, last) of one target, as places in the sorted order.
  struct Group {
    std::size_t first, last;
  };
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] std::size_t size() const { return views_.size(); }
  [[nodiscard]] bool used(std::size_t view) const { return views_[view].used; }
  void use(std::size_t view, bool yes) { views_[view].used = yes; }
  [[nodiscard]] int given_index(std::size_t view) const { return views_[view].given; }
  [[nodiscard]] Side side(std::size_t view) const { return views_[view].side; }
  [[nodiscard]] const Mat2& weight(std::size_t view) const { return views_[view].weight; }
  [[nodiscard]] const Target& target(std::size_t view) const { return *views_[view].target; }
  [[nodiscard]] const StereoRig& rig() const { return rig_; }

  /// Of the groups in use: how many, and how many of them in both cameras.
  [[nodiscard]] int targets_used() const;
  [[nodiscard]] int targets_in_both() const;

 private:
  struct View {
    const Target* target;
    int given;
    Side side;
    bool used;
    Vec2 px;
    Mat2 weight;  // inverse covariance
  };
  struct Attitude;
  [[nodiscard]] bool linearise(const Attitude& attitude, const View& view, LinearView& out) const;
  [[nodiscard]] bool add_group(const Attitude& attitude, const Group& group, NormalEquations& sum) const;

  std::vector<View> views_;
  std::vector<Group> groups_;
  const StereoRig& rig_;
  Mat3 right_from_left_;
};

/// A minimum of the problem.
struct PoseFit {
  RigidMotion pose;
  NormalEquations equations;
};
[[nodiscard]] Result<PoseFit, PoseFailure> minimise(const PoseProblem& problem, const RigidMotion& start,
                                                    int max_iterations);

/// Is there another minimum that fits about as well (its χ² worse by less than `gate`)? Asked when few
/// targets are seen by both cameras: then the body turned over may look the same.
[[nodiscard]] std::optional<PoseFit> other_minimum(const PoseProblem& problem, const PoseFit& fit,
                                                   double gate, int max_iterations);

}  // namespace asterism
