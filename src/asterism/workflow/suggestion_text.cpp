// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "asterism/report/layout_words.hpp"
#include "asterism/workflow/suggest_layout.hpp"

namespace asterism {
namespace {

constexpr std::size_t kCausesTold = 2;

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

/// "−35 %", or what else is to be said of an error after a change.
std::string change_of(const LayoutStanding& from, const LayoutStanding& to) {
  const auto gain = gain_of(from, to);
  return gain ? fmt::format("{:+.1f} %", -100 * *gain) : "";
}

std::string target_line(const PresentTarget& target, const LayoutStanding& present) {
  std::string line = fmt::format("  {:<8} {:>6}", target.id, percent(target.seen));
  if (target.observed) {
    const auto& sigma = target.observed->sigma_px;
    line += fmt::format(" {:>9} {:>9}", percent(target.observed->seen_by_both),
                        sigma ? fmt::format("{:.3f}", *sigma) : "–");
  }
  line +=
      fmt::format(" {:>9} {:>8}", text_of_value(target.without.error_mm), change_of(present, target.without));
  std::vector<std::string> causes;
  for (const auto& cause : target.unseen_since) {
    if (causes.size() < kCausesTold) causes.push_back(fmt::format("{} {}", percent(cause.share), cause.what));
  }
  return line + (causes.empty() ? "" : fmt::format("  {}", fmt::join(causes, ", "))) + "\n";
}

std::string targets_table(const SuggestedChange& suggested) {
  const bool watched = !suggested.targets.empty() && suggested.targets.front().observed;
  std::string text =
      fmt::format("\n  {:<8} {:>6}{} {:>9} {:>8}\n", "target", "seen",
                  watched ? fmt::format(" {:>9} {:>9}", "observed", "resid. px") : "", "without", "");
  text += fmt::format("  {:<8} {:>6}{} {:>9} {:>8}  not seen by both, since\n", "", "",
                      watched ? fmt::format(" {:>9} {:>9}", "seen", "1 sigma") : "", "it mm", "");
  for (const PresentTarget& target : suggested.targets)
    text += target_line(target, suggested.suggestion.present);
  return text;
}

std::string change_line(const LayoutChange& change, const SuggestedChange& suggested) {
  const LayoutStanding& from = suggested.suggestion.present;
  const LayoutStanding& to = change.after;
  std::string place, patch;
  if (change.place) {
    const Vec3& at = change.place->position_mm;
    place = fmt::format("{:.0f}, {:.0f}, {:.0f}", at.x(), at.y(), at.z());
    patch = suggested.cell.layout->surface.patches[change.place->patch].name;
  }
  std::string line = fmt::format("  {:<8} {:<6} {:<19} {:<15} {:>9} {:>8} {:>7} {:>9}", text_of(change.kind),
                                 change.id, place, patch, text_of_value(to.error_mm), change_of(from, to),
                                 fmt::format("{} → {}", from.visible, to.visible),
                                 change.place ? text_of_value(change.nearby_mm) : "");
  for (const std::string& broken : broken_constraints(to.constraints)) line += "  ✗ " + broken;
  return line + "\n";
}

std::string changes_table(const SuggestedChange& suggested, std::size_t told) {
  const Suggestion& suggestion = suggested.suggestion;
  const std::string label = label_of_quantity(info_of(suggestion.objective).name);
  std::string text = fmt::format("\n  {:<8} {:<6} {:<19} {:<15} {:>9} {:>8} {:>7} {:>9}\n", "change",
                                 "target", "to mm", "on", "error mm", "", "visible", "beside mm");
  for (const auto* changes :
       {&suggestion.relearnings, &suggestion.moves, &suggestion.additions, &suggestion.removals}) {
    for (std::size_t i = 0; i < std::min(told, changes->size()); ++i)
      text += change_line((*changes)[i], suggested);
  }
  return text +
         fmt::format("  (error: {}; beside: the largest with the foot a little off its place)\n", label);
}

}  // namespace

std::string text_of(const SuggestedChange& suggested, std::size_t told) {
  const Suggestion& suggestion = suggested.suggestion;
  std::string text = fmt::format("\n{}, targets of {}\n", suggested.cell.name, suggested.cell.layout->body);
  const auto list = [&](const std::string& title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    text += fmt::format("\n{}\n", title);
    for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  };
  list("Observed", suggested.observations);
  list("As it stands (predicted)", suggested.limits);
  text += targets_table(suggested);
  text += changes_table(suggested, told);
  list("Not tried", suggestion.notes);
  text += fmt::format("\n→ {}\n", suggested.verdict);
  return text + fmt::format("  ({} changes to {} places screened, {} evaluated in full{}, {:.1f} s)\n",
                            suggestion.screened, suggestion.places, suggestion.evaluated,
                            suggestion.proven ? "" : "; a better one may exist among those left out",
                            suggested.seconds);
}

}  // namespace asterism
