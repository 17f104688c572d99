// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "asterism/cell/paper_layouts.hpp"
#include "asterism/layout/frame.hpp"
#include "asterism/layout/metrics.hpp"
#include "asterism/reproduction/chapters.hpp"
#include "asterism/reproduction/frames_figures.hpp"
#include "asterism/reproduction/printed.hpp"

namespace asterism {
namespace {

std::vector<LayoutMetrics> metrics_of_table1() {
  std::vector<LayoutMetrics> metrics;
  for (const PublishedLayout& layout : paper_table1()) metrics.push_back(measure_layout(layout.targets));
  return metrics;
}

void add_table2(std::vector<LedgerRow>& rows, const std::vector<LayoutMetrics>& metrics) {
  for (std::size_t s = 0; s < metrics.size(); ++s) {
    const std::string scheme = fmt::format("T2.{}", s + 1);
    rows.push_back(compare({scheme + ".r", "Table 2", fmt::format("scheme {} max radius, mm", s + 1),
                            printed::kTable2[s].max_radius_mm},
                           metrics[s].max_radius_mm, {"largest distance to the centroid, in space", "", ""}));
    rows.push_back(compare({scheme + ".s", "Table 2", fmt::format("scheme {} symmetry score, mm", s + 1),
                            printed::kTable2[s].symmetry_mm},
                           metrics[s].symmetry_mm,
                           {"standard deviation (n − 1) of the distances to the centroid",
                            "two digits changed places in print", ""}));
  }
}

void add_prose(std::vector<LedgerRow>& rows, const std::vector<LayoutMetrics>& metrics) {
  std::vector<std::string> radii;
  bool all = true;
  double lowest = metrics.front().symmetry_mm;
  for (const LayoutMetrics& m : metrics) {
    radii.push_back(fmt::format("{:.2f}", m.max_radius_mm));
    all = all && m.max_radius_mm >= 310 && m.max_radius_mm <= 340;
    lowest = std::min(lowest, m.symmetry_mm);
  }
  rows.push_back(judge({"T2.range", "Section 2.3", "radii of all three schemes, mm", "310–340"},
                       fmt::format("{}", fmt::join(radii, ", ")), all,
                       {"as Table 2", "not every radius lies in that range", ""}));
  rows.push_back(compare({"P.C.lowest_symmetry", "Conclusion", "lowest symmetry score, mm", "20.395"}, lowest,
                         {"smallest of the three schemes", "", ""}));
}

/// Is the matrix printed as Eq. 13 the rotation it is said to be, and do both frames point one way?
void add_equations(std::vector<LedgerRow>& rows) {
  std::vector<std::string> determinants, angles;
  bool rotations = true, alike = true;
  for (const PublishedLayout& layout : paper_table1()) {
    const double determinant = axes_as_printed(layout.targets).determinant();
    determinants.push_back(fmt::format("{:.3f}", determinant));
    rotations = rotations && std::abs(determinant - 1) < 1e-6;
    const auto between = centroid_frame(layout.targets, CentroidAxes::BetweenTargets);
    const auto from_centroid = centroid_frame(layout.targets, CentroidAxes::FromCentroid);
    if (!between || !from_centroid) continue;
    const Vec3 up = between->rotation * Vec3::UnitZ(), other_up = from_centroid->rotation * Vec3::UnitZ();
    const double angle = deg_from_rad(std::acos(std::clamp(up.dot(other_up), -1.0, 1.0)));
    angles.push_back(fmt::format("{:.1f}", angle));
    alike = alike && angle < 5;
  }
  rows.push_back(
      judge({"E13.det", "Eq. 13", "determinant of R for schemes 1, 2, 3 (a rotation has 1)", "1"},
            fmt::format("{}", fmt::join(determinants, ", ")), rotations,
            {"columns v1, v2, n as printed",
             "v1 and v2 are not at right angles; the frame is made of the cross products of Section 2.3 here",
             ""}));
  rows.push_back(judge({"E15.axes", "Eqs. 15, 16 and Section 2.3",
                        "angle between the z axes of the paper's two recipes, schemes 1, 2, 3, deg", "0"},
                       fmt::format("{}", fmt::join(angles, ", ")), alike,
                       {"z along (P2 − C) × (P1 − C) against z along (P2 − P1) × (P3 − P1)",
                        "the recipes point z opposite ways", ""}));
}

}  // namespace

Chapter frames_chapter() {
  Chapter chapter{"Frames of the targets (Sections 2.2, 2.3)", {}, frames_exhibits()};
  const std::vector<LayoutMetrics> metrics = metrics_of_table1();
  add_table2(chapter.rows, metrics);
  add_prose(chapter.rows, metrics);
  add_equations(chapter.rows);
  return chapter;
}

}  // namespace asterism
