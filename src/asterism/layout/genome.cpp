// SPDX-License-Identifier: Apache-2.0
#include "asterism/layout/genome.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr int kManyPushes = 300;  // the same, where room is sought
constexpr int kPushes = 8;        // sweeps of pushing targets apart
constexpr int kDarts = 40;        // tries for a free place
constexpr double kSpare = 1e-6;   // pushed this much farther than asked, against rounding

std::size_t index_below(std::size_t count, RandomStream& random) {
  return random.below(static_cast<std::uint32_t>(count));
}

Vec3 random_direction(RandomStream& random) {
  for (;;) {
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    if (direction.norm() > 1e-3) return direction.normalized();
  }
}

bool is_free(std::span<const Vec3> layout, const Vec3& place, std::size_t except, double spacing_mm) {
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (i != except && (layout[i] - place).norm() < spacing_mm) return false;
  }
  return true;
}

/// The first target that stands too near to an earlier one.
std::optional<std::size_t> first_crowded(std::span<const Vec3> layout, double spacing_mm) {
  for (std::size_t i = 1; i < layout.size(); ++i) {
    if (!is_free(layout.first(i), layout[i], i, spacing_mm)) return i;
  }
  return std::nullopt;
}

/// One sweep over all pairs; true when none was too near.
bool push_apart(std::vector<Vec3>& layout, const LayoutRules& rules, RandomStream& random) {
  bool apart = true;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 between = layout[i] - layout[j];
      const double distance = between.norm();
      if (distance >= rules.spacing_mm) continue;
      apart = false;
      const Vec3 way = distance > 0 ? Vec3(between / distance) : random_direction(random);
      const double push = 0.5 * (rules.spacing_mm - distance) + kSpare * rules.spacing_mm;
      for (const auto& [k, sign] : {std::pair(i, 1.0), std::pair(j, -1.0)}) {
        const auto place =
            nearest_allowed_place(rules.surface, layout[k] + sign * push * way, rules.clearance_mm);
        if (place) layout[k] = place->position_mm;
      }
    }
  }
  return apart;
}

/// A place that keeps its distance from all targets but `except`.
std::optional<Vec3> free_place(std::span<const Vec3> layout, std::size_t except, const LayoutRules& rules,
                               RandomStream& random) {
  for (int dart = 0; dart < kDarts; ++dart) {
    const auto place = random_place(rules.surface, rules.clearance_mm, random);
    if (place && is_free(layout, place->position_mm, except, rules.spacing_mm)) return place->position_mm;
  }
  return std::nullopt;
}

void take_out(std::vector<Vec3>& layout, std::size_t index) {
  layout.erase(layout.begin() + static_cast<std::ptrdiff_t>(index));
}

void bring_to_count(std::vector<Vec3>& layout, const LayoutRules& rules, RandomStream& random) {
  while (layout.size() > static_cast<std::size_t>(rules.most)) {
    take_out(layout, index_below(layout.size(), random));
  }
  while (layout.size() < static_cast<std::size_t>(rules.fewest)) {
    const auto place = free_place(layout, layout.size(), rules, random);
    const auto any = place ? std::nullopt : random_place(rules.surface, rules.clearance_mm, random);
    require(place || any, "the surface has a place outside the keep-outs");
    layout.push_back(place ? *place : any->position_mm);
  }
}

}  // namespace

std::vector<Vec3> positions_of(std::span<const double> genes) {
  require(genes.size() % 3 == 0, "a layout's genes are three a target");
  std::vector<Vec3> positions;
  positions.reserve(genes.size() / 3);
  for (std::size_t i = 0; i < genes.size(); i += 3) {
    positions.emplace_back(genes[i], genes[i + 1], genes[i + 2]);
  }
  return positions;
}

Genes genes_of(std::span<const Vec3> positions) {
  Genes genes;
  genes.reserve(3 * positions.size());
  for (const Vec3& p : positions) genes.insert(genes.end(), {p.x(), p.y(), p.z()});
  return genes;
}

void put_in_order(std::vector<Vec3>& layout) {
  std::sort(layout.begin(), layout.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
}

void repair(std::vector<Vec3>& layout, const LayoutRules& rules, RandomStream& random) {
  for (Vec3& target : layout) {
    auto place = nearest_allowed_place(rules.surface, target, rules.clearance_mm);
    if (!place) place = random_place(rules.surface, rules.clearance_mm, random);
    require(place.has_value(), "the surface has a place outside the keep-outs");
    target = place->position_mm;
  }
  bring_to_count(layout, rules, random);
  for (int sweep = 0; sweep < kPushes; ++sweep) {
    if (push_apart(layout, rules, random)) break;
  }
  for (std::size_t tries = layout.size(); tries > 0; --tries) {
    const auto crowded = first_crowded(layout, rules.spacing_mm);
    if (!crowded) break;
    if (const auto place = free_place(layout, *crowded, rules, random)) {
      layout[*crowded] = *place;
    } else if (layout.size() > static_cast<std::size_t>(rules.fewest)) {
      take_out(layout, *crowded);
    } else {
      break;
    }
  }
  put_in_order(layout);
}

std::optional<std::vector<Vec3>> spread_apart(int targets, const LayoutRules& rules, RandomStream& random) {
  std::vector<Vec3> layout;
  for (int i = 0; i < targets; ++i) {
    const auto place = random_place(rules.surface, rules.clearance_mm, random);
    if (!place) return std::nullopt;
    layout.push_back(place->position_mm);
  }
  for (int sweep = 0; sweep < kManyPushes; ++sweep) {
    if (push_apart(layout, rules, random)) return layout;
  }
  return std::nullopt;
}

void cut_and_join(std::span<const Vec3> mother, std::span<const Vec3> father, std::vector<Vec3>& daughter,
                  std::vector<Vec3>& son, RandomStream& random) {
  daughter.clear();
  son.clear();
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : mother) middle += 0.5 * p / static_cast<double>(mother.size());
  for (const Vec3& p : father) middle += 0.5 * p / static_cast<double>(father.size());
  const Vec3 normal = random_direction(random);
  for (const Vec3& p : mother) (normal.dot(p - middle) > 0 ? daughter : son).push_back(p);
  for (const Vec3& p : father) (normal.dot(p - middle) > 0 ? son : daughter).push_back(p);
}

void cross_matched(std::span<const Vec3> mother, std::span<const Vec3> father, const Bounds& bounds,
                   const Variation& variation, std::vector<Vec3>& daughter, std::vector<Vec3>& son,
                   RandomStream& random) {
  struct Pair {
    double distance;
    std::size_t of_mother, of_father;
    [[nodiscard]] auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  pairs.reserve(mother.size() * father.size());
  for (std::size_t m = 0; m < mother.size(); ++m) {
    for (std::size_t f = 0; f < father.size(); ++f) {
      pairs.push_back({(mother[m] - father[f]).squaredNorm(), m, f});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> mother_taken(mother.size()), father_taken(father.size());
  std::vector<Vec3> matched_mother, matched_father;
  for (const Pair& pair : pairs) {
    if (mother_taken[pair.of_mother] || father_taken[pair.of_father]) continue;
    mother_taken[pair.of_mother] = father_taken[pair.of_father] = true;
    matched_mother.push_back(mother[pair.of_mother]);
    matched_father.push_back(father[pair.of_father]);
  }
  Genes lowest, highest, girl, boy;
  for (std::size_t i = 0; i < matched_mother.size(); ++i) {
    lowest.insert(lowest.end(), bounds.lowest.data(), bounds.lowest.data() + 3);
    highest.insert(highest.end(), bounds.highest.data(), bounds.highest.data() + 3);
  }
  variation.cross(genes_of(matched_mother), genes_of(matched_father), lowest, highest, girl, boy, random);
  daughter = positions_of(girl);
  son = positions_of(boy);
  for (std::size_t m = 0; m < mother.size(); ++m) {
    if (!mother_taken[m]) daughter.push_back(mother[m]);
  }
  for (std::size_t f = 0; f < father.size(); ++f) {
    if (!father_taken[f]) son.push_back(father[f]);
  }
}

void mutate(std::vector<Vec3>& layout, const LayoutRules& rules, const Bounds& bounds,
            const Variation& variation, const LayoutMutation& mutation, RandomStream& random) {
  const double kind = random.uniform();
  const auto count = static_cast<int>(layout.size());
  if (kind < mutation.add) {
    const auto place = count < rules.most ? free_place(layout, layout.size(), rules, random) : std::nullopt;
    if (place) layout.push_back(*place);
  } else if (kind < mutation.add + mutation.remove) {
    if (count > rules.fewest) take_out(layout, index_below(layout.size(), random));
  } else if (kind < mutation.add + mutation.remove + mutation.relocate && count > 0) {
    const std::size_t moved = index_below(layout.size(), random);
    if (const auto place = free_place(layout, moved, rules, random)) layout[moved] = *place;
  }
  if (!layout.empty() && random.uniform() < mutation.nudge) {
    const double size = (bounds.highest - bounds.lowest).norm();
    const double step = size * std::pow(10.0, random.uniform(-3, -1));
    const std::size_t nudged = index_below(layout.size(), random);
    layout[nudged] += step * random_direction(random);
  }
  Genes lowest, highest;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    lowest.insert(lowest.end(), bounds.lowest.data(), bounds.lowest.data() + 3);
    highest.insert(highest.end(), bounds.highest.data(), bounds.highest.data() + 3);
  }
  Genes genes = genes_of(layout);
  variation.mutate(genes, lowest, highest, random);
  layout = positions_of(genes);
}

double moving_cost_mm(std::span<const Vec3> from, std::span<const Vec3> to, double handling_mm) {
  // The Hungarian method with potentials on a square of |from| + |to|: a target may also be taken away
  // (a column of its own) or come new (a row of its own); both unused at once costs nothing.
  const std::size_t n = from.size() + to.size();
  const auto cost = [&](std::size_t row, std::size_t column) {
    if (row < from.size() && column < to.size()) return (from[row] - to[column]).norm();
    return row < from.size() || column < to.size() ? handling_mm : 0.0;
  };
  std::vector<double> of_row(n + 1), of_column(n + 1);
  std::vector<std::size_t> row_at(n + 1), before(n + 1);
  for (std::size_t row = 1; row <= n; ++row) {
    row_at[0] = row;
    std::size_t at = 0;
    std::vector<double> slack(n + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> done(n + 1);
    while (row_at[at] != 0) {
      done[at] = true;
      std::size_t next = 0;
      double step = std::numeric_limits<double>::infinity();
      for (std::size_t column = 1; column <= n; ++column) {
        if (done[column]) continue;
        const double reduced = cost(row_at[at] - 1, column - 1) - of_row[row_at[at]] - of_column[column];
        if (reduced < slack[column]) {
          slack[column] = reduced;
          before[column] = at;
        }
        if (slack[column] < step) {
          step = slack[column];
          next = column;
        }
      }
      for (std::size_t column = 0; column <= n; ++column) {
        if (done[column]) {
          of_row[row_at[column]] += step;
          of_column[column] -= step;
        } else {
          slack[column] -= step;
        }
      }
      at = next;
    }
    for (; at != 0; at = before[at]) row_at[at] = row_at[before[at]];
  }
  double sum = 0;
  for (std::size_t column = 1; column <= n; ++column) sum += cost(row_at[column] - 1, column - 1);
  return sum;
}

}  // namespace asterism
