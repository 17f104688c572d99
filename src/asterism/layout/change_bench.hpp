// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "asterism/layout/suggestion.hpp"

namespace asterism {

/// By what changes are compared: by better(), or, with another change to follow, by what all losses together
/// do: where the loss of another target is the worst, that one may be moved after.
enum class Foresight { None, OneMore };

/// A model with what was observed, ready to be asked about many changes of its present layout.
class ChangeBench {
 public:
  ChangeBench(const LayoutModel& model, ObservedSights observed, LayoutQuantity objective,
              Foresight foresight = Foresight::None);

  [[nodiscard]] const LayoutModel& model() const { return model_; }
  [[nodiscard]] const std::vector<Target>& present() const { return present_; }
  /// The same with a change made.
  [[nodiscard]] ChangeBench after(const LayoutChange& change) const;
  [[nodiscard]] bool prefers(const LayoutStanding& a, const LayoutStanding& b) const;
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
  std::vector<Target> present_;
  ObservedSights observed_;
  LayoutQuantity objective_;
  Foresight foresight_;
  QuantitySet wanted_{};
};

/// (Σ E⁸)^(1/8) over the ways to lose so many targets, E being the worst error of each over poses and points.
/// None when one of them leaves a pose undetermined.
[[nodiscard]] std::optional<double> error_over_losses(std::span<const Target> targets,
                                                      const SeenMotion& motion, const MotionVisibility& seen,
                                                      const LayoutModel& model, std::size_t losses);

}  // namespace asterism
