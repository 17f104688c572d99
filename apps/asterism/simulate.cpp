// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/workflow/simulate_recording.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string cell, out, format = "png";
  int frames = 0;  // 0 = as many as the cell says
};

void run(const Call& call, SimulationOptions options, const Common& common) {
  Cell cell = cell_for(call.cell);
  if (call.frames != 0) cell.timing.frames = call.frames;
  options.seed = common.seed;
  const PictureFormat format = call.format == "pgm" ? PictureFormat::Pgm : PictureFormat::Png;
  const SimulatedRecording made =
      simulate_recording(cell, {call.out, options, format}, make_progress(common));
  print_result(common,
               {{"cell", cell.name},
                {"frames", made.frames},
                {"lost_images", made.lost},
                {"targets_seen", made.targets_seen},
                {"targets_hidden", made.targets_hidden},
                {"targets_fallen", made.fallen},
                {"targets_knocked", made.knocked},
                {"seed", options.seed},
                {"out", call.out},
                {"options", json_of_options(describing(options))}},
               fmt::format("{} frames of {} → {}\n", made.frames, cell.name, call.out));
}

}  // namespace

void add_simulate(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "simulate", "A cell in motion to images or centres, with their truth",
                  "asterism simulate engine_casing --out recording --level centres --sigma-px 0.02");
  auto call = std::make_shared<Call>();
  command
      ->add_option("cell", call->cell,
                   fmt::format("cell file, or a built-in cell: {}", fmt::join(builtin_cells(), ", ")))
      ->required();
  command->add_option("--out", call->out, "folder of the recording")->required();
  command
      ->add_option("--format", call->format, "of the images: png, or pgm, which is larger and written faster")
      ->check(CLI::IsMember({"png", "pgm"}))
      ->capture_default_str();
  command->add_option("--frames", call->frames, "how many frames; else as many as the cell says")
      ->check(CLI::Range(1, 1000000));
  const auto options = step_options<SimulationOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
