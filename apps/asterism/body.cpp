// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/rig_file.hpp"
#include "asterism/workflow/learn_body.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string recording, name = "body", rig, frame_from, out;
};

std::optional<Body> nominal_body(const Call& call) {
  if (call.frame_from.empty()) return std::nullopt;
  const std::vector<Body> bodies = read_bodies(call.frame_from);
  if (bodies.size() == 1) return bodies.front();
  for (const Body& body : bodies) {
    if (body.name == call.name) return body;
  }
  std::vector<std::string> names;
  for (const Body& body : bodies) names.push_back(body.name);
  throw InputError(call.frame_from,
                   fmt::format("it has no body `{}`, but {}", call.name, fmt::join(names, ", ")));
}

nlohmann::ordered_json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json json_of(const LearntBody& learnt, BodyJobOptions options, const std::string& out) {
  nlohmann::ordered_json targets = nlohmann::ordered_json::array();
  for (std::size_t t = 0; t < learnt.targets.size(); ++t) {
    const Target& target = learnt.body.targets[t];
    const LearntTarget& quality = learnt.targets[t];
    nlohmann::ordered_json one = {{"id", target.id},
                                  {"position_mm", json_of(target.position)},
                                  {"sigma_mm", json_of(quality.sigma_mm)},
                                  {"frames", quality.frames},
                                  {"views", quality.views},
                                  {"rms_px", quality.rms_px}};
    if (target.normal) one["normal"] = json_of(*target.normal);
    if (quality.normal_sigma_rad) one["normal_sigma_deg"] = deg_from_rad(*quality.normal_sigma_rad);
    if (target.diameter_mm) one["diameter_mm"] = *target.diameter_mm;
    targets.push_back(std::move(one));
  }
  return {{"body", learnt.body.name},
          {"out", out},
          {"frames", learnt.frames_given},
          {"frames_used", learnt.frames_used},
          {"views_rejected", learnt.views_rejected},
          {"rms_px", learnt.rms_px},
          {"variance_factor", learnt.variance_factor},
          {"distance_sigma_mm", learnt.distance_sigma_mm},
          {"rotation_deg", deg_from_rad(learnt.rotation_rad)},
          {"translation_mm", learnt.translation_mm},
          {"margin_all_seen_mm", learnt.ambiguity.all_seen_mm},
          {"margin_four_seen_mm", learnt.ambiguity.four_seen_mm},
          {"targets", targets},
          {"warnings", learnt.warnings},
          {"options", json_of_options(describing(options))}};
}

std::string margin_text(double margin_mm, const BodyAmbiguity& ambiguity) {
  return fmt::format("{}{:.2f} mm{}", margin_mm < ambiguity.cap_mm ? "" : "> ", margin_mm,
                     ambiguity.complete ? "" : " (not all tried)");
}

std::string text_of(const LearntBody& learnt, const std::string& out) {
  std::string text =
      fmt::format("{:<6}{:>10}{:>10}{:>10}  {:>7}{:>7}{:>7}  {:>6}{:>6}  {:>7}  {:>9}\n", "target", "x mm",
                  "y mm", "z mm", "sigma x", "y", "z mm", "frames", "views", "rms px", "normal by");
  for (std::size_t t = 0; t < learnt.targets.size(); ++t) {
    const Target& target = learnt.body.targets[t];
    const LearntTarget& q = learnt.targets[t];
    text += fmt::format(
        "{:<6}{:>10.3f}{:>10.3f}{:>10.3f}  {:>7.4f}{:>7.4f}{:>7.4f}  {:>6}{:>6}  {:>7.4f}  {:>9}\n",
        target.id, target.position.x(), target.position.y(), target.position.z(), q.sigma_mm.x(),
        q.sigma_mm.y(), q.sigma_mm.z(), q.frames, q.views, q.rms_px,
        q.normal_sigma_rad ? fmt::format("{:.2f} deg", deg_from_rad(*q.normal_sigma_rad)) : "-");
  }
  text += fmt::format(
      "{} of {} frames used, {} views refused; residuals {:.4f} px RMS ({:.2f} of what was stated)\n",
      learnt.frames_used, learnt.frames_given, learnt.views_rejected, learnt.rms_px,
      std::sqrt(learnt.variance_factor));
  text +=
      fmt::format("distances between targets are known to {:.4f} mm (one sigma)\n", learnt.distance_sigma_mm);
  text += fmt::format("the body turned by {:.1f} deg and moved by {:.0f} mm\n",
                      deg_from_rad(learnt.rotation_rad), learnt.translation_mm);
  text += fmt::format("wrong labels fit to {} with all targets seen, to {} with the worst {}\n",
                      margin_text(learnt.ambiguity.all_seen_mm, learnt.ambiguity),
                      margin_text(learnt.ambiguity.four_seen_mm, learnt.ambiguity),
                      std::min<std::size_t>(4, learnt.targets.size()));
  return text + fmt::format("{} targets of `{}` → {}\n", learnt.targets.size(), learnt.body.name, out);
}

void run(const Call& call, const BodyJobOptions& options, const Common& common) {
  if (options.learning.targets < 3)
    throw InputError("`--targets` must tell how many targets the body has, 3 or more");
  Recording recording = open_recording(call.recording);
  if (!call.rig.empty()) recording.rig = read_rig(call.rig);
  const std::optional<Body> nominal = nominal_body(call);
  const LearntBody learnt =
      learn_body_of(recording, call.name, options, nominal ? &*nominal : nullptr, make_progress(common));
  write_bodies(call.out, {learnt.body});
  for (const std::string& warning : learnt.warnings) print_warning(warning);
  print_result(common, json_of(learnt, options, call.out), text_of(learnt, call.out));
}

}  // namespace

void add_body(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "body", "Learn a body's target coordinates from a recording of it in motion",
                  "asterism body RECORDING --name platform --targets 6 --out bodies.toml");
  auto call = std::make_shared<Call>();
  command->add_option("recording", call->recording, "folder with frames.csv (or centres.csv) and rig.yaml")
      ->required();
  command->add_option("--name", call->name, "what the body is called")->capture_default_str();
  command->add_option("--rig", call->rig, "rig file, in place of the recording's");
  command->add_option("--frame-from", call->frame_from,
                      "bodies file with nominal coordinates: their frame and ids are taken over");
  command->add_option("--out", call->out, "bodies file to write")->required();
  const auto options = step_options<BodyJobOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
