// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "asterism/cell/cell.hpp"
#include "asterism/report/summary_row.hpp"

namespace asterism {

/// A table as a page shows it; a cell is text, a number or nothing.
struct ReportTable {
  using Value = std::variant<std::monostate, std::string, double>;
  std::string id, title, note;
  std::vector<std::string> columns;  // "RMS error (mm)"
  std::vector<std::vector<Value>> rows;
  std::vector<Verdict> verdicts;  // one a row, or none at all
};

/// Curves over one axis, each with an optional band.
struct ReportChart {
  struct Curve {
    std::string name;
    std::vector<double> x, y;
    std::vector<double> low, high;  // the 95 % band; empty = none
    bool dashed = false;
  };
  std::string id, title, note;
  std::string x_label, y_label;  // with unit
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
  std::vector<std::pair<std::string, double>> limits;  // level lines with their names: the tolerance
};

/// What verify found of a cell in motion, for a page. Frames are moments of the motion.
struct CellReport {
  struct BodyView {
    std::string name;
    std::vector<Target> targets;
    std::vector<RigidMotion> tracker_from_body;  // by frame
    /// By target, then side: a character a frame. `.` seen; B behind the camera, V outside the working
    /// volume, O too oblique, I outside the image, S too small, C too close to another target; a … y hidden
    /// by that one of `solids` (a = 0), z by a later one.
    std::vector<std::array<std::string, 2>> sight;
  };
  struct SolidView {
    std::string name, role;        // role: workpiece, fixture, obstacle
    int carrier = -1;              // a body; −1 = the tracker
    TriangleMesh surface;          // in the carrier's frame
    std::vector<double> error_mm;  // by vertex: worst predicted error over the motion; empty = no map
  };
  struct FrameAxes {
    std::string name;  // "O_g workpiece"
    int carrier = -1;
    RigidMotion carrier_from_frame;
  };
  /// Errors over the motion at one named point of the body in question.
  struct PointErrors {
    std::string name;
    Vec3 in_body;
    std::vector<double> predicted_mm;        // √tr Σ by frame; NaN: not determined
    std::vector<Mat3> predicted_covariance;  // mm², along the tracker's axes
    std::vector<double> measured_mm;         // simulated, tracked, compared; NaN: no pose; empty: not done
    std::vector<double> without_mm = {};     // the platform's own read-out here; empty = not known here
  };

  std::string title, subtitle;
  std::vector<SummaryRow> summary;
  std::vector<std::string> remarks;
  StereoRig rig;
  std::optional<WorkingVolume> volume;
  std::vector<double> times_s;
  std::vector<BodyView> bodies;
  std::vector<SolidView> solids;
  std::vector<FrameAxes> axes;
  std::size_t body = 0;          // the one whose pose is verified
  std::vector<int> visible;      // by frame: its targets that both cameras see
  std::vector<double> coverage;  // by frame: the paper's coefficient; empty = none
  std::vector<PointErrors> points;
  std::vector<double> predicted_rotation_deg, measured_rotation_deg;  // by frame; may be empty
  std::string status;  // a letter a frame as in a tracking report; empty = not tracked
  /// The platform's own read-out, by frame, at the centroid of the targets; may be empty. A page shows it at
  /// the points that have none of their own.
  std::vector<double> without_mm, without_deg;
  double tolerance_mm = 0.25, nominal_mm = 0.025;
  struct Heat {
    std::string title, x_label, y_label, value_label;
    std::vector<double> x, y;
    std::vector<std::vector<double>> value;  // [y][x]; NaN: none
  };
  std::vector<Heat> heats;  // visible count and error over roll × pitch
  std::vector<ReportTable> tables;
  std::vector<ReportChart> charts;
  std::string options_json;
};

/// The report's data as the page reads it (web/src/data/cell_report.ts is the same list).
[[nodiscard]] std::string cell_report_json(const CellReport& report);

/// One HTML file that opens from disk. Throws InputError when it cannot be written.
void write_cell_report(const std::filesystem::path& path, const CellReport& report);

}  // namespace asterism
