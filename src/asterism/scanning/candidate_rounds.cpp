// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "asterism/scanning/candidate_study.hpp"

namespace asterism {
namespace {

/// Every so many of them, so that no more than `most` places with three candidates each remain.
std::vector<std::uint32_t> some_uncovered(const PlanGround& ground, const CandidateStudy& study,
                                          std::span<const std::uint32_t> before, int round) {
  std::vector<std::uint8_t> done(ground.samples.size(), 0);
  for (const std::uint32_t i : before) done[i] = 1;
  std::vector<std::uint32_t> all, some;
  for (std::uint32_t i = 0; i < done.size(); ++i) {
    if (done[i] == 0 && ground.samples[i].weight > 0 && !bit_at(study.coverable, i)) all.push_back(i);
  }
  const auto most = static_cast<std::size_t>(std::max(1, ground.options.candidates_more / 3));
  const std::size_t step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
  for (std::size_t i = static_cast<std::size_t>(round) % step; i < all.size(); i += step)
    some.push_back(all[i]);
  return some;
}

}  // namespace

CandidateStudy study_candidates(const PlanGround& ground, std::span<const std::uint32_t> before,
                                std::uint64_t seed, const Progress& progress) {
  const bool all_poses = ground.options.objective == PlanObjective::Time;
  const int rounds = ground.options.method == PlanMethod::Rings ? 0 : ground.options.rounds;
  const auto total = static_cast<std::size_t>(rounds) + 1;
  progress("trying viewpoints", 0, total);
  CandidateStudy study = study_of(ground, first_views(ground, seed), all_poses);
  for (int round = 0; round < rounds; ++round) {
    progress("trying viewpoints", static_cast<std::size_t>(round) + 1, total);
    const std::vector<std::uint32_t> uncovered = some_uncovered(ground, study, before, round);
    if (uncovered.empty()) break;
    const std::uint64_t of_round = seed + 1000003ULL * (static_cast<std::uint64_t>(round) + 1);
    append(study, study_of(ground, targeted_views(ground, uncovered, of_round), all_poses));
  }
  progress("trying viewpoints", total, total);
  return study;
}

}  // namespace asterism
