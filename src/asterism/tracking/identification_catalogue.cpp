// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <mutex>

#include "asterism/core/result.hpp"
#include "asterism/geometry/congruence_margin.hpp"
#include "asterism/tracking/identification.hpp"

namespace asterism {
namespace {

std::vector<std::vector<UncertainPoint>> targets_of(const std::vector<Body>& bodies) {
  std::vector<std::vector<UncertainPoint>> targets;
  for (const Body& body : bodies) {
    targets.emplace_back();
    for (const Target& target : body.targets) {
      targets.back().push_back({target.position, target.covariance.value_or(Mat3::Zero())});
    }
  }
  return targets;
}

double diameter_of(const std::vector<UncertainPoint>& targets) {
  double longest = 0;
  for (const auto& a : targets) {
    for (const auto& b : targets) longest = std::max(longest, (a.position - b.position).norm());
  }
  return longest;
}

std::vector<Vec3> positions_of(std::span<const UncertainPoint> targets) {
  std::vector<Vec3> positions;
  for (const auto& target : targets) positions.push_back(target.position);
  return positions;
}

}  // namespace

struct BodyCatalogue::Margins {
  std::mutex guard;
  std::map<std::pair<std::size_t, std::vector<int>>, double> known;
};

BodyCatalogue::BodyCatalogue(std::vector<Body> bodies, const IdentificationOptions& options)
    : bodies_((check_bodies(bodies, "bodies"), std::move(bodies))),
      targets_(targets_of(bodies_)),
      table_(targets_),
      margin_cap_mm_(options.margin_cap_mm),
      margins_(std::make_shared<Margins>()) {
  for (const auto& targets : targets_) diameters_mm_.push_back(diameter_of(targets));
}

double BodyCatalogue::margin_mm(std::size_t body, const std::vector<int>& targets) const {
  const auto key = std::make_pair(body, targets);
  {
    const std::lock_guard lock(margins_->guard);
    const auto known = margins_->known.find(key);
    if (known != margins_->known.end()) return known->second;
  }
  std::vector<Vec3> seen;
  for (const int target : targets)
    seen.push_back(bodies_[body].targets[static_cast<std::size_t>(target)].position);
  double margin = margin_cap_mm_;
  // The body itself first: what it leaves is the cap for the others.
  for (std::size_t step = 0; step < bodies_.size(); ++step) {
    const std::size_t other = step == 0 ? body : step <= body ? step - 1 : step;
    const auto right = other == body ? std::span<const int>(targets) : std::span<const int>();
    const auto wrong = best_wrong_labelling(seen, positions_of(targets_[other]), right, margin);
    if (wrong.best) margin = wrong.best->rms_mm;
  }
  const std::lock_guard lock(margins_->guard);
  margins_->known.emplace(key, margin);
  return margin;
}

}  // namespace asterism
