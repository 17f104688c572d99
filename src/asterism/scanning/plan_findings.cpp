// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/plan_findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "asterism/core/parallel.hpp"

namespace asterism {
namespace {

constexpr double kWorthALook = 0.02;  // share of an area

/// Places that the cell does not let be measured, and count.
std::vector<std::uint32_t> never_covered(const PlanGround& ground, const CandidateStudy& study) {
  std::vector<std::uint32_t> samples;
  for (std::uint32_t i = 0; i < ground.samples.size(); ++i) {
    if (ground.samples[i].weight > 0 && !bit_at(study.coverable, i)) samples.push_back(i);
  }
  return samples;
}

/// Which of the scanner's own limits, lifted alone, would let an allowed view measure the place?
LimitMask scanner_limits_that_cost(const PlanGround& ground, std::span<const RigidMotion> views,
                                   const SurfaceSample& sample) {
  const Scanner& scanner = *ground.cell.scanner;
  const AskedLimits& asked = ground.options.asked;
  LimitMask counted = 0, found = 0;
  for (const ScanLimit limit : {ScanLimit::Range, ScanLimit::Field, ScanLimit::Incidence, ScanLimit::Sight}) {
    if (asked[limit]) counted |= mask_of(limit);
  }
  for (const RigidMotion& view : views) {
    const Vec3 way = sample.at - view.translation;
    if (way.squaredNorm() > 16 * scanner.far_mm * scanner.far_mm)
      continue;  // no one means to scan from there
    const LimitMask fails = failing_limits(scanner, view.inverse(), sample) & counted;
    if (std::popcount(fails) > 1 || (fails & found) != 0) continue;
    const bool hidden = (fails & mask_of(ScanLimit::Sight)) != 0;
    if (fails == 0 || hidden) {
      found |= asked[ScanLimit::Sight] ? mask_of(ScanLimit::Sight) : 0;
    } else if (!asked[ScanLimit::Sight] || (in_sight(scanner, view, sample, ground.scene.part) &&
                                            in_sight(scanner, view, sample, ground.scene.fixtures))) {
      found |= fails;
    }
  }
  return found;
}

void add_scanner_costs(const PlanGround& ground, const CandidateStudy& study,
                       std::array<double, kScanLimits>& area) {
  std::vector<RigidMotion> views;
  std::uint32_t last = static_cast<std::uint32_t>(-1);
  for (const AllowedView& allowed : study.allowed) {
    if (allowed.view != last) views.push_back(study.views[allowed.view].workpiece_from_scanner);
    last = allowed.view;
  }
  const std::vector<std::uint32_t> uncovered = never_covered(ground, study);
  std::vector<LimitMask> costs(uncovered.size());
  parallel_for(uncovered.size(), [&](std::size_t i) {
    costs[i] = scanner_limits_that_cost(ground, views, ground.samples[uncovered[i]]);
  });
  for (std::size_t i = 0; i < uncovered.size(); ++i) {
    for (std::size_t limit = 0; limit < kScanLimits; ++limit) {
      if ((costs[i] >> limit & 1U) != 0) area[limit] += ground.samples[uncovered[i]].area_mm2;
    }
  }
}

double area_beyond(const PlanGround& ground, const SampleBits& gained, const SampleBits& coverable) {
  double area = 0;
  for_each_bit(gained, [&](std::size_t i) {
    if (!bit_at(coverable, i) && ground.samples[i].weight > 0) area += ground.samples[i].area_mm2;
  });
  return area;
}

}  // namespace

std::vector<LimitCost> limit_costs(const PlanGround& ground, const CandidateStudy& study) {
  std::array<double, kScanLimits> area{};
  add_scanner_costs(ground, study, area);
  std::array<SampleBits, kScanLimits> gained;
  gained.fill(SampleBits(study.rows.words(), 0));
  for (const ForbiddenView& view : study.forbidden) {
    if (std::popcount(view.fails) != 1) continue;
    SampleBits& bits = gained[static_cast<std::size_t>(std::countr_zero(view.fails))];
    const auto row = study.rows.row(view.view);
    for (std::size_t word = 0; word < row.size(); ++word) bits[word] |= row[word];
  }
  SampleBits& uncertain = gained[static_cast<std::size_t>(ScanLimit::Uncertainty)];
  for (std::size_t word = 0; word < uncertain.size(); ++word) uncertain[word] |= study.uncertain[word];
  std::vector<LimitCost> costs;
  for (std::size_t limit = 0; limit < kScanLimits; ++limit) {
    const double cost = area[limit] + area_beyond(ground, gained[limit], study.coverable);
    if (cost > 0) costs.push_back({static_cast<ScanLimit>(limit), cost});
  }
  std::stable_sort(costs.begin(), costs.end(),
                   [](const auto& a, const auto& b) { return a.area_mm2 > b.area_mm2; });
  return costs;
}

std::string why_none_is_allowed(const PlanGround& ground, const CandidateStudy& study) {
  std::map<std::uint32_t, LimitMask> always;  // by view: fails in every pose
  for (const ForbiddenView& view : study.forbidden) {
    always.try_emplace(view.view, ~LimitMask{0}).first->second &= view.fails;
  }
  std::vector<std::pair<std::size_t, std::size_t>> counts;  // views, limit
  for (std::size_t limit = 0; limit < kScanLimits; ++limit) {
    std::size_t count = 0;
    for (const auto& [view, fails] : always) count += fails >> limit & 1U;
    if (count > 0) counts.emplace_back(count, limit);
  }
  std::stable_sort(counts.begin(), counts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> words;
  for (const auto& [count, limit] : counts) {
    words.push_back(
        fmt::format("{} ({} of {})", text_of(static_cast<ScanLimit>(limit)), count, always.size()));
  }
  if (words.empty()) words.push_back(fmt::format("no one limit (of {})", ground.sight.poses().size()));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::string> plan_remarks(const PlanGround& ground, const CandidateStudy& study,
                                      const ScanPlan& plan) {
  std::vector<std::string> remarks = remarks_on(ground.cell);
  // Down, as the part rests on its platform.
  const RigidMotion& rest = ground.sight.poses().front().tracker_from_platform;
  const Vec3 up = (ground.sight.tracker_from_part(0).inverse().rotation * rest.rotation) * Vec3::UnitZ();
  double under = 0;
  for (const std::uint32_t i : never_covered(ground, study)) {
    if (ground.samples[i].normal.dot(up) < -0.7) under += ground.samples[i].area_mm2;
  }
  if (under > kWorthALook * plan.surface_mm2) {
    remarks.push_back(
        fmt::format("the underside, {:.0f} % of the surface, is never covered: turn the part over "
                    "and scan it anew",
                    100 * under / plan.surface_mm2));
  }
  const double good = std::cos(rad_from_deg(ground.cell.scanner->good_incidence_deg));
  std::vector<std::uint8_t> well(ground.samples.size(), 0), seen(ground.samples.size(), 0);
  for (const PlannedView& view : plan.views) {
    for (const std::uint32_t i : view.measures) {
      const Vec3 way = view.workpiece_from_scanner.translation - ground.samples[i].at;
      seen[i] = 1;
      if (ground.samples[i].normal.dot(way.normalized()) >= good) well[i] = 1;
    }
  }
  double all = 0, oblique = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    all += seen[i] != 0 ? ground.samples[i].area_mm2 : 0;
    oblique += seen[i] != 0 && well[i] == 0 ? ground.samples[i].area_mm2 : 0;
  }
  if (oblique > kWorthALook * all) {
    remarks.push_back(fmt::format("{:.0f} % of what these views measure is seen beyond {:g}° only",
                                  100 * oblique / all, ground.cell.scanner->good_incidence_deg));
  }
  return remarks;
}

}  // namespace asterism
