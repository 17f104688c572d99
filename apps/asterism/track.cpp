// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "asterism/core/result.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/rig_file.hpp"
#include "asterism/workflow/fuse_recording.hpp"
#include "asterism/workflow/track_recording.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string recording, rig, bodies, out;
  std::vector<std::string> left, right;
  double rate_hz = 10;
  bool covariance = false, tum = false;
  std::string read_out, read_out_body;
  std::optional<double> read_out_latency_s;
  double read_out_correlation_s = 0;
};

std::vector<std::filesystem::path> images_of(const std::vector<std::string>& named) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : named) {
    const auto listed = list_images(name);
    files.insert(files.end(), listed.begin(), listed.end());
  }
  return files;
}

/// What OpenCV's pair of files does not tell, the first image does.
ImageSize size_of_first_image(const Recording& recording) {
  for (const FrameEntry& entry : recording.frames) {
    if (entry.left.empty()) continue;
    try {
      const Image image = read_image(recording.folder / entry.left);
      return {width_of(image), height_of(image)};
    } catch (const InputError&) {
      continue;  // told when its turn comes
    }
  }
  return {};
}

Recording recording_of(const Call& call) {
  const bool loose = !call.left.empty() || !call.right.empty();
  if (loose == !call.recording.empty()) {
    throw InputError("name a recording's folder, or images with --left and --right, one of the two");
  }
  Recording recording = loose ? recording_of_images(images_of(call.left), images_of(call.right), call.rate_hz)
                              : open_recording(call.recording);
  if (!call.rig.empty()) recording.rig = read_rig(call.rig, size_of_first_image(recording));
  if (!call.bodies.empty()) recording.bodies = read_bodies(call.bodies);
  return recording;
}

std::string text_of(const nlohmann::ordered_json& summary, const std::string& out) {
  std::string text;
  for (const auto& body : summary["bodies"]) {
    text += fmt::format("{}:", body["name"].get<std::string>());
    for (const auto& [status, count] : body["status"].items()) {
      if (count.get<int>() > 0) text += fmt::format(" {} {}", status, count.get<int>());
    }
    if (body.contains("rms_px")) {
      const auto mm = body["sigma_mm"].get<std::vector<double>>();
      const auto deg = body["sigma_deg"].get<std::vector<double>>();
      text += fmt::format("   residuals {:.4f} px   stated sigma {:.4f} mm at the origin, {:.5f} deg",
                          body["rms_px"].get<double>(), std::hypot(mm[0], mm[1], mm[2]),
                          std::hypot(deg[0], deg[1], deg[2]));
    }
    text += "\n";
  }
  const double seconds = summary["seconds"]["total"];
  const auto frames = summary["frames"].get<double>();
  return text + fmt::format("{} frames in {:.2f} s ({:.1f} a second) → {}\n", frames, seconds,
                            frames / seconds, out);
}

std::optional<FuseJob> fuse_job_of(const Call& call, const Recording& recording) {
  if (call.read_out.empty() || !recording.bodies) return std::nullopt;
  return fuse_job_of(
      {call.read_out, call.read_out_body, call.read_out_latency_s, call.read_out_correlation_s},
      *recording.bodies);
}

/// The platform's own read-out beside the tracker, where it is given.
std::string fuse(const std::optional<FuseJob>& job, const TrackedRun& tracked, const TrackJob& track,
                 nlohmann::ordered_json& summary) {
  if (!job) return "";
  const FusedRecording fusion = fuse_recording(tracked, *job, track.options.filter, track.out);
  summary["fusion"] = summary_of(fusion);
  std::string text = fmt::format("{} with its platform's read-out:", fusion.body);
  for (const auto& [status, count] : summary["fusion"]["status"].items()) {
    if (count.get<int>() > 0) text += fmt::format(" {} {}", status, count.get<int>());
  }
  if (fusion.offset) {
    text += fmt::format("   late by {:.2f} ± {:.2f} ms, {} of {} readings refused", 1e3 * fusion.latency_s,
                        1e3 * fusion.latency_sigma_s, fusion.offset->refused,
                        fusion.offset->readings + fusion.offset->refused);
  }
  return text + "\n";
}

void run(const Call& call, const TrackerOptions& options, const Common& common) {
  const Recording recording = recording_of(call);
  const std::optional<FuseJob> fusing = fuse_job_of(call, recording);
  const TrackJob job{call.out, options, call.covariance, call.tum};
  const TrackedRun tracked = track_recording(recording, job, make_progress(common));
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < std::min(kShown, tracked.warnings.size()); ++i)
    print_warning(tracked.warnings[i]);
  if (tracked.warnings.size() > kShown) {
    print_warning(fmt::format("… and {} more, in summary.json", tracked.warnings.size() - kShown));
  }
  nlohmann::ordered_json summary = summary_of(tracked, options);
  const std::string fusion = fuse(fusing, tracked, job, summary);
  print_result(common, summary, fusion + text_of(summary, call.out));
  for (const auto& body : summary["bodies"]) {
    if (body.contains("rms_px")) return;
  }
  throw MeasurementError("no body got a pose in any frame; summary.json counts the reasons");
}

}  // namespace

void add_track(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "track", "From images to the pose of every body, frame by frame",
                  "asterism track RECORDING --out results\n"
                  "  asterism track --rig rig.yaml --bodies bodies.toml --left 'left/*.png' "
                  "--right 'right/*.png' --out results");
  auto call = std::make_shared<Call>();
  command->add_option("recording", call->recording, "folder with frames.csv, rig.yaml and bodies.toml");
  command->add_option("--out", call->out, "folder for the results")->required();
  command->add_option("--rig", call->rig, "calibrated cameras, in place of the recording's");
  command->add_option("--bodies", call->bodies, "bodies, in place of the recording's");
  command->add_option("--left", call->left, "loose images of the left camera: folder or pattern");
  command->add_option("--right", call->right, "loose images of the right camera");
  command->add_option("--rate-hz", call->rate_hz, "frame rate of loose images")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--covariance", call->covariance, "write poses.json with full 6×6 covariances");
  command->add_flag("--tum", call->tum, "write a TUM trajectory a body (seconds, metres)");
  command->add_option("--read-out", call->read_out,
                      "what a platform said of its own pose (CSV): poses_fused.csv too, filtered with it");
  command->add_option("--read-out-body", call->read_out_body, "the body it turns; else the first");
  command->add_option("--read-out-latency", call->read_out_latency_s,
                      "seconds by which its readings are late, where known; else told from the run");
  command
      ->add_option("--read-out-correlation", call->read_out_correlation_s,
                   "seconds for which its noise keeps its value; 0: each reading anew")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  const auto options = step_options<TrackerOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
