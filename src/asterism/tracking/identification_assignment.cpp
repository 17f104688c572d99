// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/identification_assignment.hpp"

#include <algorithm>
#include <numeric>

namespace asterism {
namespace {

constexpr std::size_t kMaxSteps = 20000;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

bool share_points(const Labelling& a, const Labelling& b, std::span<const Claims> claims) {
  for (const auto& x : a.labels) {
    for (const auto& y : b.labels) {
      if (x.scene == y.scene) return true;
      if (share_a_claim(claims[static_cast<std::size_t>(x.scene)],
                        claims[static_cast<std::size_t>(y.scene)])) {
        return true;
      }
    }
  }
  return false;
}

/// Bodies that compete for points, directly or through others, and their labellings.
struct Group {
  std::vector<std::vector<std::size_t>> of_body;  // indices of labellings, best first
};

/// One labelling or none (kNone) for each body of a group.
struct Selection {
  std::vector<std::size_t> taken;
  double cost = 0;
};

class Selector {
 public:
  Selector(const Group& group, std::span<const Labelling> labellings, std::span<const Claims> claims)
      : group_(group), labellings_(labellings), claims_(claims), best_after_(group.of_body.size() + 1, 0.0) {
    for (std::size_t body = group.of_body.size(); body-- > 0;) {
      best_after_[body] =
          best_after_[body + 1] + std::min(0.0, labellings_[group.of_body[body].front()].cost);
    }
  }

  /// The best selection with a cost below `limit`, with one labelling of one body forced if `forced` is
  /// given. Empty when there is none.
  std::optional<Selection> best(double limit, std::size_t forced_body = kNone, std::size_t forced = kNone) {
    forced_body_ = forced_body;
    forced_ = forced;
    limit_ = limit;
    found_.reset();
    current_ = {};
    extend(0.0);
    return found_;
  }

  [[nodiscard]] bool complete() const { return steps_ <= kMaxSteps; }

 private:
  void extend(double cost) {
    const std::size_t body = current_.taken.size();
    if (++steps_ > kMaxSteps || !(cost + best_after_[body] < limit_)) return;
    if (body == group_.of_body.size()) {
      found_ = current_;
      found_->cost = cost;
      limit_ = cost;
      return;
    }
    for (const std::size_t option : group_.of_body[body]) {
      if (body == forced_body_ && option != forced_) continue;
      if (blocked(option)) continue;
      take(option, cost + labellings_[option].cost);
    }
    if (body != forced_body_) take(kNone, cost);
  }

  void take(std::size_t option, double cost) {
    current_.taken.push_back(option);
    extend(cost);
    current_.taken.pop_back();
  }

  [[nodiscard]] bool blocked(std::size_t option) const {
    return std::any_of(current_.taken.begin(), current_.taken.end(), [&](std::size_t taken) {
      return taken != kNone && share_points(labellings_[taken], labellings_[option], claims_);
    });
  }

  const Group& group_;
  std::span<const Labelling> labellings_;
  std::span<const Claims> claims_;
  std::vector<double> best_after_;
  std::size_t forced_body_ = kNone, forced_ = kNone, steps_ = 0;
  double limit_ = 0;
  Selection current_;
  std::optional<Selection> found_;
};

std::vector<Group> groups_of(std::span<const Labelling> labellings, std::span<const Claims> claims,
                             std::size_t bodies) {
  std::vector<std::vector<std::size_t>> of_body(bodies);
  for (std::size_t i = 0; i < labellings.size(); ++i) {
    if (labellings[i].cost < 0) of_body[static_cast<std::size_t>(labellings[i].body)].push_back(i);
  }
  std::vector<std::size_t> root(bodies);
  std::iota(root.begin(), root.end(), std::size_t{0});
  for (std::size_t a = 0; a < bodies; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (root[a] == root[b]) continue;
      const bool compete = std::any_of(of_body[a].begin(), of_body[a].end(), [&](std::size_t x) {
        return std::any_of(of_body[b].begin(), of_body[b].end(),
                           [&](std::size_t y) { return share_points(labellings[x], labellings[y], claims); });
      });
      if (compete)
        std::replace(root.begin(), root.end(), std::max(root[a], root[b]), std::min(root[a], root[b]));
    }
  }
  std::vector<Group> groups(bodies);
  for (std::size_t body = 0; body < bodies; ++body) {
    auto& options = of_body[body];
    if (options.empty()) continue;
    std::sort(options.begin(), options.end(), [&](std::size_t a, std::size_t b) {
      if (labellings[a].cost != labellings[b].cost) return labellings[a].cost < labellings[b].cost;
      return labellings[a].labels < labellings[b].labels;
    });
    groups[root[body]].of_body.push_back(std::move(options));
  }
  std::erase_if(groups, [](const Group& group) { return group.of_body.empty(); });
  return groups;
}

/// How much larger the residuals of the chosen labellings are than their covariances say, at least 1.
double unstated_variance(const std::vector<Choice>& choices, std::span<const Labelling> labellings) {
  double largest = 1;
  for (const Choice& choice : choices) {
    const Labelling& labelling = labellings[choice.labelling];
    const double degrees = 3.0 * static_cast<double>(labelling.labels.size()) - 6.0;
    largest = std::max(largest, labelling.fit.chi_square / degrees);
  }
  return largest;
}

/// What of each choice outlasts this rival selection.
void contest(std::vector<Choice>& choices, const Selection& chosen, const Selection& rival,
             std::span<const Labelling> labellings) {
  std::size_t next = 0;
  for (std::size_t body = 0; body < chosen.taken.size(); ++body) {
    if (chosen.taken[body] == kNone) continue;
    Choice& choice = choices[next++];
    const std::size_t other = rival.taken[body];
    if (other == choice.labelling) continue;
    if (other == kNone) {
      choice.certain.clear();
      continue;
    }
    const Labelling& rivalling = labellings[other];
    std::erase_if(choice.certain, [&](const Correspondence& label) {
      return !std::binary_search(rivalling.labels.begin(), rivalling.labels.end(), label);
    });
    if (rivalling.labels.size() < labellings[choice.labelling].labels.size()) continue;
    choice.rival_rms_mm = std::min(choice.rival_rms_mm.value_or(rivalling.fit.rms_mm), rivalling.fit.rms_mm);
  }
}

std::vector<Choice> choose_in(const Group& group, std::span<const Labelling> labellings,
                              std::span<const Claims> claims, double decisive, std::size_t fewest) {
  Selector selector(group, labellings, claims);
  const auto chosen = selector.best(0.0);
  if (!chosen) return {};
  std::vector<Choice> choices;
  for (const std::size_t option : chosen->taken) {
    if (option != kNone)
      choices.push_back({option, LabelStatus::Ok, labellings[option].labels, std::nullopt});
  }
  // Covariances that prove too small make every difference look too decisive.
  const double rival_below = chosen->cost + decisive * unstated_variance(choices, labellings);
  for (std::size_t body = 0; body < group.of_body.size(); ++body) {
    for (const std::size_t option : group.of_body[body]) {
      if (option == chosen->taken[body]) continue;
      const auto rival = selector.best(rival_below, body, option);
      if (rival) contest(choices, *chosen, *rival, labellings);
    }
  }
  for (Choice& choice : choices) {
    const std::size_t all = labellings[choice.labelling].labels.size();
    if (choice.certain.size() < std::min(all, fewest) || !selector.complete())
      choice.status = LabelStatus::Ambiguous;
  }
  return choices;
}

}  // namespace

std::vector<Choice> choose_disjoint(std::span<const Labelling> labellings, std::span<const Claims> claims,
                                    std::size_t bodies, double decisive, std::size_t fewest) {
  std::vector<Choice> choices;
  for (const Group& group : groups_of(labellings, claims, bodies)) {
    const auto chosen = choose_in(group, labellings, claims, decisive, fewest);
    choices.insert(choices.end(), chosen.begin(), chosen.end());
  }
  std::sort(choices.begin(), choices.end(), [&](const Choice& a, const Choice& b) {
    return labellings[a.labelling].body < labellings[b.labelling].body;
  });
  return choices;
}

}  // namespace asterism
