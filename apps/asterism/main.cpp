// SPDX-License-Identifier: Apache-2.0
// asterism: two cameras, round targets, poses with their uncertainty. See `asterism --help`.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "asterism/core/options.hpp"
#include "asterism/core/result.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "signals.hpp"

namespace asterism::app {
namespace {

// Exit statuses; docs/formats.md promises them.
constexpr int kDone = 0;
constexpr int kBug = 1;
constexpr int kWrongInput = 2;
constexpr int kNotMeasured = 3;
constexpr int kStopped = 130;  // as shells tell of Ctrl-C

using AddCommand = void (*)(CLI::App&, Common&);

/// In the order of `asterism --help`.
const std::vector<AddCommand> kCommands = {
    add_demo,  add_calibrate, add_check_rig, add_body,      add_detect, add_triangulate, add_identify,
    add_track, add_evaluate,  add_layout,    add_simulate,  add_verify, add_align,       add_hand_eye,
    add_plan,  add_fuse,      add_compare,   add_reproduce, add_schema};

/// The called command, or the called one of its own commands, and its whole name ("layout evaluate");
/// nothing where none was called.
struct Called {
  const CLI::App* command = nullptr;
  std::string name;
};

Called called_command(const CLI::App& root) {
  Called called;
  for (const CLI::App* in = &root; in != nullptr;) {
    const std::vector<const CLI::App*> parsed =
        in->get_subcommands([](const CLI::App* app) { return app->parsed() > 0; });
    in = parsed.empty() ? nullptr : parsed.front();
    if (in == nullptr) break;
    called.command = in;
    called.name += (called.name.empty() ? "" : " ") + in->get_name();
  }
  return called;
}

std::vector<std::string> long_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::string did_you_mean(const std::string& wrong, const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(wrong, known);
  return nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest);
}

/// One line: where, what, what would be right. An option that is not known is told first, for a
/// mistyped option that is required would otherwise be told as missing.
std::string explain(const CLI::App& root, const CLI::ParseError& error) {
  const auto [called, name_of_called] = called_command(root);
  const CLI::App* command = called != nullptr ? called : &root;
  const std::string where = called != nullptr ? "asterism " + name_of_called : "asterism";
  std::vector<std::string> names;
  for (const CLI::App* app : command->get_subcommands({})) names.push_back(app->get_name());
  if (!names.empty()) {
    const std::vector<std::string> rest = command->remaining();
    if (rest.empty())
      return fmt::format("{}: a command is needed, one of: {}", where, fmt::join(names, ", "));
    return fmt::format("{}: `{}` is no command{} `{} --help` lists them", where, rest.front(),
                       did_you_mean(rest.front(), names).append("."), where);
  }
  for (const std::string& word : command->remaining()) {
    if (!word.starts_with("-") || word == "--") continue;
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("{}: `{}` is no option of it{}", where, name,
                       did_you_mean(name, long_names(*command)));
  }
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');
  return fmt::format("{}: {} (see `{} --help`)", where, what, where);
}

int fail(int status, const std::string& line) {
  fmt::print(stderr, "{}\n", line);
  return status;
}

int run(const std::string& name, const std::function<void()>& work) {
  try {
    work();
    return kDone;
  } catch (const InputError& error) {
    return fail(kWrongInput, fmt::format("asterism {}: {}", name, error.what()));
  } catch (const MeasurementError& error) {
    return fail(kNotMeasured, fmt::format("asterism {}: no result: {}", name, error.what()));
  } catch (const Interrupted&) {
    return fail(kStopped, fmt::format("asterism {}: stopped; files already finished are kept", name));
  } catch (const std::exception& error) {
    return fail(kBug, fmt::format("asterism {}: this is a bug, please report it: {}", name, error.what()));
  }
}

int main_of(int argc, char** argv) {
  CLI::App root{"Optical tracking for large-part metrology: from two images to a pose you can trust.",
                "asterism"};
  root.set_version_flag("--version", "asterism " ASTERISM_VERSION);
  root.require_subcommand(1);
  root.footer(
      "`asterism COMMAND --help` shows a command's options and an example.\n"
      "Exit status: 0 done, 2 wrong usage or input, 3 the measurement could not be made, 1 a bug.");
  Common common;
  for (const AddCommand add : kCommands) add(root, common);
  try {
    root.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return root.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return fail(kWrongInput, explain(root, error));
  }
  stop_on_interrupt();
  return run(called_command(root).name, common.run);
}

}  // namespace
}  // namespace asterism::app

int main(int argc, char** argv) {
  try {
    return asterism::app::main_of(argc, argv);
  } catch (const std::exception& error) {
    return asterism::app::fail(asterism::app::kBug,
                               fmt::format("asterism: this is a bug, please report it: {}", error.what()));
  }
}
