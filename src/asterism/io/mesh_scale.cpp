// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/mesh_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr double kSmallestMm = 5, kLargestMm = 50e3;  // of a part, from corner to corner
constexpr std::array<double, 4> kMmOfUnit = {1, 10, 1000, 25.4};

const std::string& word_of(LengthUnit unit) { return length_unit_words().at(static_cast<std::size_t>(unit)); }

bool is_plausible(double diagonal_mm) { return diagonal_mm >= kSmallestMm && diagonal_mm <= kLargestMm; }

std::string length_text(double mm) {
  if (mm < 1e4) return fmt::format("{:.4g} mm", mm);
  return fmt::format("{:.4g} m", 1e-3 * mm);
}

/// "metres would make it 400 mm: say unit = "m""; what would be right for a file of this size.
std::string other_units(double longest, double diagonal) {
  constexpr std::array<const char*, 4> names = {"millimetres", "centimetres", "metres", "inches"};
  std::vector<std::string> choices;
  for (std::size_t i = 0; i < kMmOfUnit.size(); ++i) {
    if (!is_plausible(kMmOfUnit[i] * diagonal)) continue;
    choices.push_back(fmt::format("{} would make it {}: say unit = \"{}\"", names[i],
                                  length_text(kMmOfUnit[i] * longest), length_unit_words()[i]));
  }
  if (choices.empty()) return "no unit makes that a part of a cell; say longest_mm, its longest edge";
  return fmt::format("{}", fmt::join(choices, "; "));
}

double factor_of(const MeshScale& scale, const MeshFacts& facts, const std::string& where) {
  const double longest = (facts.highest - facts.lowest).maxCoeff();
  const double diagonal = facts.diagonal_mm();
  if (scale.unit && scale.longest_mm) {
    throw InputError(where, "a mesh is scaled by its `unit` or to its `longest_mm`, not both");
  }
  if (!scale.unit && !scale.longest_mm) {
    throw InputError(where, "a mesh file does not tell its unit; " + other_units(longest, diagonal));
  }
  const double factor = scale.unit ? mm_of(*scale.unit) : *scale.longest_mm / longest;
  if (is_plausible(factor * diagonal)) return factor;
  if (scale.longest_mm) {
    throw InputError(where, fmt::format("`longest_mm` is {}; a part is {} mm to {} m from corner to corner",
                                        *scale.longest_mm, kSmallestMm, 1e-3 * kLargestMm));
  }
  throw InputError(where, fmt::format("is {} long in {}; {}", length_text(factor * longest),
                                      word_of(*scale.unit), other_units(longest, diagonal)));
}

}  // namespace

const std::vector<std::string>& length_unit_words() {
  static const std::vector<std::string> words = {"mm", "cm", "m", "inch"};
  return words;
}

double mm_of(LengthUnit unit) { return kMmOfUnit.at(static_cast<std::size_t>(unit)); }

std::optional<LengthUnit> length_unit_of(const std::string& word) {
  const std::vector<std::string>& words = length_unit_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<LengthUnit>(found - words.begin());
}

TriangleMesh checked_mesh(TriangleMesh mesh, const MeshScale& scale, const std::string& where) {
  if (mesh.empty()) throw InputError(where, "the mesh holds no triangles");
  const auto finite = [](const Vec3& vertex) { return vertex.allFinite(); };
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), finite)) {
    throw InputError(where, "a coordinate of the mesh is not a finite number");
  }
  if (scale.flip) mesh = flipped(std::move(mesh));
  const MeshFacts facts = facts_of(mesh);
  if (!(facts.area_mm2 > 0)) throw InputError(where, "the mesh has no area: all its triangles are lines");
  const double factor = factor_of(scale, facts, where);
  if (facts.closed() && facts.volume_mm3 < 0) {
    throw InputError(where, scale.flip
                                ? "the mesh is inside out when flipped; leave `flip` out"
                                : "the mesh is inside out: its triangles face inwards; say flip = true");
  }
  return factor == 1 ? mesh : scaled(std::move(mesh), factor);
}

}  // namespace asterism
