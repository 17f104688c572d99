// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/geometry/surface_tree.hpp"

namespace asterism {

/// Where the arm's last joint is with these angles (rad), in its base's frame; `frames`, where asked for,
/// gets that of every joint.
[[nodiscard]] RigidMotion flange_of(const Robot& robot, std::span<const double> angles_rad,
                                    std::vector<RigidMotion>* frames = nullptr);

/// Angles within the joints' limits that bring the scanner's body to a place and are accepted: damped least
/// squares (Levenberg) from twelve starts, always the same ones, so the answer is too. None when the place is
/// out of reach, as far as those starts tell.
using AcceptAngles = std::function<bool(std::span<const double> angles_rad)>;
[[nodiscard]] std::optional<std::vector<double>> joint_angles(const Robot& robot,
                                                              const RigidMotion& base_from_body,
                                                              const AcceptAngles& accept = {});

/// Does the arm get there, its links clear of part, fixtures and what else stands in the cell? Links against
/// one another, and the way from view to view, are not looked at.
class RobotReach {
 public:
  explicit RobotReach(const Cell& cell);
  [[nodiscard]] bool reaches(const RigidMotion& tracker_from_body,
                             const RigidMotion& tracker_from_part) const;

 private:
  [[nodiscard]] bool is_free(std::span<const double> angles_rad, const RigidMotion& part_from_base) const;

  Robot robot_;
  SurfaceTree part_, surroundings_;  // what moves with the part, in its frame; the rest, in the tracker's
};

}  // namespace asterism
