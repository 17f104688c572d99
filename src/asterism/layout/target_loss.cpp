// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/target_loss.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/core/random.hpp"
#include "asterism/core/result.hpp"
#include "asterism/geometry/point_sets.hpp"
#include "asterism/statistics/summary.hpp"

namespace asterism {
namespace {

constexpr std::uint32_t kLosses = 0x6c6f7373;  // the purpose of its random streams
constexpr std::size_t kMostTargets = 32, kMostEnumerated = 16;
constexpr std::size_t kRunsTogether = 64;

double mean_distance(std::span<const Vec3> points, const Vec3& from) {
  double sum = 0;
  for (const Vec3& point : points) sum += (point - from).norm();
  return sum / static_cast<double>(points.size());
}

LossDraw measure(std::span<const Vec3> left, const Vec3& full_centroid, LayoutCost cost) {
  LossDraw draw;
  if (left.empty()) return draw;
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = i + 1; j < left.size(); ++j) draw.coverage_mm += (left[i] - left[j]).norm();
  }
  const double pairs = static_cast<double>(left.size() * (left.size() - 1)) / 2;
  switch (cost) {
    case LayoutCost::DistanceToOwnCentroid:
      draw.cost_mm = mean_distance(left, centroid_of(left));
      break;
    case LayoutCost::DistanceToFullCentroid:
      draw.cost_mm = mean_distance(left, full_centroid);
      break;
    case LayoutCost::DistanceToOrigin:
      draw.cost_mm = mean_distance(left, Vec3::Zero());
      break;
    case LayoutCost::MeanPairDistance:
      draw.cost_mm = pairs > 0 ? draw.coverage_mm / pairs : 0.0;
      break;
  }
  return draw;
}

bool dominates(const LossDraw& a, const LossDraw& b) {
  return a.cost_mm <= b.cost_mm && a.coverage_mm >= b.coverage_mm &&
         (a.cost_mm < b.cost_mm || a.coverage_mm > b.coverage_mm);
}

LossDraw draw_once(const Layout& layout, const Vec3& full_centroid, const TargetLossModel& model,
                   RandomStream& random) {
  std::array<Vec3, kMostTargets> left;
  std::size_t count = 0;
  const double threshold = model.loss_probability * 0x1p32;
  for (const Vec3& target : layout) {
    if (static_cast<double>(random.bits()) < threshold) continue;
    const double x = random.normal(), y = random.normal(), z = random.normal();
    left[count++] = target + model.noise_mm * Vec3(x, y, z);
  }
  return measure({left.data(), count}, full_centroid, model.cost);
}

/// One set of targets left and how probable it is.
struct Outcome {
  LossDraw draw;
  double probability;
  double cost_noise_mm;  // standard deviation that the noise adds to the cost
};

/// A mean of k distances of independent noise σ varies by σ/√k; for pairs, which share targets, by twice
/// that at most. Against the spread by losses it is small.
double cost_noise(std::size_t left, const TargetLossModel& model) {
  return left == 0 ? 0.0 : model.noise_mm / std::sqrt(static_cast<double>(left));
}

std::vector<Outcome> outcomes_of(const Layout& layout, const TargetLossModel& model) {
  require(!layout.empty() && layout.size() <= kMostEnumerated, "up to 16 targets can be enumerated");
  const Vec3 full_centroid = centroid_of(layout);
  const std::uint32_t sets = std::uint32_t{1} << layout.size();
  std::vector<Outcome> outcomes(sets);
  for (std::uint32_t set = 0; set < sets; ++set) {
    Layout left;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      if ((set >> i & 1U) != 0) left.push_back(layout[i]);
    }
    const auto lost = static_cast<double>(layout.size() - left.size());
    outcomes[set] = {measure(left, full_centroid, model.cost),
                     std::pow(model.loss_probability, lost) *
                         std::pow(1 - model.loss_probability, static_cast<double>(left.size())),
                     cost_noise(left.size(), model)};
  }
  return outcomes;
}

struct Moments {
  double mean = 0, deviation = 0;
  double error_of_mean = 0, error_of_deviation = 0;
};

template <class Value>
Moments moments_of(const std::vector<Outcome>& outcomes, const Value& value, double noise_variance,
                   double runs) {
  Moments moments;
  for (const Outcome& outcome : outcomes) moments.mean += outcome.probability * value(outcome);
  double second = 0, fourth = 0;
  for (const Outcome& outcome : outcomes) {
    const double square = std::pow(value(outcome) - moments.mean, 2);
    second += outcome.probability * square;
    fourth += outcome.probability * square * square;
  }
  // A normal noise on top: its variance adds, and its part of the fourth moment with it.
  fourth += 6 * second * noise_variance + 3 * noise_variance * noise_variance;
  second += noise_variance;
  moments.deviation = std::sqrt(second);
  moments.error_of_mean = std::sqrt(second / runs);
  moments.error_of_deviation =
      second > 0 ? std::sqrt(std::max(0.0, fourth - second * second) / runs) / (2 * moments.deviation) : 0.0;
  return moments;
}

/// Given what is left of one layout, the others are independent of one another.
double front_share(std::span<const std::vector<Outcome>> all, std::size_t which) {
  double share = 0;
  for (const Outcome& outcome : all[which]) {
    double undominated = outcome.probability;
    for (std::size_t other = 0; other < all.size(); ++other) {
      if (other == which) continue;
      double dominating = 0;
      for (const Outcome& rival : all[other]) {
        if (dominates(rival.draw, outcome.draw)) dominating += rival.probability;
      }
      undominated *= 1 - dominating;
    }
    share += undominated;
  }
  return share;
}

}  // namespace

std::vector<std::vector<LossDraw>> draw_target_loss(std::span<const Layout> layouts,
                                                    const TargetLossModel& model, std::size_t runs,
                                                    std::uint64_t seed) {
  require(model.loss_probability >= 0 && model.loss_probability <= 1, "a probability lies in [0, 1]");
  std::vector<Vec3> centroids;
  for (const Layout& layout : layouts) {
    require(!layout.empty() && layout.size() <= kMostTargets, "a layout has 1 to 32 targets");
    centroids.push_back(centroid_of(layout));
  }
  std::vector<std::vector<LossDraw>> draws(layouts.size(), std::vector<LossDraw>(runs));
  parallel_for((runs + kRunsTogether - 1) / kRunsTogether, [&](std::size_t piece) {
    const std::size_t end = std::min(runs, (piece + 1) * kRunsTogether);
    for (std::size_t run = piece * kRunsTogether; run < end; ++run) {
      for (std::size_t l = 0; l < layouts.size(); ++l) {
        RandomStream random(seed, run * layouts.size() + l, kLosses);
        draws[l][run] = draw_once(layouts[l], centroids[l], model, random);
      }
      for (auto& of_layout : draws) {
        of_layout[run].on_front = true;
        for (const auto& rival : draws) {
          if (dominates(rival[run], of_layout[run])) of_layout[run].on_front = false;
        }
      }
    }
  });
  return draws;
}

std::vector<LossFigures> figures_of(std::span<const std::vector<LossDraw>> draws) {
  std::vector<LossFigures> figures;
  for (const std::vector<LossDraw>& runs : draws) {
    std::vector<double> costs, coverages;
    double on_front = 0;
    for (const LossDraw& run : runs) {
      costs.push_back(run.cost_mm);
      coverages.push_back(run.coverage_mm);
      on_front += run.on_front;
    }
    const Summary cost = summarize(costs), coverage = summarize(coverages);
    figures.push_back({cost.mean, cost.deviation, coverage.mean, coverage.deviation,
                       on_front / static_cast<double>(runs.size())});
  }
  return figures;
}

std::vector<LossExpectation> expect_target_loss(std::span<const Layout> layouts, const TargetLossModel& model,
                                                std::size_t runs) {
  std::vector<std::vector<Outcome>> all;
  for (const Layout& layout : layouts) all.push_back(outcomes_of(layout, model));
  const auto n = static_cast<double>(runs);
  std::vector<LossExpectation> expectations;
  for (std::size_t l = 0; l < layouts.size(); ++l) {
    double noise = 0;
    for (const Outcome& outcome : all[l]) noise += outcome.probability * std::pow(outcome.cost_noise_mm, 2);
    const Moments cost = moments_of(
        all[l], [](const Outcome& o) { return o.draw.cost_mm; }, noise, n);
    const Moments coverage = moments_of(
        all[l], [](const Outcome& o) { return o.draw.coverage_mm; }, 0, n);
    const double share = front_share(all, l);
    expectations.push_back({{cost.mean, cost.deviation, coverage.mean, coverage.deviation, share},
                            {cost.error_of_mean, cost.error_of_deviation, coverage.error_of_mean,
                             coverage.error_of_deviation, std::sqrt(share * (1 - share) / n)}});
  }
  return expectations;
}

}  // namespace asterism
