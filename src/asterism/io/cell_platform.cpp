// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_parts.hpp"
#include "asterism/io/cell_tables.hpp"

namespace asterism {
namespace {

template <class Options>
void read_inner(const CellSection& outer, const char* key, const Form& form, Options& options) {
  if (!outer.has(key)) return;
  const CellSection section = outer.section(key, form.of);
  section.must_be(form);
  read_options_of(section, describing_options(options));
}

}  // namespace

Platform platform_of(const CellSection& section) {
  section.must_be(forms::platform());
  Platform platform;
  if (section.has("body")) platform.body = section.text("body");
  platform.pivot_mm = section.vector_or_zero("pivot_mm");
  read_inner(section, "stroke", forms::stroke(), platform.stroke);
  read_inner(section, "read_out", forms::read_out(), platform.read_out);
  return platform;
}

Scanner scanner_of(const CellSection& section) {
  section.must_be(forms::scanner());
  Scanner scanner;
  read_options_of(section, describing_options(scanner));
  if (section.has("pose")) scanner.body_from_scanner = plain_pose(section.section("pose", "a pose"));
  return scanner;
}

ScanPass scan_pass_of(const CellSection& section) {
  section.must_be(forms::scan_pass());
  return {static_cast<int>(section.number("scan")), section.number("from_s"), section.number("to_s")};
}

TargetFault fault_of(const CellSection& section) {
  section.must_be(forms::fault());
  TargetFault fault;
  fault.kind = section.text("kind") == "knocked" ? FaultKind::Knocked : FaultKind::FallsOff;
  fault.body = section.text("body");
  fault.target = section.text("target");
  fault.time_s = section.number_or("time_s", 0);
  fault.shift_mm = section.vector_or_zero("shift_mm");
  const bool shifts = fault.shift_mm != Vec3::Zero();
  if (fault.kind == FaultKind::Knocked && !shifts) section.refuse("a knocked target needs its `shift_mm`");
  if (fault.kind == FaultKind::FallsOff && shifts)
    section.refuse("a target that falls off has no `shift_mm`");
  return fault;
}

Lamp lamp_of(const CellSection& section) {
  section.must_be(forms::lamp());
  Lamp lamp;
  read_options_of(section, describing_options(lamp));
  if (section.has("name")) lamp.name = section.text("name");
  lamp.in_tracker_mm = section.vector("position_mm");
  return lamp;
}

std::vector<WorkPoint> points_of(const CellSection& section) {
  std::vector<WorkPoint> points;
  for (const CellSection& point : section.sections("point", "a point")) {
    point.must_be(forms::point());
    points.push_back({point.text("name"), point.vector("position_mm")});
  }
  return points;
}

Verification verification_of(const CellSection& section) {
  section.must_be(forms::verify());
  Verification verification;
  read_options_of(section, describing_options(verification));
  verification.points = points_of(section);
  return verification;
}

}  // namespace asterism
