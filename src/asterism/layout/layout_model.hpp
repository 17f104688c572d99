// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asterism/accuracy/motion_accuracy.hpp"
#include "asterism/cell/cell.hpp"
#include "asterism/layout/design.hpp"
#include "asterism/layout/genome.hpp"
#include "asterism/layout/seeds.hpp"

namespace asterism {

// The designer's workbench: a cell's layout task made ready to be asked about many layouts.

constexpr std::size_t kLayoutQuantities = static_cast<std::size_t>(LayoutQuantity::Moving) + 1;

/// Which quantities are wanted.
using QuantitySet = std::array<bool, kLayoutQuantities>;

/// What is known of a layout; only what was wanted is filled in.
struct LayoutValues {
  std::array<std::optional<double>, kLayoutQuantities> of;
  MotionVisibility visibility;
  MotionAccuracy accuracy;
  IdentifiabilityMargin within;

  [[nodiscard]] const std::optional<double>& operator[](LayoutQuantity quantity) const {
    return of[static_cast<std::size_t>(quantity)];
  }
};

class LayoutModel {
 public:
  /// Throws InputError when the cell has no layout task or its body is not there, and for bad options.
  LayoutModel(const Cell& cell, const DesignerOptions& options);

  /// Which targets each camera sees in each pose of the motion, every line of sight asked.
  [[nodiscard]] MotionVisibility visibility_of(std::span<const Target> targets) const;

  /// Is a pure function.
  [[nodiscard]] LayoutValues values(std::span<const Target> targets, const QuantitySet& wanted,
                                    double identifiability_cap_mm) const;
  /// The same where it is known what is seen.
  [[nodiscard]] LayoutValues values(std::span<const Target> targets, MotionVisibility seen,
                                    const QuantitySet& wanted, double identifiability_cap_mm) const;

  /// Targets P1 … Pn facing as the surface does.
  [[nodiscard]] std::vector<Target> targets_at(std::span<const Vec3> positions) const;
  /// The same targets with what they lack: a normal, a diameter.
  [[nodiscard]] std::vector<Target> completed(std::span<const Target> targets) const;

  [[nodiscard]] double bound_on(LayoutQuantity quantity) const;

  LayoutTask task;
  DesignerOptions options;
  LayoutRules rules;
  Bounds bounds;
  std::vector<LayoutQuantity> objectives;
  std::vector<LayoutConstraint> constraints;  // the task's and the options'
  std::vector<double> times_s;
  SeenMotion motion;
  std::size_t carrier = 0;                           // that carries the targets
  std::vector<std::vector<RigidMotion>> cell_poses;  // of all movers, as Occlusion has them
  Occlusion occlusion;
  std::uint64_t occluders_mark = 0;  // tells the cell's solids from any others
  std::optional<WorkingVolume> volume;
  std::vector<Vec3> points;
  std::vector<Target> present;
  std::vector<Body> others;  // with four targets or more

 private:
  void place_among_solids(const Cell& cell);
  void measure_identifiability(std::span<const Vec3> positions, double cap_mm, LayoutValues& values) const;
  void predict_errors(std::span<const Target> targets, const QuantitySet& wanted, LayoutValues& values) const;
};

/// Throws InputError when room is found for fewer than `fewest` targets at the spacing; lowers `most` and
/// returns a warning when it is found for fewer than that.
[[nodiscard]] std::optional<std::string> check_room(LayoutModel& model);

/// Throws InputError when in some pose no place of the surface is seen by both cameras, with that pose's time
/// and the reason; warns when fewer places than must be visible are seen at once.
[[nodiscard]] std::optional<std::string> check_sight(const LayoutModel& model);

/// What each place of the surface tells of the poses, zero where both cameras do not see it.
[[nodiscard]] std::vector<PlaceInformation> information_of(const LayoutModel& model,
                                                           std::span<const Place> places);

}  // namespace asterism
