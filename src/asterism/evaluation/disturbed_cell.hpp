// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "asterism/cell/cell.hpp"

namespace asterism {

// The truth stays as the cell has it; what is disturbed is what the tracker believes. So every layout, every
// estimator and every run is held against the same truth.

/// Where errors come from; the shares of the error budget.
enum class ErrorSource { Detection, Calibration, Map, Smear, Latency, Thermal };
constexpr std::size_t kErrorSources = 6;
[[nodiscard]] std::string_view text_of(ErrorSource source);

/// Covariance of rig_parameter_names(cell.rig): the rig's own where it has one, else the noise model's
/// sigmas, independent; not filled where both say nothing.
[[nodiscard]] MatX calibration_covariance(const Cell& cell);

/// Covariance (mm²) of a target's place as learnt: its own where it has one, else map_sigma_mm.
[[nodiscard]] Mat3 map_covariance(const Target& target, const NoiseModel& noise);

/// A rig whose parameters are off by `error`, in the order of rig_parameter_names.
[[nodiscard]] StereoRig rig_with_error(StereoRig rig, const VecX& error);

/// Where a body keeps its place while it grows with warmth: the platform's pivot, else the body's origin.
[[nodiscard]] Vec3 fixed_point(const Cell& cell, const Body& body);

/// What a tracker is told: rig, targets, and how sure they are.
struct Belief {
  StereoRig rig;
  std::vector<Body> bodies;
  double latency_s = 0;  // its pose is used so long after the exposure
};

/// All of it right, with the covariances that the cell states; used without delay.
[[nodiscard]] Belief stated_belief(const Cell& cell);

/// All of it right and known to be.
[[nodiscard]] Belief exact_belief(const Cell& cell);

/// Beliefs of disturbance runs: a rig wrong by the calibration's sigmas, bodies wrong by the map's, learnt
/// before they grew, a pose used late. The draws of a run are keyed by (seed, run, body, place of the target
/// in its list), so that layouts are compared under common random numbers.
class Disturber {
 public:
  Disturber(Cell cell, std::uint64_t seed);

  [[nodiscard]] Belief belief(std::uint64_t run) const;

  // The same, piece by piece, from standard normal numbers.
  [[nodiscard]] std::size_t calibration_inputs() const { return static_cast<std::size_t>(root_.cols()); }
  [[nodiscard]] StereoRig rig(const VecX& normal) const;
  /// `map`: three numbers a target. The body has warmed by `warming_k` since it was learnt.
  [[nodiscard]] Body body(std::size_t mover, const VecX& map, double warming_k) const;

  [[nodiscard]] VecX calibration_draw(std::uint64_t run) const;
  [[nodiscard]] VecX map_draw(std::uint64_t run, std::size_t mover) const;
  [[nodiscard]] double warmth_draw(std::uint64_t run) const;  // standard normal

 private:
  Cell cell_;
  Belief stated_;
  MatX root_;                             // covariance of the rig's parameters = root · rootᵀ
  std::vector<std::vector<Mat3>> roots_;  // of each target's place, by mover
  std::uint64_t seed_;
};

}  // namespace asterism
