// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/layout/suggestion.hpp"

namespace asterism {

/// A model with what was observed, ready to be asked about many changes of its present layout.
class ChangeBench {
 public:
  ChangeBench(const LayoutModel& model, const ObservedSights& observed, LayoutQuantity objective);

  [[nodiscard]] const LayoutModel& model() const { return model_; }
  [[nodiscard]] const std::vector<Target>& present() const { return model_.present; }
  [[nodiscard]] std::size_t losses() const;

  /// The layout as it stands. For reports: the margin beyond its bound too.
  [[nodiscard]] LayoutStanding standing() const;
  /// The layout after a change, with targets and standing filled in from `kind`, `target` and `place`.
  [[nodiscard]] LayoutChange changed(ChangeKind kind, std::size_t target,
                                     const std::optional<Place>& place = {}) const;

  /// A present target, or for their number a new one, in a place.
  [[nodiscard]] Target placed(std::size_t target, const Place& place) const;
  /// May a target stand there beside all others but `except`?
  [[nodiscard]] bool free(const Vec3& position, std::size_t except) const;
  /// Where unforeseen things did not hide the present targets; those unsound left out.
  [[nodiscard]] MotionVisibility relied_on() const;
  /// What the constraints miss of the visible count: in the worst pose and on average.
  [[nodiscard]] double missing_visible(const MotionVisibility& seen) const;
  [[nodiscard]] double undetermined_violation(std::size_t poses) const;

 private:
  [[nodiscard]] LayoutStanding standing_of(std::span<const Target> targets, const MotionVisibility& unhidden,
                                           double cap_mm) const;

  const LayoutModel& model_;
  const ObservedSights& observed_;
  LayoutQuantity objective_;
  QuantitySet wanted_{};
};

}  // namespace asterism
