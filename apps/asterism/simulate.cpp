// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/plan_file.hpp"
#include "asterism/workflow/scan_run.hpp"
#include "asterism/workflow/simulate_recording.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string cell, plan, out, format = "png";
  int frames = 0;  // 0 = as many as the cell says
};

/// Options of both steps side by side; those of the run count with --plan only.
struct Options {
  SimulationOptions simulation;
  ScanRunOptions run;
};
void describe(Options& options, OptionVisitor& visit) {
  describe(options.simulation, visit);
  describe(options.run, visit);
}

void run(const Call& call, Options options, const Common& common) {
  Cell cell = cell_for(call.cell);
  if (!call.plan.empty()) cell = scan_run(std::move(cell), read_plan(call.plan), options.run);
  if (call.frames != 0) cell.timing.frames = call.frames;
  options.simulation.seed = common.seed;
  const PictureFormat format = call.format == "pgm" ? PictureFormat::Pgm : PictureFormat::Png;
  const SimulatedRecording made =
      simulate_recording(cell, {call.out, options.simulation, format}, make_progress(common));
  print_result(
      common,
      {{"cell", cell.name},
       {"frames", made.frames},
       {"lost_images", made.lost},
       {"targets_seen", made.targets_seen},
       {"targets_hidden", made.targets_hidden},
       {"targets_fallen", made.fallen},
       {"targets_knocked", made.knocked},
       {"scans", made.scans},
       {"scan_points", made.scan_points},
       {"seed", common.seed},
       {"out", call.out},
       {"options", json_of_options(describing(options))}},
      fmt::format("{} frames{} of {} → {}\n", made.frames,
                  made.scans == 0 ? "" : fmt::format(" and {} scans", made.scans), cell.name, call.out));
}

}  // namespace

void add_simulate(CLI::App& root, Common& common) {
  CLI::App* command = add_command(
      root, common, "simulate", "A cell in motion to images or centres and scans, with their truth",
      "asterism simulate engine_casing --out recording --level centres --sigma-px 0.02");
  auto call = std::make_shared<Call>();
  command
      ->add_option("cell", call->cell,
                   fmt::format("cell file, or a built-in cell: {}", fmt::join(builtin_cells(), ", ")))
      ->required();
  command->add_option("--out", call->out, "folder of the recording")->required();
  command->add_option("--plan", call->plan, "a plan of views (plan.json), which the cell is to carry out");
  command
      ->add_option("--format", call->format, "of the images: png, or pgm, which is larger and written faster")
      ->check(CLI::IsMember({"png", "pgm"}))
      ->capture_default_str();
  command->add_option("--frames", call->frames, "how many frames; else as many as the cell says")
      ->check(CLI::Range(1, 1000000));
  const auto options = step_options<Options>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
