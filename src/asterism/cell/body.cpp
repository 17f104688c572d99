// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/body.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

void check_target(const Target& target, const std::string& where) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(where, fmt::format("target `{}`: {}", target.id, what));
  };
  if (!target.position.allFinite()) refuse("a coordinate is not a finite number");
  if (target.normal && !(std::abs(target.normal->norm() - 1.0) < 1e-3)) {
    refuse(fmt::format("its normal must have length 1, not {:.6g}", target.normal->norm()));
  }
  if (target.diameter_mm && !(*target.diameter_mm > 0 && std::isfinite(*target.diameter_mm))) {
    refuse(fmt::format("its diameter must be positive, not {}", *target.diameter_mm));
  }
}

void check_body(const Body& body, const std::string& where) {
  const std::string here = fmt::format("{}: body `{}`", where, body.name);
  if (body.targets.empty()) throw InputError(here, "it has no targets");
  std::set<std::string> ids;
  for (const Target& target : body.targets) {
    if (!ids.insert(target.id).second)
      throw InputError(here, fmt::format("target id `{}` is given twice", target.id));
    check_target(target, here);
  }
  for (std::size_t i = 0; i < body.targets.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((body.targets[i].position - body.targets[j].position).norm() > 0) continue;
      throw InputError(here, fmt::format("targets `{}` and `{}` are at the same place", body.targets[j].id,
                                         body.targets[i].id));
    }
  }
}

}  // namespace

std::vector<Vec3> positions_of(std::span<const Target> targets) {
  std::vector<Vec3> positions;
  positions.reserve(targets.size());
  for (const Target& target : targets) positions.push_back(target.position);
  return positions;
}

void check_bodies(const std::vector<Body>& bodies, const std::string& where) {
  std::set<std::string> names;
  for (const Body& body : bodies) {
    if (body.name.empty()) throw InputError(where, "a body has no name");
    if (!names.insert(body.name).second)
      throw InputError(where, fmt::format("body `{}` is given twice", body.name));
    check_body(body, where);
  }
}

}  // namespace asterism
