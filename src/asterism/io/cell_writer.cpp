// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/core/output_file.hpp"
#include "asterism/io/cell_file.hpp"

namespace asterism {
namespace {

std::string text_of(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string text_of(const RigidMotion& pose) {
  const Quaternion& q = pose.rotation;
  return fmt::format("{{position_mm = {}, quaternion_wxyz = [{}, {}, {}, {}]}}", text_of(pose.translation),
                     q.w(), q.x(), q.y(), q.z());
}

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
                                 text_of(sweep.tracker_from_rest), text_of(sweep.pivot_mm));
  text += swing_line("yaw", sweep.yaw, true) + swing_line("pitch", sweep.pitch, true) +
          swing_line("roll", sweep.roll, true);
  return text + swing_line("x", sweep.x, false) + swing_line("y", sweep.y, false) +
         swing_line("z", sweep.z, false);
}

std::string text_of(const KeyedMotion& motion) {
  std::string text = "kind = \"keys\"\n";
  for (const KeyPose& key : motion.keys) {
    text += fmt::format("[[body.motion.key]]\ntime_s = {}\npose = {}\n", key.time_s,
                        text_of(key.tracker_from_body));
  }
  return text;
}

std::string text_of(const Mover& mover) {
  std::string text = fmt::format("\n[[body]]\nname = {}\n\n[body.motion]\n", in_quotes(mover.body.name));
  text += std::visit([](const auto& motion) { return text_of(motion); }, mover.motion);
  for (const Target& target : mover.body.targets) {
    text += fmt::format("\n[[body.target]]\nid = {}\nposition_mm = {}\n", in_quotes(target.id),
                        text_of(target.position));
    if (target.normal) text += fmt::format("normal = {}\n", text_of(*target.normal));
    if (target.diameter_mm) text += fmt::format("diameter_mm = {}\n", *target.diameter_mm);
  }
  return text;
}

std::string text_of(const Box& box) {
  return fmt::format("shape = \"box\"\nsize_mm = {}\n", text_of(box.size_mm));
}
std::string text_of(const Capsule& capsule) {
  return fmt::format("shape = \"capsule\"\nfrom_mm = {}\nto_mm = {}\nradius_mm = {}\n",
                     text_of(capsule.from_mm), text_of(capsule.to_mm), capsule.radius_mm);
}
std::string text_of(const Frustum& cone) {
  return fmt::format("shape = \"frustum\"\nbottom_radius_mm = {}\ntop_radius_mm = {}\nheight_mm = {}\n",
                     cone.bottom_radius_mm, cone.top_radius_mm, cone.height_mm);
}

std::string text_of(const Obstacle& obstacle) {
  std::string text = fmt::format("\n[[obstacle]]\nname = {}\n", in_quotes(obstacle.name));
  if (!obstacle.body.empty()) text += fmt::format("body = {}\n", in_quotes(obstacle.body));
  text += fmt::format("pose = {}\n", text_of(obstacle.carrier_from_shape));
  if (obstacle.level) text += fmt::format("level = {}\n", *obstacle.level);
  return text + std::visit([](const auto& shape) { return text_of(shape); }, obstacle.shape);
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
    add(name, in_quotes(value));
  }
  void choice(std::string_view name, int& index, const std::vector<std::string>& words,
              std::string_view) override {
    add(name, in_quotes(words.at(static_cast<std::size_t>(index))));
  }

 private:
  void add(std::string_view name, const std::string& value) {
    lines += fmt::format("{} = {}\n", name, value);
  }
};

template <class Options>
std::string part(const char* key, Options options) {
  LineWriter writer;
  describe(options, writer);
  return fmt::format("\n[{}]\n{}", key, writer.lines);
}

}  // namespace

void write_cell(const std::filesystem::path& file, const Cell& cell) {
  std::string text =
      fmt::format("name = {}\n\n[tracker]\nright_from_left = {}\n\n[tracker.left]\n{}\n[tracker.right]\n{}",
                  in_quotes(cell.name), text_of(cell.rig.right_from_left), text_of(cell.rig.left),
                  text_of(cell.rig.right));
  text += part("sensor", cell.sensor) + part("light", cell.light) + part("timing", cell.timing);
  for (const Mover& mover : cell.movers) text += text_of(mover);
  for (const Obstacle& obstacle : cell.obstacles) text += text_of(obstacle);
  write_file(file, text);
}

}  // namespace asterism
