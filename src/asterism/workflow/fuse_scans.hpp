// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/io/mesh_scale.hpp"
#include "asterism/measurement/cloud.hpp"
#include "asterism/report/summary_row.hpp"
#include "asterism/scanning/carrying.hpp"
#include "asterism/scanning/completeness.hpp"
#include "asterism/scanning/deviation.hpp"
#include "asterism/scanning/registration.hpp"
#include "asterism/scanning/scan_surface.hpp"
#include "asterism/scanning/surface_samples.hpp"

namespace asterism {

struct FuseScansOptions {
  CarryOptions carrying;
  ScanSurfaceOptions surface;
  CloudFusionOptions fusion;
  RegistrationOptions registration;
  CompletenessOptions completeness;
  DeviationOptions deviation;
  int samples = 8000;  // of the part's surface, that completeness is judged by
};
void describe(FuseScansOptions& options, OptionVisitor& visit);

/// What a user asks for.
struct FuseScansJob {
  std::vector<std::filesystem::path> scans;  // folders with scans.csv, each with its poses: one run or more
  std::filesystem::path out;  // the cloud's PLY file; fusion.json comes beside it; empty: nothing is written
  std::string cell;           // file or built-in; empty: cell.toml in the first folder, if any
  std::filesystem::path poses;      // empty: track/poses.csv or poses.csv in each folder
  std::string reference;            // body that carries the part; empty: the cell's platform
  std::filesystem::path hand_eye;   // empty: the cell's scanner pose
  std::filesystem::path alignment;  // empty: the cell's workpiece pose
  std::filesystem::path mesh;       // the part's surface; empty: the cell's
  MeshScale mesh_scale;
  double scans_mm_each = 1;  // of the unit that the scans' numbers are in
  double poses_mm_each = 1;
  bool report = false;  // report.html beside the cloud
  bool refine = false;  // correct poses by the scans' shape, weighed against how well they are tracked
  std::uint64_t seed = 1;
  FuseScansOptions options;
};

/// What became of one scan.
struct FusedScanRow {
  int scan = 0;
  std::string file, body;
  std::size_t points = 0, not_finite = 0, outliers = 0;  // read; left out
  std::size_t no_pose = 0, outside_run = 0, gap = 0;     // left out for want of a pose
  std::size_t used = 0;
  double sigma_mm = 0;                   // of its pose, at the middle of its points: √(tr Σ / 3)
  std::optional<Registration> by_shape;  // against the other scans; none: too little overlap
};

struct FusedScans {
  std::string frame;  // "workpiece", "platform" (its body's name), "tracker"
  FusedCloud fused;
  Cloud cloud;  // fields of cloud_of, and deviation_mm where there is a surface
  std::vector<FusedScanRow> scans;
  std::vector<std::string> remarks;  // what was not known and how it was helped, what is odd
  Scanner scanner;                   // whose noise was taken
  double pose_sigma_mm = 0;          // noise that poses without covariance were given
  std::string part;                  // the surface's name
  TriangleMesh surface;
  std::vector<SurfaceSample> samples;
  std::optional<Completeness> completeness;
  std::optional<Deviation> deviation;
};

/// Scans and poses → one cloud with an uncertainty at each point. Throws InputError for a folder, file or
/// unit that is wrong, MeasurementError when not one point has a pose.
[[nodiscard]] FusedScans fuse_scans(const FuseScansJob& job, const Progress& progress);

/// What fusion.json holds.
[[nodiscard]] nlohmann::ordered_json summary_of(const FusedScans& fused, const FuseScansJob& job);
/// What comes first on a page.
[[nodiscard]] std::vector<SummaryRow> summary_rows_of(const FusedScans& fused);
/// The same for people.
[[nodiscard]] std::string text_of(const FusedScans& fused);

}  // namespace asterism
