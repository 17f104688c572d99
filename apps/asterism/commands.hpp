// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace CLI {
class App;
}

namespace asterism::app {

struct Common;

// Each adds its subcommand to `root`; `common.run` becomes the work of the one that was called.
// One file each; main.cpp lists them in the order of `asterism --help`. A command's file reads
//   void add_detect(CLI::App& root, Common& common) {
//     CLI::App* command = add_command(root, common, "detect", "what it does", "asterism detect …");
//     auto call = std::make_shared<Call>();  // its own options, a struct
//     command->add_option("--out", call->out, "…")->required();
//     const auto options = step_options<DetectionOptions>(*command);
//     on_call(*command, common, [=, &common] { run(*call, options(), common); });
//   }
void add_demo(CLI::App& root, Common& common);
void add_calibrate(CLI::App& root, Common& common);
void add_check_rig(CLI::App& root, Common& common);
void add_detect(CLI::App& root, Common& common);
void add_triangulate(CLI::App& root, Common& common);
void add_identify(CLI::App& root, Common& common);
void add_track(CLI::App& root, Common& common);
void add_evaluate(CLI::App& root, Common& common);
void add_simulate(CLI::App& root, Common& common);
void add_body(CLI::App& root, Common& common);
void add_reproduce(CLI::App& root, Common& common);
void add_layout(CLI::App& root, Common& common);
void add_align(CLI::App& root, Common& common);
void add_hand_eye(CLI::App& root, Common& common);
void add_fuse(CLI::App& root, Common& common);
void add_schema(CLI::App& root, Common& common);
void add_compare(CLI::App& root, Common& common);
void add_verify(CLI::App& root, Common& common);
void add_plan(CLI::App& root, Common& common);
void add_suggest_layout(CLI::App& layout, Common& common);  // under `layout`

}  // namespace asterism::app
