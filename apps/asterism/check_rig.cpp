// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <nlohmann/json.hpp>

#include "asterism/calibration/rig_check.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/io/rig_file.hpp"
#include "asterism/tracking/tracker.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

using Json = nlohmann::ordered_json;

struct Call {
  std::string recording, rig;
  std::vector<std::string> lengths;
};

struct KnownLength {
  std::string name, a, b;
  double mm = 0;
};

KnownLength read_length(const std::string& text) {
  const std::size_t comma = text.find(','), equals = text.rfind('=');
  KnownLength length;
  const bool shaped =
      comma != std::string::npos && equals != std::string::npos && 0 < comma && comma + 1 < equals;
  if (shaped) {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + equals + 1, end, length.mm);
    if (read.ec == std::errc() && read.ptr == end && length.mm > 0) {
      length.name = text.substr(0, equals);
      length.a = text.substr(0, comma);
      length.b = text.substr(comma + 1, equals - comma - 1);
      return length;
    }
  }
  throw InputError(
      fmt::format("--length {}: expected two target ids and their distance, e.g. a,b=1389.688", text));
}

/// The targets by id, and by body.id where an id alone may stand in two bodies.
std::map<std::string, std::pair<int, int>> places_of_targets(const std::vector<Body>& bodies) {
  std::map<std::string, std::pair<int, int>> places;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    for (std::size_t target = 0; target < bodies[body].targets.size(); ++target) {
      const std::pair<int, int> place(static_cast<int>(body), static_cast<int>(target));
      const std::string& id = bodies[body].targets[target].id;
      places.emplace(id, place);
      places.emplace(bodies[body].name + "." + id, place);
    }
  }
  return places;
}

struct Seen {
  std::vector<LengthObservation> lengths;
  std::vector<EpipolarObservation> epipolar;
};

void collect(Seen& seen, const TrackedFrame& frame, const std::vector<KnownLength>& lengths,
             const std::map<std::string, std::pair<int, int>>& places) {
  std::map<std::pair<int, int>, const Point*> points;
  for (const BodyLabels& labels : frame.labels) {
    if (labels.status != LabelStatus::Ok) continue;
    for (const LabelledPoint& labelled : labels.points) {
      const Point& point = frame.points[static_cast<std::size_t>(labelled.point)];
      points[{labels.body, labelled.target}] = &point;
      if (point.left < 0) continue;
      seen.epipolar.push_back({frame.centres.time_s,
                               frame.centres.left[static_cast<std::size_t>(point.left)].px(),
                               point.epipolar_error_px});
    }
  }
  for (const KnownLength& length : lengths) {
    const auto a = points.find(places.at(length.a)), b = points.find(places.at(length.b));
    if (a == points.end() || b == points.end()) continue;
    seen.lengths.push_back({length.name, frame.centres.time_s, length.mm, a->second->in_tracker,
                            b->second->in_tracker, a->second->covariance, b->second->covariance});
  }
}

Seen observe(const Recording& recording, const StereoRig& rig, const std::vector<KnownLength>& lengths,
             const Common& common) {
  const auto places = places_of_targets(*recording.bodies);
  std::vector<std::string> ids;
  for (const auto& [id, place] : places) ids.push_back(id);
  for (const KnownLength& length : lengths) {
    for (const std::string& id : {length.a, length.b}) {
      if (!places.contains(id))
        throw InputError("--length " + unknown_name_message(id, "the recording's targets", ids));
    }
  }
  Tracker tracker(rig, *recording.bodies, {});
  const Progress progress = make_progress(common);
  Seen seen;
  const std::size_t frames = recording.centres ? recording.centres->size() : recording.frames.size();
  for (std::size_t i = 0; i < frames; ++i) {
    const TrackedFrame frame = recording.centres ? tracker.process((*recording.centres)[i])
                                                 : tracker.process(read_frame(recording, i));
    collect(seen, frame, lengths, places);
    progress("tracking", i + 1, frames);
  }
  return seen;
}

const char* words_of(RigVerdict verdict) {
  switch (verdict) {
    case RigVerdict::Good:
      return "this rig is still good";
    case RigVerdict::Doubtful:
      return "this rig is doubtful";
    case RigVerdict::Bad:
      return "this rig is no longer good: calibrate again";
  }
  return "";
}

Json json_of(const RigCheck& check) {
  Json json = {{"verdict", words_of(check.verdict)},
               {"good", check.verdict == RigVerdict::Good},
               {"reasons", check.reasons},
               {"scale_ppm", check.scale_ppm},
               {"scale_sigma_ppm", check.scale_sigma_ppm},
               {"depth_ppm_per_m", check.depth_ppm_per_m},
               {"bias_mm", check.bias_mm},
               {"length_rms_mm", check.length_rms_mm},
               {"epipolar_mean_px", check.epipolar_mean_px},
               {"epipolar_rms_px", check.epipolar_rms_px},
               {"drift_px", check.drift_px},
               {"drift_sigma_px", check.drift_sigma_px}};
  for (const LengthSummary& length : check.lengths) {
    json["lengths"].push_back({{"name", length.name},
                               {"count", length.count},
                               {"known_mm", length.known_mm},
                               {"bias_mm", length.bias_mm},
                               {"rms_mm", length.rms_mm},
                               {"worst_mm", length.worst_mm},
                               {"rms_of_sigma", length.rms_of_sigma}});
  }
  json["regions"] = Json::array();
  for (const RegionSummary& region : check.regions) {
    json["regions"].push_back({{"column", region.column},
                               {"row", region.row},
                               {"count", region.count},
                               {"mean_px", region.mean_px},
                               {"sigma_px", region.sigma_px}});
  }
  return json;
}

std::string text_of(const RigCheck& check) {
  std::string text = "length                 seen   known mm    bias mm     RMS mm   worst mm\n";
  for (const LengthSummary& length : check.lengths) {
    text += fmt::format("{:20}  {:5}  {:9.3f}  {:+9.4f}  {:9.4f}  {:9.4f}\n", length.name, length.count,
                        length.known_mm, length.bias_mm, length.rms_mm, length.worst_mm);
  }
  text += fmt::format(
      "scale {:+.1f} ± {:.1f} ppm, {:+.1f} ± {:.1f} ppm a metre of distance; bias {:+.4f} mm, RMS {:.4f} "
      "mm\n",
      check.scale_ppm, check.scale_sigma_ppm, check.depth_ppm_per_m, check.depth_sigma_ppm_per_m,
      check.bias_mm, check.length_rms_mm);
  text += fmt::format(
      "epipolar error: mean {:+.4f} px, RMS {:.4f} px, drift over the recording {:+.4f} ± {:.4f} px\n",
      check.epipolar_mean_px, check.epipolar_rms_px, check.drift_px, check.drift_sigma_px);
  text += words_of(check.verdict);
  for (const std::string& reason : check.reasons) text += "\n  " + reason;
  return text + "\n";
}

void run(const Call& call, const RigCheckOptions& options, const Common& common) {
  std::vector<KnownLength> lengths;
  for (const std::string& text : call.lengths) lengths.push_back(read_length(text));
  const Recording recording = open_recording(call.recording);
  if (call.rig.empty() && !recording.rig) {
    throw InputError(call.recording, "no rig.yaml in the recording; name the rig with --rig");
  }
  if (!recording.bodies) {
    throw InputError(call.recording,
                     "no bodies.toml in the recording: it names the targets whose distance is known");
  }
  const StereoRig rig = call.rig.empty() ? *recording.rig : read_rig(call.rig);
  const Seen seen = observe(recording, rig, lengths, common);
  const RigCheck check =
      check_rig(seen.lengths, seen.epipolar, rig.left.width_px, rig.left.height_px, options);
  print_result(common, json_of(check), text_of(check));
}

}  // namespace

void add_check_rig(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "check-rig", "Is this rig still good? By known lengths in a recording",
                  "asterism check-rig recording/ --length P1,P2=1389.688");
  auto call = std::make_shared<Call>();
  command->add_option("recording", call->recording, "folder with frames.csv, bodies.toml, rig.yaml")
      ->required();
  command->add_option("--length", call->lengths, "A,B=MM: two target ids (or body.id) and their distance")
      ->required();
  command->add_option("--rig", call->rig, "the rig to check, in place of the recording's");
  const auto options = step_options<RigCheckOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
