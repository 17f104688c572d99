// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/hand_eye_file.hpp"
#include "asterism/workflow/hand_eye_views.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  HandEyeJob job;
  std::string out;
};

void run(const Call& call, const Common& common) {
  const auto views = hand_eye_views(call.job);
  const auto found = hand_eye(views);
  if (!found) throw MeasurementError(text_of(found.error()));
  const auto& [rotation, at] = found->body_from_scanner;
  const Vec6 sigma = found->covariance.diagonal().cwiseSqrt();
  if (!call.out.empty()) write_file(call.out, json_of(*found, views.size()).dump(2) + "\n");
  const std::string text = fmt::format(
      "{} views agree within {:.4f} mm and {:.5f}° RMS, χ² {:.1f} on {:.0f}\n"
      "  in its body at ({:.4f}, {:.4f}, {:.4f}) ± ({:.4f}, {:.4f}, {:.4f}) mm, turned ± ({:.5f}, {:.5f}, "
      "{:.5f})°\n"
      "  for the cell's [scanner]: pose = {{position_mm = [{:.4f}, {:.4f}, {:.4f}], quaternion_wxyz = "
      "[{:.9f}, {:.9f}, "
      "{:.9f}, {:.9f}]}}\n",
      views.size(), found->rms_mm, found->rms_deg, found->chi2, found->degrees, at.x(), at.y(), at.z(),
      sigma[3], sigma[4], sigma[5], deg_from_rad(sigma[0]), deg_from_rad(sigma[1]), deg_from_rad(sigma[2]),
      at.x(), at.y(), at.z(), rotation.w(), rotation.x(), rotation.y(), rotation.z());
  print_result(common, json_of(*found, views.size()), text);
}

}  // namespace

void add_hand_eye(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "hand-eye", "Where the scanner sits in its body, by views of one artefact",
                  "asterism hand-eye seen.csv --poses track/poses.csv --body scanner --out hand_eye.json");
  auto call = std::make_shared<Call>();
  command
      ->add_option(
          "seen", call->job.artefact,
          "poses CSV of the artefact in the scanner's frame, a view a frame: three or more, turned about "
          "two axes")
      ->required();
  command->add_option("--poses", call->job.poses, "poses CSV of the tracker, the same frames")->required();
  command->add_option("--body", call->job.body, "body that carries the scanner")->capture_default_str();
  command->add_option("--reference", call->job.reference,
                      "body that carries the artefact; else it stands still before the tracker");
  command->add_option("--sigma-mm", call->job.stated.mm, "of poses without sigmas, each axis")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--sigma-deg", call->job.stated.deg, "of their attitudes, each axis")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--out", call->out, "JSON file for `asterism fuse --hand-eye`");
  on_call(*command, common, [=, &common] { run(*call, common); });
}

}  // namespace asterism::app
