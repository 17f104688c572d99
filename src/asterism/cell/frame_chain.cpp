// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/frame_chain.hpp"

#include "asterism/cell/occluders.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/geometry/rigid_fit.hpp"

namespace asterism {
namespace {

/// Axes from the first three targets, origin in the centroid of all (Section 2.3 and Eq. 14 of the paper).
std::optional<RigidMotion> centroid_frame(const Body& body) {
  if (body.targets.size() < 3) return std::nullopt;
  const std::vector<Vec3> places = positions_of(body.targets);
  auto frame = frame_from_three_points(places[0], places[1], places[2]);
  if (!frame) return std::nullopt;
  frame->translation = centroid_of(places);
  return *frame;
}

}  // namespace

FrameChain frame_chain_at(const Cell& cell, double time_s) {
  FrameChain chain;
  const int platform = cell.platform ? mover_index(cell, cell.platform->body) : -1;
  if (platform >= 0) {
    const Mover& mover = cell.movers[static_cast<std::size_t>(platform)];
    chain.tracker_from_platform = pose_at(mover.motion, time_s);
    chain.platform_from_target_centroid = centroid_frame(mover.body);
  }
  const int scanner = cell.scanner ? mover_index(cell, cell.scanner->body) : -1;
  if (scanner >= 0) {
    chain.tracker_from_scanner = pose_at(cell.movers[static_cast<std::size_t>(scanner)].motion, time_s) *
                                 cell.scanner->body_from_scanner;
  }
  if (cell.workpiece) chain.platform_from_workpiece = cell.workpiece->carrier_from_solid;
  if (chain.tracker_from_platform && chain.platform_from_workpiece && chain.tracker_from_scanner) {
    const RigidMotion tracker_from_workpiece = *chain.tracker_from_platform * *chain.platform_from_workpiece;
    chain.workpiece_from_scanner = tracker_from_workpiece.inverse() * *chain.tracker_from_scanner;
  }
  return chain;
}

}  // namespace asterism
