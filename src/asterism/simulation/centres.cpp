// SPDX-License-Identifier: Apache-2.0
#include "asterism/simulation/centres.hpp"

#include <utility>

#include "asterism/simulation/streams.hpp"

namespace asterism {
namespace {

// Below this share of a disc seen, its ellipse would be a guess; below this brightness it is not found.
constexpr double kWhole = 0.98;
constexpr double kBright = 0.1;

Centre centre_at(const Ellipse& ellipse, const Cell& cell, double sigma_px, double brightness) {
  const double full_scale = cell.sensor.bits == 16 ? 65535 : 255;
  const double level = cell.light.target_level * brightness;
  Centre centre;
  centre.ellipse = ellipse;
  centre.covariance = Mat2::Identity() * (sigma_px * sigma_px);
  centre.amplitude = full_scale * (level - cell.light.background_level);
  centre.background = full_scale * (cell.light.background_level + cell.sensor.offset_level);
  return centre;
}

/// Whether both cameras miss the target in this frame. A stream for each target: one's fate tells nothing of
/// another's, and the noise of the rest stays as it was.
bool lost_to_both(const Cell& cell, const TargetTruth& target, int frame, std::uint64_t seed) {
  if (cell.noise.target_loss <= 0) return false;
  const int key = target.body * 1024 + target.target;
  return stream_of(seed, frame, Side::Left, Purpose::TargetLoss, key).uniform() < cell.noise.target_loss;
}

void shuffle(std::vector<Centre>& centres, RandomStream& random) {
  for (std::size_t i = centres.size(); i > 1; --i) {
    std::swap(centres[i - 1], centres[random.below(static_cast<std::uint32_t>(i))]);
  }
}

}  // namespace

std::vector<Centre> simulate_centres(const Cell& cell, const FrameTruth& truth, Side side, int frame,
                                     const SimulationOptions& options) {
  RandomStream random = stream_of(options.seed, frame, side, Purpose::Centres);
  std::vector<Centre> centres;
  for (const TargetTruth& target : truth.targets) {
    if (target.side != side) continue;
    // Drawn for each target, seen or not, so that one target's fate does not change the others' noise.
    const Vec2 noise{random.normal(), random.normal()};  // braces: drawn in this order
    const bool missed = random.uniform() < options.dropout;
    if (missed || lost_to_both(cell, target, frame, options.seed)) continue;
    if (!target.in_image || target.visible < kWhole || target.brightness < kBright) continue;
    Ellipse seen = target.image;
    seen.centre += options.sigma_px * noise;
    centres.push_back(centre_at(seen, cell, options.sigma_px, target.brightness));
  }
  const Lens& lens = cell.rig.lens(side);
  const int false_ones = static_cast<int>(random.poisson(options.clutter));
  for (int i = 0; i < false_ones; ++i) {
    const double x = random.uniform(0, lens.width_px - 1);
    const double y = random.uniform(0, lens.height_px - 1);
    const double major = random.uniform(3, 10);
    const double minor = major * random.uniform(0.6, 1.0);
    const Ellipse ellipse{{x, y}, major, minor, random.uniform(-1.5, 1.5)};
    centres.push_back(centre_at(ellipse, cell, options.sigma_px, random.uniform(0.2, 1.0)));
  }
  shuffle(centres, random);
  return centres;
}

}  // namespace asterism
