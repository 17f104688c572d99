// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/core/output_file.hpp"
#include "asterism/io/cell_file.hpp"
#include "asterism/io/cell_layout.hpp"
#include "asterism/io/cell_scan.hpp"
#include "asterism/io/cell_text.hpp"
#include "asterism/io/mesh_file.hpp"

namespace asterism {
namespace {

std::string text_of(const Lens& lens) {
  const std::vector<double> distortion(lens.distortion.begin(), lens.distortion.begin() + lens.coefficients);
  return fmt::format(
      "width_px = {}\nheight_px = {}\nfx = {}\nfy = {}\nskew = {}\ncx = {}\ncy = {}\ndistortion = [{}]\n",
      lens.width_px, lens.height_px, lens.fx, lens.fy, lens.skew, lens.cx, lens.cy,
      fmt::join(distortion, ", "));
}

std::string swing_line(const char* key, const Swing& swing, bool turning) {
  if (swing.amplitude == 0) return "";
  return fmt::format("{} = {{{} = {}, frequency_hz = {}, phase_deg = {}}}\n", key,
                     turning ? "amplitude_deg" : "amplitude_mm",
                     turning ? deg_from_rad(swing.amplitude) : swing.amplitude, swing.frequency_hz,
                     deg_from_rad(swing.phase_rad));
}

std::string text_of(const Sweep& sweep) {
  std::string text = fmt::format("kind = \"sweep\"\npose = {}\npivot_mm = {}\n",
                                 toml_of(sweep.tracker_from_rest), toml_of(sweep.pivot_mm));
  text += swing_line("yaw", sweep.yaw, true) + swing_line("pitch", sweep.pitch, true) +
          swing_line("roll", sweep.roll, true);
  text += swing_line("x", sweep.x, false) + swing_line("y", sweep.y, false) + swing_line("z", sweep.z, false);
  if (sweep.order == TurnOrder::RollPitchYaw) text += "order = \"roll-pitch-yaw\"\n";
  if (sweep.from_s) text += fmt::format("from_s = {}\n", *sweep.from_s);
  if (sweep.to_s) text += fmt::format("to_s = {}\n", *sweep.to_s);
  return text;
}

std::string text_of(const KeyedMotion& motion) {
  std::string text = "kind = \"keys\"\n";
  for (const KeyPose& key : motion.keys) {
    text += fmt::format("[[body.motion.key]]\ntime_s = {}\npose = {}\n", key.time_s,
                        toml_of(key.tracker_from_body));
  }
  return text;
}

std::string text_of(const Mover& mover) {
  std::string text = fmt::format("\n[[body]]\nname = {}\n\n[body.motion]\n", toml_of(mover.body.name));
  text += std::visit([](const auto& motion) { return text_of(motion); }, mover.motion);
  for (const Target& target : mover.body.targets) {
    text += fmt::format("\n[[body.target]]\nid = {}\nposition_mm = {}\n", toml_of(target.id),
                        toml_of(target.position));
    if (target.normal) text += fmt::format("normal = {}\n", toml_of(*target.normal));
    if (target.diameter_mm) text += fmt::format("diameter_mm = {}\n", *target.diameter_mm);
  }
  return text;
}

std::string text_of(const Obstacle& obstacle) {
  std::string text = fmt::format("\n[[obstacle]]\nname = {}\n", toml_of(obstacle.name));
  if (!obstacle.body.empty()) text += fmt::format("body = {}\n", toml_of(obstacle.body));
  text += fmt::format("pose = {}\n", toml_of(obstacle.carrier_from_shape));
  if (obstacle.level) text += fmt::format("level = {}\n", *obstacle.level);
  return text + toml_of(obstacle.shape);
}

/// Options as lines of TOML.
class LineWriter : public OptionVisitor {
 public:
  std::string lines;
  void number(std::string_view name, double& value, Limits, std::string_view) override {
    add(name, fmt::format("{}", value));
  }
  void integer(std::string_view name, int& value, Limits, std::string_view) override {
    add(name, fmt::format("{}", value));
  }
  void flag(std::string_view name, bool& value, std::string_view) override {
    add(name, value ? "true" : "false");
  }
  void text(std::string_view name, std::string& value, std::string_view) override {
    add(name, toml_of(value));
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view) override {
    add(name, toml_of(words.at(static_cast<std::size_t>(index))));
  }

 private:
  void add(std::string_view name, const std::string& value) {
    lines += fmt::format("{} = {}\n", name, value);
  }
};

template <class Options>
std::string lines_of(Options options) {
  LineWriter writer;
  describe(options, writer);
  return writer.lines;
}

template <class Options>
std::string part(const char* key, const Options& options) {
  return fmt::format("\n[{}]\n{}", key, lines_of(options));
}

std::string text_of(const Platform& platform) {
  return fmt::format("\n[platform]\nbody = {}\npivot_mm = {}\n", toml_of(platform.body),
                     toml_of(platform.pivot_mm)) +
         part("platform.stroke", platform.stroke) + part("platform.read_out", platform.read_out);
}

/// A solid's lines; its surface goes into a file of its own.
std::string text_of(const Solid& solid, const std::filesystem::path& mesh) {
  write_ply(mesh, *solid.surface);
  std::string text =
      fmt::format("name = {}\nbody = {}\nmesh = {}\nunit = \"mm\"\npose = {}\n", toml_of(solid.name),
                  toml_of(solid.body), toml_of(mesh.filename().string()), toml_of(solid.carrier_from_solid));
  if (solid.level) text += fmt::format("level = {}\n", *solid.level);
  return text;
}

/// The part and what else hides targets by its mesh; CELL.workpiece.ply, CELL.fixture-1.ply … hold the
/// meshes.
std::string solids_of(const Cell& cell, const std::filesystem::path& file) {
  const auto mesh = [&](const std::string& of) {
    return file.parent_path() / fmt::format("{}.{}.ply", file.stem().string(), of);
  };
  std::string text;
  if (cell.workpiece) text += "\n[workpiece]\n" + text_of(*cell.workpiece, mesh("workpiece"));
  for (std::size_t i = 0; i < cell.fixtures.size(); ++i) {
    text += "\n[[fixture]]\n" + text_of(cell.fixtures[i], mesh(fmt::format("fixture-{}", i + 1)));
  }
  return text;
}

std::string text_of(const Scanner& scanner) {
  return part("scanner", scanner) + fmt::format("pose = {}\n", toml_of(scanner.body_from_scanner));
}

std::string text_of(const ScanPass& pass) {
  return fmt::format("\n[[scan_pass]]\nscan = {}\nfrom_s = {}\nto_s = {}\n", pass.scan, pass.from_s,
                     pass.to_s);
}

std::string text_of(const TargetFault& fault) {
  std::string text = fmt::format("\n[[fault]]\nkind = \"{}\"\nbody = {}\ntarget = {}\ntime_s = {}\n",
                                 fault.kind == FaultKind::Knocked ? "knocked" : "falls-off",
                                 toml_of(fault.body), toml_of(fault.target), fault.time_s);
  if (fault.kind == FaultKind::Knocked) text += fmt::format("shift_mm = {}\n", toml_of(fault.shift_mm));
  return text;
}

std::string text_of(const Lamp& lamp) {
  return fmt::format("\n[[lamp]]\nname = {}\nposition_mm = {}\n", toml_of(lamp.name),
                     toml_of(lamp.in_tracker_mm)) +
         lines_of(lamp);
}

std::string text_of(const Verification& verification) {
  std::string text = part("verify", verification);
  for (const WorkPoint& point : verification.points) {
    text += fmt::format("\n[[verify.point]]\nname = {}\nposition_mm = {}\n", toml_of(point.name),
                        toml_of(point.in_body_mm));
  }
  return text;
}

}  // namespace

void write_cell(const std::filesystem::path& file, const Cell& cell) {
  std::string text = fmt::format(
      "name = {}\n\n[tracker]\nright_from_left = {}\n\n[tracker.left]\n{}\n[tracker.right]\n{}",
      toml_of(cell.name), toml_of(cell.rig.right_from_left), text_of(cell.rig.left), text_of(cell.rig.right));
  if (cell.volume) text += part("tracker.volume", *cell.volume);
  text += part("sensor", cell.sensor) + part("light", cell.light) + part("timing", cell.timing) +
          part("noise", cell.noise);
  for (const Mover& mover : cell.movers) text += text_of(mover);
  for (const Obstacle& obstacle : cell.obstacles) text += text_of(obstacle);
  if (cell.platform) text += text_of(*cell.platform);
  text += solids_of(cell, file);
  if (cell.scanner) text += text_of(*cell.scanner);
  text += part("scan", cell.scan_task) + rest_of(cell.scan_task);
  if (cell.robot) text += text_of(*cell.robot);
  for (const ScanPass& pass : cell.passes) text += text_of(pass);
  for (const TargetFault& fault : cell.faults) text += text_of(fault);
  for (const Lamp& lamp : cell.lamps) text += text_of(lamp);
  text += text_of(cell.verification);
  if (cell.layout) text += part("layout", *cell.layout) + lists_of(*cell.layout);
  write_file(file, text);
}

}  // namespace asterism
