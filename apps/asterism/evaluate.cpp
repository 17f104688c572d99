// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/evaluation/pose_errors.hpp"
#include "asterism/io/pose_table.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string poses, truth, covariance, body;
  std::vector<double> at = {0, 0, 0};
  PoseErrorOptions options;
};

nlohmann::ordered_json json_of(const ErrorSummary& errors) {
  return {{"mean", errors.mean},
          {"rms", errors.rms},
          {"median", errors.median},
          {"p95", errors.p95},
          {"max", errors.max}};
}

nlohmann::ordered_json json_of(const PoseErrors& errors) {
  nlohmann::ordered_json json = {{"body", errors.body},
                                 {"truth_frames", errors.truth_frames},
                                 {"found", errors.found()},
                                 {"lost", errors.lost},
                                 {"wrong", errors.wrong},
                                 {"extra", errors.extra},
                                 {"rotation_deg", json_of(errors.rotation_deg)},
                                 {"translation_mm", json_of(errors.translation_mm)}};
  if (errors.within_two_sigma) json["within_two_sigma"] = *errors.within_two_sigma;
  if (const auto& honesty = errors.honesty) {
    json["nees"] = {{"poses", honesty->poses},
                    {"mean_over_six", honesty->mean_nees / 6},
                    {"in_95_percent", honesty->in_95_percent},
                    {"correlations_known", honesty->full}};
  }
  for (const FrameError& frame : errors.frames) {
    nlohmann::ordered_json row = {{"frame", frame.frame},
                                  {"rotation_deg", frame.rotation_deg},
                                  {"translation_mm", frame.translation_mm}};
    if (frame.nees) row["nees"] = *frame.nees;
    json["frames"].push_back(row);
  }
  return json;
}

std::string first_of(const std::vector<int>& frames) {
  constexpr std::size_t kShown = 8;
  const auto last = frames.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, frames.size()));
  if (frames.empty()) return "0";
  return fmt::format("{} [{}{}]", frames.size(), fmt::join(frames.begin(), last, ", "),
                     frames.size() > kShown ? ", …" : "");
}

std::string text_of(const ErrorSummary& errors) {
  return fmt::format("{:10.5f} {:10.5f} {:10.5f} {:10.5f} {:10.5f}", errors.mean, errors.rms, errors.median,
                     errors.p95, errors.max);
}

std::string text_of(const PoseErrors& errors) {
  std::string text =
      fmt::format("{}: {} of {} frames; lost {}, wrong {}, extra {}\n", errors.body, errors.found(),
                  errors.truth_frames, first_of(errors.lost), first_of(errors.wrong), first_of(errors.extra));
  text += fmt::format("  {:<16} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "", "mean", "RMS", "median", "95 %",
                      "max");
  text += fmt::format("  {:<16} {}\n", "rotation deg", text_of(errors.rotation_deg));
  text += fmt::format("  {:<16} {}\n", "translation mm", text_of(errors.translation_mm));
  if (const auto& honesty = errors.honesty) {
    text +=
        fmt::format("  NEES/6 {:.3f} (1 is honest), {:.1f} % inside the stated 95 % ellipsoid, {} poses{}\n",
                    honesty->mean_nees / 6, 100 * honesty->in_95_percent, honesty->poses,
                    honesty->full ? "" : "; from sigmas alone, correlations taken as zero");
  }
  if (errors.within_two_sigma) {
    text +=
        fmt::format("  {:.1f} % of coordinates within two stated sigmas\n", 100 * *errors.within_two_sigma);
  }
  return text;
}

void run(const Call& call, const Common& common) {
  PoseErrorOptions options = call.options;
  options.at_mm = {call.at[0], call.at[1], call.at[2]};
  if (!call.body.empty()) options.body = call.body;
  std::vector<PoseRecord> poses = read_poses(call.poses);
  if (!call.covariance.empty()) read_pose_covariances(call.covariance, poses);
  const std::vector<PoseErrors> errors = pose_errors(poses, read_poses(call.truth), options);
  std::size_t compared = 0;
  std::string text;
  nlohmann::ordered_json json = {{"at_mm", call.at}, {"relative", options.relative}};
  for (const PoseErrors& body : errors) {
    compared += body.frames.size();
    text += text_of(body);
    json["bodies"].push_back(json_of(body));
  }
  if (compared == 0) {
    throw MeasurementError(
        fmt::format("no frame of {} has a pose that {} knows too", call.poses, call.truth));
  }
  print_result(common, json, text);
}

}  // namespace

void add_evaluate(CLI::App& root, Common& common) {
  CLI::App* command = add_command(root, common, "evaluate", "Hold measured poses against true ones",
                                  "asterism evaluate out/poses.csv --truth truth_poses.csv --at 0,0,600");
  auto call = std::make_shared<Call>();
  command->add_option("poses", call->poses, "measured poses CSV")->required();
  command->add_option("--truth", call->truth, "true poses CSV")->required();
  command->add_option("--covariance", call->covariance,
                      "poses.json of the same run: full covariances for NEES");
  command->add_option("--body", call->body, "only this body");
  command
      ->add_option("--at", call->at, "x,y,z of the body's point (mm) at which the translation error is taken")
      ->delimiter(',')
      ->expected(3);
  command->add_flag("--relative", call->options.relative, "compare motions since the first common frame");
  command->add_option("--wrong-mm", call->options.wrong_mm, "a pose farther off is wrong")
      ->capture_default_str();
  command->add_option("--wrong-deg", call->options.wrong_deg, "a pose turned further is wrong")
      ->capture_default_str();
  on_call(*command, common, [=, &common] { run(*call, common); });
}

}  // namespace asterism::app
