// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/layout_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace asterism {
namespace {

std::string ids_of(const std::vector<Target>& targets, std::span<const int> which) {
  std::vector<std::string> ids;
  for (const int i : which) ids.push_back(targets[static_cast<std::size_t>(i)].id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

std::string when(std::size_t pose, std::span<const double> pose_times_s) {
  return pose < pose_times_s.size() ? fmt::format("at {:.2f} s", pose_times_s[pose])
                                    : fmt::format("in pose {}", pose);
}

std::string at_point(std::size_t point, const LayoutTask& task) {
  return point < task.points.size() ? task.points[point].name : "the targets' centroid";
}

/// "Worst error 0.043 mm, at 2.10 s at flange, when P2 is lost."
std::string worst_error(const LayoutDesign& design, std::size_t losses, const LayoutTask& task,
                        std::span<const double> pose_times_s) {
  const ErrorOverMotion& error = design.accuracy.after[losses];
  constexpr const char* kOf[] = {"Worst error", "Worst error after any one loss",
                                 "Worst error after any two losses"};
  const std::string of =
      losses < std::size(kOf) ? kOf[losses] : fmt::format("Worst error after any {} losses", losses);
  std::string text;
  if (error.worst) {
    text = fmt::format("{} {} mm, {} at {}", of, text_of_value(error.worst->mm),
                       when(error.worst->pose, pose_times_s), at_point(error.worst->point, task));
    const std::vector<int> lost(error.worst->lost.begin(), error.worst->lost.end());
    if (!lost.empty()) text += fmt::format(", when {} is missing", ids_of(design.targets, lost));
    text += ".";
  }
  if (error.undetermined == 0) return text;
  if (!text.empty()) text += " ";
  return text + fmt::format("{}: not determined in {} of {} poses.", of, error.undetermined,
                            design.visibility.poses());
}

std::string fewest_seen(const LayoutDesign& design, std::span<const double> pose_times_s) {
  std::size_t worst = 0;
  const auto count = [&](std::size_t pose) { return std::popcount(design.visibility.both(pose)); };
  for (std::size_t pose = 1; pose < design.visibility.poses(); ++pose) {
    if (count(pose) < count(worst)) worst = pose;
  }
  return fmt::format("Both cameras see at least {} of its {} targets; fewest {}.", count(worst),
                     design.targets.size(), when(worst, pose_times_s));
}

std::string taken_for(const LayoutDesign& design) {
  const IdentifiabilityMargin& margin = design.identifiability;
  if (margin.seen.empty())
    return fmt::format("No wrong labelling fits within {} mm.", text_of_value(margin.rms_mm));
  return fmt::format("{} fit as {} within {} mm RMS.", ids_of(design.targets, margin.seen),
                     ids_of(design.targets, margin.taken_for), text_of_value(margin.rms_mm));
}

}  // namespace

std::string label_of_quantity(const std::string& name) {
  std::string label = name;
  for (const auto& [suffix, words] :
       {std::pair{"-1-lost", " after any one loss"}, std::pair{"-2-lost", " after any two losses"}}) {
    if (label.ends_with(suffix)) label.replace(label.rfind(suffix), std::string::npos, words);
  }
  std::replace(label.begin(), label.end(), '-', ' ');
  return label;
}

std::string text_of_value(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return "–";
  if (std::abs(*value) < 1e-6) return "0";  // below a nanometre nothing is meant
  if (std::abs(*value) < 1e6 && *value == std::round(*value)) return fmt::format("{:.0f}", *value);
  const double magnitude = std::floor(std::log10(std::abs(*value)) + 2e-4);  // 0.9996 is 1.00
  return fmt::format("{:.{}f}", *value, static_cast<int>(std::clamp(2 - magnitude, 0.0, 9.0)));
}

std::vector<std::string> broken_constraints(const LayoutDesign& design) {
  return broken_constraints(design.constraints);
}

std::vector<std::string> broken_constraints(std::span<const ConstraintState> constraints) {
  std::vector<std::string> broken;
  for (const ConstraintState& state : constraints) {
    if (!(state.violation > 0)) continue;
    const std::string unit = state.unit.empty() || state.unit == "targets" ? "" : " " + state.unit;
    const std::string is =
        state.value ? fmt::format("is {}{}", text_of_value(state.value), unit) : "cannot be told";
    const std::string by = std::isfinite(state.violation) && state.value
                               ? fmt::format(": {}{} {}", text_of_value(state.violation), unit,
                                             state.at_least ? "missing" : "too much")
                               : "";
    broken.push_back(fmt::format("{} {}, at {} {}{} asked{}", label_of_quantity(state.name), is,
                                 state.at_least ? "least" : "most", text_of_value(state.bound), unit, by));
  }
  return broken;
}

std::vector<std::string> notes_on(const LayoutDesign& design, const LayoutTask& task,
                                  std::span<const double> pose_times_s) {
  std::vector<std::string> notes;
  for (std::size_t losses = 0; losses < design.accuracy.after.size(); ++losses) {
    if (std::string note = worst_error(design, losses, task, pose_times_s); !note.empty())
      notes.push_back(std::move(note));
  }
  if (design.visibility.poses() > 0) notes.push_back(fewest_seen(design, pose_times_s));
  notes.push_back(taken_for(design));
  for (const MarginToBody& other : design.between_bodies) {
    if (other.margin.seen.empty()) continue;
    notes.push_back(fmt::format("{} fit targets of {} within {} mm RMS.",
                                ids_of(design.targets, other.margin.seen), other.body,
                                text_of_value(other.margin.rms_mm)));
  }
  return notes;
}

}  // namespace asterism
