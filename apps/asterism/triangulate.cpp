// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/point_table.hpp"
#include "asterism/io/rig_file.hpp"
#include "asterism/tracking/triangulation.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string rig, left, right, out;
};

std::vector<StereoCentres> frames_of(const Call& call) {
  std::vector<CentreRow> rows = rows_of_camera(read_centre_rows(call.left), Side::Left, call.left);
  const std::vector<CentreRow> right = rows_of_camera(read_centre_rows(call.right), Side::Right, call.right);
  rows.insert(rows.end(), right.begin(), right.end());
  return stereo_centres(rows, fmt::format("{} and {}", call.left, call.right));
}

void run(const Call& call, TriangulationOptions options, const Common& common) {
  const StereoRig rig = read_rig(call.rig);
  const std::vector<StereoCentres> frames = frames_of(call);
  if (frames.empty()) throw MeasurementError("the files hold no centres");
  PointTable table(call.out);
  const Progress progress = make_progress(common);
  std::size_t found = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<Point> points = triangulate(frames[i].left, frames[i].right, rig, options);
    table.write(frames[i].frame, points);
    found += points.size();
    progress("triangulating", i + 1, frames.size());
  }
  table.finish();
  print_result(common,
               {{"frames", frames.size()},
                {"points", found},
                {"out", call.out},
                {"options", json_of_options(describing(options))}},
               fmt::format("{} points in {} frames → {}\n", found, frames.size(), call.out));
}

}  // namespace

void add_triangulate(CLI::App& root, Common& common) {
  CLI::App* command = add_command(
      root, common, "triangulate", "Make points in space from the centres of both cameras",
      "asterism triangulate --rig rig.yaml --left centres.csv --right centres.csv --out points.csv");
  auto call = std::make_shared<Call>();
  command->add_option("--rig", call->rig, "calibrated cameras")->required();
  command->add_option("--left", call->left, "centres of the left camera; may hold both")->required();
  command->add_option("--right", call->right, "centres of the right camera; may hold both")->required();
  command->add_option("--out", call->out, "CSV file of the points")->required();
  const auto options = step_options<TriangulationOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
