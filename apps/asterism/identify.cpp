// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/io/body_file.hpp"
#include "asterism/io/label_table.hpp"
#include "asterism/io/point_table.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string bodies, points, out;
};

/// In how many frames a body was found, and in how many it could not be told from another labelling.
struct Count {
  std::size_t ok = 0, ambiguous = 0;
};

void run(const Call& call, IdentificationOptions options, const Common& common) {
  const BodyCatalogue catalogue(read_bodies(call.bodies), options);
  const std::vector<FramePoints> frames = read_points(call.points);
  LabelTable table(call.out, catalogue.bodies());
  const Progress progress = make_progress(common);
  std::vector<Count> counts(catalogue.bodies().size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::vector<BodyLabels> labels = identify(frames[i].points, catalogue, options);
    table.write(frames[i].frame, frames[i].points.size(), labels);
    for (const BodyLabels& found : labels) {
      Count& count = counts[static_cast<std::size_t>(found.body)];
      ++(found.status == LabelStatus::Ok ? count.ok : count.ambiguous);
    }
    progress("identifying", i + 1, frames.size());
  }
  table.finish();
  std::string text = fmt::format("{} frames → {}\n", frames.size(), call.out);
  nlohmann::ordered_json json = {{"frames", frames.size()}, {"out", call.out}};
  for (std::size_t body = 0; body < counts.size(); ++body) {
    const std::string& name = catalogue.bodies()[body].name;
    text +=
        fmt::format("  {}: found in {}, ambiguous in {}\n", name, counts[body].ok, counts[body].ambiguous);
    json["bodies"].push_back(
        {{"name", name}, {"found", counts[body].ok}, {"ambiguous", counts[body].ambiguous}});
  }
  json["options"] = json_of_options(describing(options));
  print_result(common, json, text);
}

}  // namespace

void add_identify(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "identify", "Tell which points are which targets of which bodies",
                  "asterism identify --bodies bodies.toml --points points.csv --out labels.csv");
  auto call = std::make_shared<Call>();
  command->add_option("--bodies", call->bodies, "bodies file")->required();
  command->add_option("--points", call->points, "CSV file of points")->required();
  command->add_option("--out", call->out, "CSV file of the labels")->required();
  const auto options = step_options<IdentificationOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
