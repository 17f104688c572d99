// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/cell_text.hpp"

#include <fmt/format.h>

namespace asterism {
namespace {

std::string lines_of(const Box& box) {
  return fmt::format("shape = \"box\"\nsize_mm = {}\n", toml_of(box.size_mm));
}
std::string lines_of(const Capsule& capsule) {
  return fmt::format("shape = \"capsule\"\nfrom_mm = {}\nto_mm = {}\nradius_mm = {}\n",
                     toml_of(capsule.from_mm), toml_of(capsule.to_mm), capsule.radius_mm);
}
std::string lines_of(const Frustum& cone) {
  return fmt::format("shape = \"frustum\"\nbottom_radius_mm = {}\ntop_radius_mm = {}\nheight_mm = {}\n",
                     cone.bottom_radius_mm, cone.top_radius_mm, cone.height_mm);
}

}  // namespace

std::string toml_of(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

std::string toml_of(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string toml_of(const RigidMotion& pose) {
  const Quaternion& q = pose.rotation;
  return fmt::format("{{position_mm = {}, quaternion_wxyz = [{}, {}, {}, {}]}}", toml_of(pose.translation),
                     q.w(), q.x(), q.y(), q.z());
}

std::string toml_of(const Shape& shape) {
  return std::visit([](const auto& one) { return lines_of(one); }, shape);
}

}  // namespace asterism
