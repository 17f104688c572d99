// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>

#include "asterism/cell/frame_chain.hpp"
#include "asterism/cell/occluders.hpp"
#include "asterism/io/options_file.hpp"
#include "asterism/workflow/fusion_tables.hpp"
#include "asterism/workflow/robustness_tables.hpp"
#include "asterism/workflow/verify_cell.hpp"

namespace asterism {
namespace {

// As the report's contract has it: what is not there.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

char letter_of(const SightCause& cause) {
  static constexpr std::string_view kLetters = "BVOISC";
  if (!cause.fails) return '.';
  if (*cause.fails != SightFailure::Hidden) return kLetters[static_cast<std::size_t>(*cause.fails)];
  const std::size_t solid = cause.solid.value_or(25);
  return static_cast<char>('a' + std::min<std::size_t>(solid, 25));
}

CellReport::BodyView view_of(const Cell& cell, const VerifiedCell& verified, std::size_t mover) {
  CellReport::BodyView view{cell.movers[mover].body.name, cell.movers[mover].body.targets, {}, {}};
  for (const auto& poses : verified.watched.poses) view.tracker_from_body.push_back(poses[mover]);
  view.sight.resize(view.targets.size());
  for (const auto& pose : verified.watched.bodies[mover].causes) {
    for (std::size_t target = 0; target < view.sight.size(); ++target) {
      for (std::size_t side = 0; side < 2; ++side) view.sight[target][side] += letter_of(pose[target][side]);
    }
  }
  return view;
}

std::vector<CellReport::SolidView> solids_of(const Cell& cell, const VerifiedCell& verified) {
  std::vector<CellReport::SolidView> views;
  if (cell.workpiece && cell.workpiece->surface) {
    const Solid& part = *cell.workpiece;
    views.push_back({part.name, "workpiece", mover_index(cell, part.body),
                     moved(*part.surface, part.carrier_from_solid),
                     verified.map ? verified.map->error_mm : std::vector<double>{}});
  }
  for (const Solid& fixture : cell.fixtures) {
    if (!fixture.surface) continue;
    views.push_back({fixture.name,
                     "fixture",
                     mover_index(cell, fixture.body),
                     moved(*fixture.surface, fixture.carrier_from_solid),
                     {}});
  }
  for (const Obstacle& obstacle : cell.obstacles) {
    views.push_back({obstacle.name,
                     "obstacle",
                     mover_index(cell, obstacle.body),
                     moved(mesh_of(obstacle.shape), obstacle.carrier_from_shape),
                     {}});
  }
  return views;
}

std::vector<CellReport::FrameAxes> axes_of(const Cell& cell) {
  std::vector<CellReport::FrameAxes> axes = {{"O_c tracker", -1, {}}};
  const FrameChain chain = frame_chain_at(cell, 0);
  const int platform = cell.platform ? mover_index(cell, cell.platform->body) : -1;
  if (chain.tracker_from_platform) axes.push_back({"O_p platform", platform, {}});
  if (chain.platform_from_target_centroid)
    axes.push_back({"O_1 target centroid", platform, *chain.platform_from_target_centroid});
  if (chain.platform_from_workpiece)
    axes.push_back({"O_g workpiece", platform, *chain.platform_from_workpiece});
  if (cell.scanner) {
    axes.push_back({"O_s scanner", mover_index(cell, cell.scanner->body), cell.scanner->body_from_scanner});
  }
  return axes;
}

std::vector<CellReport::PointErrors> points_of(const VerifiedCell& verified) {
  std::vector<CellReport::PointErrors> points;
  for (const PredictedPoint& predicted : verified.predicted.points) {
    CellReport::PointErrors point{predicted.point.name, predicted.point.in_body_mm, {}, {}, {}};
    for (std::size_t frame = 0; frame < predicted.covariance.size(); ++frame) {
      point.predicted_mm.push_back(predicted.error_mm(frame).value_or(kNone));
      point.predicted_covariance.push_back(predicted.covariance[frame].value_or(Mat3::Constant(kNone)));
      const SimulatedPose& pose = verified.poses[frame];
      point.measured_mm.push_back(pose.error ? error_at(pose, point.in_body).norm() : kNone);
    }
    if (verified.read_out) point.without_mm = verified.read_out->at_mm[points.size()];
    points.push_back(std::move(point));
  }
  return points;
}

std::vector<SummaryRow> rows_of(const VerifiedCell& verified) {
  const CellVerdict& verdict = verified.verdict;
  std::vector<SummaryRow> rows = {{verdict.pass ? "PASS" : "FAIL", fmt::format("{:.3f}", verdict.below_95_mm),
                                   "mm (95 %)", verdict.words, verdict.pass ? Verdict::Good : Verdict::Bad}};
  int fewest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < verified.watched.times_s.size(); ++i)
    fewest = std::min(fewest, visible_at(verified, i));
  rows.push_back({"Fewest targets seen", fmt::format("{}", fewest), "",
                  fmt::format("of {}, by both cameras",
                              verified.watched.bodies[verified.body.mover].causes.front().size()),
                  fewest >= 4 ? Verdict::Good : Verdict::Attention});
  const auto& noise = verified.noise_agreement;
  if (noise.predicted.poses > 0) {
    rows.push_back({"NEES / 6, noise alone", fmt::format("{:.3f}", noise.predicted.mean / 6), "",
                    noise.predicted.honest() ? "in its band: prediction and simulation agree"
                                             : "outside its band: see where the model fails below",
                    noise.predicted.honest() ? Verdict::Good : Verdict::Attention});
  }
  rows.push_back({"Nominal accuracy", fmt::format("{}", verified.nominal_mm), "mm",
                  "what the tracker's maker states, for comparison", Verdict::Plain});
  return rows;
}

/// The read-out beside the tracker, the tolerance above both (Figs. 21 and 22).
std::vector<ReportChart> charts_of(const VerifiedCell& verified) {
  if (!verified.read_out) return {};
  const std::vector<double>& times = verified.watched.times_s;
  ReportChart shift{"with-without-mm",
                    "Translation error with and without targets",
                    "",
                    "time (s)",
                    "error at the target centroid (mm)",
                    false,
                    false,
                    {},
                    {{"tolerance", verified.tolerance_mm}, {"nominal", verified.nominal_mm}}};
  ReportChart turn{"with-without-deg",
                   "Rotation error with and without targets",
                   "",
                   "time (s)",
                   "rotation error (deg)",
                   false,
                   false,
                   {},
                   {}};
  shift.note = turn.note =
      "Without targets: the platform's own read-out with normal noise and jumps, an assumption that gives "
      "what "
      "the paper draws in Figs. 21 and 22.";
  ReportChart::Curve with_mm{"with targets", {}, {}, {}, {}, false}, with_deg = with_mm;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const SimulatedPose& pose = verified.poses[i];
    if (!pose.error) continue;
    with_mm.x.push_back(times[i]);
    with_mm.y.push_back(error_at(pose, verified.body.points[VerifiedBody::kCentroid].in_body_mm).norm());
    with_deg.x.push_back(times[i]);
    with_deg.y.push_back(deg_from_rad(pose.error->head<3>().norm()));
  }
  shift.curves = {
      with_mm, {"without targets", times, verified.read_out->at_mm[VerifiedBody::kCentroid], {}, {}, true}};
  turn.curves = {with_deg, {"without targets", times, verified.read_out->rotation_deg, {}, {}, true}};
  return {shift, turn};
}

}  // namespace

int visible_at(const VerifiedCell& verified, std::size_t frame) {
  return std::popcount(verified.watched.bodies[verified.body.mover].visibility.both(frame));
}

CellReport report_of(const Cell& cell, const VerifiedCell& verified, const VerifyOptions& options) {
  static constexpr std::string_view kStatus = "OPRAL";
  CellReport report;
  report.title = "Cell: " + verified.cell;
  report.subtitle =
      fmt::format("{} frames of {}, {} repeats, {} disturbance runs a layout",
                  verified.watched.times_s.size(), verified.body_name, verified.repeats, options.runs);
  report.summary = rows_of(verified);
  report.remarks = remarks_on(cell);
  report.remarks.insert(report.remarks.end(), verified.remarks.begin(), verified.remarks.end());
  report.rig = cell.rig;
  report.volume = cell.volume;
  report.times_s = verified.watched.times_s;
  for (std::size_t mover = 0; mover < cell.movers.size(); ++mover)
    report.bodies.push_back(view_of(cell, verified, mover));
  report.solids = solids_of(cell, verified);
  report.axes = axes_of(cell);
  report.body = verified.body.mover;
  for (std::size_t frame = 0; frame < report.times_s.size(); ++frame) {
    report.visible.push_back(visible_at(verified, frame));
    const SimulatedPose& pose = verified.poses[frame];
    report.predicted_rotation_deg.push_back(verified.predicted.rotation_deg(frame).value_or(kNone));
    report.measured_rotation_deg.push_back(pose.error ? deg_from_rad(pose.error->head<3>().norm()) : kNone);
    report.status += kStatus[static_cast<std::size_t>(pose.status)];
  }
  report.coverage = verified.watched.coverage;
  report.points = points_of(verified);
  if (verified.read_out) {
    report.without_mm = verified.read_out->at_mm[VerifiedBody::kCentroid];
    report.without_deg = verified.read_out->rotation_deg;
  }
  report.tolerance_mm = verified.tolerance_mm;
  report.nominal_mm = verified.nominal_mm;
  report.heats = attitude_heats(cell, verified, options);
  report.tables = tables_of(verified);
  report.charts = charts_of(verified);
  const auto add = [&](std::vector<ReportChart> charts) {
    for (ReportChart& chart : charts) report.charts.push_back(std::move(chart));
  };
  if (verified.fusion) add(fusion_charts(*verified.fusion, verified.tolerance_mm));
  if (verified.speed) add(speed_trade_charts(*verified.speed, verified.tolerance_mm));
  VerifyOptions shown = options;
  report.options_json = json_of_options(describing(shown)).dump();
  return report;
}

}  // namespace asterism
