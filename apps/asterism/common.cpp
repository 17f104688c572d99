// SPDX-License-Identifier: Apache-2.0
#include "common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cell_file.hpp"

namespace asterism::app {
namespace {

std::string option_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  std::replace(name.begin(), name.end(), '.', '-');
  return "--" + name;
}

/// Empty when another option ends in the same word, or nothing stands before it.
std::string short_name(const std::string& name, const std::vector<OptionHelp>& all) {
  const auto last = [](const std::string& whole) { return whole.substr(whole.rfind('.') + 1); };
  const auto same = [&](const OptionHelp& other) { return last(other.name) == last(name); };
  if (last(name) == name || std::count_if(all.begin(), all.end(), same) > 1) return "";
  return option_name(last(name));
}

}  // namespace

CLI::App* add_command(CLI::App& root, Common& common, const std::string& name, const std::string& what,
                      const std::string& example) {
  CLI::App* command = root.add_subcommand(name, what);
  command->footer("Example:\n  " + example);
  command->add_flag("--json", common.json, "print the result as JSON")->group("Common");
  command->add_option("--progress", common.progress, "auto, plain or none")
      ->check(CLI::IsMember({"auto", "plain", "none"}))
      ->capture_default_str()
      ->group("Common");
  command
      ->add_option("--threads", common.threads, "threads to use; 0 = all. The result does not depend on it")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str()
      ->group("Common");
  command->add_option("--seed", common.seed, "of every random number")
      ->capture_default_str()
      ->group("Common");
  return command;
}

void on_call(CLI::App& command, Common& common, std::function<void()> work) {
  command.callback([&common, work = std::move(work)] {
    common.run = [&common, work] {
      set_thread_count(common.threads);
      work();
    };
  });
}

void print_result(const Common& common, const nlohmann::ordered_json& json, const std::string& text) {
  const std::string out = common.json ? json.dump(2) + "\n" : text;
  std::fwrite(out.data(), 1, out.size(), stdout);
  if (std::fflush(stdout) != 0) throw InputError("standard output", "cannot be written");
}

void print_warning(const std::string& message) { fmt::print(stderr, "warning: {}\n", message); }

Cell cell_for(const std::string& name_or_file) {
  Cell cell = cell_of(name_or_file);
  for (const std::string& remark : remarks_on(cell)) print_warning(remark);
  return cell;
}

StepOptions::StepOptions(CLI::App& command, const OptionsDescription& defaults) {
  command.add_option("--config", given_->config, "TOML file of the options below")
      ->group("Options of the steps");
  const std::vector<OptionHelp> options = list_options(defaults);
  for (const OptionHelp& option : options) {
    std::string names = option_name(option.name);
    if (const std::string brief = short_name(option.name, options); !brief.empty()) names += "," + brief;
    const auto keep = [given = given_, name = option.name](const std::string& text) {
      given->texts[name] = text;
    };
    // `--flag` alone means true; `--flag=false` is possible too.
    CLI::Option* added =
        option.kind == "flag"
            ? command.add_flag_function(
                  names, [keep](std::int64_t count) { keep(count > 0 ? "true" : "false"); }, option.help)
            : command.add_option_function<std::string>(names, keep, option.help);
    added->group("Options of the steps");
    if (option.kind != "flag") added->type_name(option.kind)->default_str(option.current);
  }
}

void StepOptions::apply(const OptionsDescription& describe) const {
  if (!given_->config.empty()) read_options(given_->config, describe);
  try {
    set_options(given_->texts, describe);
  } catch (const InputError& error) {
    throw InputError("command line", error.what());
  }
}

}  // namespace asterism::app
