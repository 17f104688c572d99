// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

#include "asterism/core/progress.hpp"
#include "asterism/io/options_file.hpp"

// What the subcommands share: the options every one of them has, progress, results, step options.

namespace asterism {
class Optimizer;
struct Cell;
}  // namespace asterism

namespace asterism::app {

struct Common {
  bool json = false;              // result as JSON on standard output
  std::string progress = "auto";  // auto, plain or none
  int threads = 0;                // 0 = as many as the machine has
  std::uint64_t seed = 1;
  std::function<void()> run;  // the work of the subcommand that was called
};

/// Makes a subcommand with the common options. `example` is shown under its --help.
CLI::App* add_command(CLI::App& root, Common& common, const std::string& name, const std::string& what,
                      const std::string& example);

/// Runs `work` when `command` was called.
void on_call(CLI::App& command, Common& common, std::function<void()> work);

/// Draws on standard error: a bar with rate and time left on a terminal, else a line now and then.
/// Throws Interrupted after Ctrl-C, so that a long job unwinds and leaves whole files.
[[nodiscard]] Progress make_progress(const Common& common);

/// The same for a search, a generation at a time: hypervolume, feasible share, time left. Does not throw.
[[nodiscard]] std::function<void(const Optimizer&)> make_search_progress(const Common& common);

class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("stopped") {}
};

/// The result on standard output: `json` with --json, else `text`.
void print_result(const Common& common, const nlohmann::ordered_json& json, const std::string& text);

/// A line on standard error.
void print_warning(const std::string& message);

/// A cell by its file or its built-in name; what is odd about it goes to standard error.
[[nodiscard]] Cell cell_for(const std::string& name_or_file);

/// The options of a step as long options of a command (`min_diameter_px` → `--min-diameter-px`), with
/// `--config FILE.toml` under them: defaults, then the file, then the command line.
/// Of a name with dots (`detection.min_diameter_px`) the last part will do where it is the only one.
class StepOptions {
 public:
  StepOptions(CLI::App& command, const OptionsDescription& defaults);
  /// Sets the options that were given. Throws InputError for what they cannot be.
  void apply(const OptionsDescription& describe) const;

 private:
  struct Given {
    std::string config;
    std::map<std::string, std::string> texts;
  };
  std::shared_ptr<Given> given_ = std::make_shared<Given>();  // CLI11 keeps a reference to it
};

/// The same for one struct: `const auto options = step_options<DetectionOptions>(*command);` and, in the
/// work, `options()` gives the effective options.
template <class Options>
[[nodiscard]] std::function<Options()> step_options(CLI::App& command) {
  Options defaults;
  const StepOptions given(command, describing(defaults));
  return [given] {
    Options options;
    given.apply(describing(options));
    return options;
  };
}

}  // namespace asterism::app
