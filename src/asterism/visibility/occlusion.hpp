// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/cell/occluders.hpp"
#include "asterism/core/options.hpp"
#include "asterism/geometry/ray_scene.hpp"
#include "asterism/geometry/slabs.hpp"
#include "asterism/visibility/visibility.hpp"

namespace asterism {

struct OcclusionOptions {
  int rays = 16;              // spread evenly over a disc: one ray alone would hang on the tree's rounding
  double least_share = 0.98;  // of the disc that must be free: an ellipse with a bite is measured wrong
  double proud_mm = 0.5;      // a target's face stands so far before the skin that carries it
};
void describe(OcclusionOptions& options, OptionVisitor& visit);

/// Which part of a cell's solids hides a target from a camera. Solids are gathered by what carries them, one
/// tree a carrier; the camera is moved into the carrier's frame, so the trees stay as they are while bodies
/// move. Asking is const and may be done by many threads.
class Occlusion {
 public:
  explicit Occlusion(const Cell& cell, const OcclusionOptions& options = {});

  /// Nothing can hide anything.
  [[nodiscard]] bool empty() const { return groups_.empty(); }
  /// Of the solids, in the order of occluders_of(cell).
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// Share of a target's disc from which the camera is seen. `target` is in the frame of mover `carrier`;
  /// `tracker_from_mover` holds one pose a mover of the cell. Rays begin on the disc's face; a target without
  /// normal or diameter is a point, asked by one ray.
  [[nodiscard]] double free_share(const Target& target, std::size_t carrier,
                                  std::span<const RigidMotion> tracker_from_mover, Side side) const;

  /// The solid that hides most of the disc (on each ray the first one met counts); none when the share that
  /// is free is enough.
  [[nodiscard]] std::optional<std::size_t> hidden_by(const Target& target, std::size_t carrier,
                                                     std::span<const RigidMotion> tracker_from_mover,
                                                     Side side) const;

  /// Which targets have a free enough line of sight in each pose: the other half of visible_targets(), to be
  /// joined with it by common(). `poses` hold one pose a mover each.
  [[nodiscard]] MotionVisibility unhidden_targets(std::span<const Target> targets, std::size_t carrier,
                                                  std::span<const std::vector<RigidMotion>> poses) const;

  /// common(seen, unhidden_targets(…)) in less time: what is not seen anyway is not asked about.
  [[nodiscard]] MotionVisibility unhidden_of(const MotionVisibility& seen, std::span<const Target> targets,
                                             std::size_t carrier,
                                             std::span<const std::vector<RigidMotion>> poses) const;

 private:
  struct Group {
    int carrier;                       // a mover; −1 = the tracker
    std::vector<std::size_t> members;  // places in names_, by surface of the tree
    std::vector<Slabs> slabs;          // of each
    RayScene tree;
  };
  struct Face;
  struct View;
  [[nodiscard]] Face face_of(const Target& target, const Vec3& normal) const;
  [[nodiscard]] Face face_before(const Target& target, const Vec3& eye_in_carrier) const;
  [[nodiscard]] View view(std::size_t carrier, std::span<const RigidMotion> tracker_from_mover,
                          Side side) const;
  [[nodiscard]] std::size_t blocked(const Face& face, const View& view, std::size_t most) const;
  [[nodiscard]] std::size_t most_blocked(const Face& face) const;

  StereoRig rig_;
  OcclusionOptions options_;
  std::vector<std::string> names_;
  std::vector<Group> groups_;
};

}  // namespace asterism
