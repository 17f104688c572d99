// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <initializer_list>
#include <span>
#include <variant>

#include "asterism/core/checksum.hpp"
#include "asterism/layout/layout_problem.hpp"

// What tells one layout problem from every other, so that a run is gone on with only where it belongs.

namespace asterism {
namespace {

using Q = LayoutQuantity;

/// A mark of everything that decides about the values.
class Mark {
 public:
  void add(double value) { sum_.add(value); }
  void add(std::initializer_list<double> values) { sum_.add(std::span(values)); }
  void add(const Vec3& vector) {
    for (int i = 0; i < 3; ++i) add(vector(i));
  }
  void add(const RigidMotion& motion) {
    add(motion.translation);
    for (int i = 0; i < 4; ++i) add(motion.rotation.coeffs()(i));
  }
  void add(const std::vector<Target>& targets) {
    for (const Target& target : targets) add(target.position);
    add(static_cast<double>(targets.size()));
  }
  [[nodiscard]] std::uint64_t value() const { return sum_.value(); }

 private:
  Checksum sum_;
};

/// Adds each number of options to a mark.
class MarkOptions : public OptionVisitor {
 public:
  explicit MarkOptions(Mark& mark) : mark_(mark) {}
  void number(std::string_view, double& value, Limits, std::string_view) override { mark_.add(value); }
  void integer(std::string_view, int& value, Limits, std::string_view) override { mark_.add(value); }
  void flag(std::string_view, bool& value, std::string_view) override { mark_.add(value ? 1.0 : 0.0); }
  void text(std::string_view, std::string& value, std::string_view) override {
    for (const char c : value) mark_.add(static_cast<double>(c));
  }
  void choice(std::string_view, int& index, const std::vector<std::string>&, std::string_view) override {
    mark_.add(index);
  }

 private:
  Mark& mark_;
};

void mark_shape(const Patch& patch, Mark& mark) {
  struct Of {
    Mark& mark;
    void operator()(const CylinderSide& p) const {
      mark.add(p.base_mm);
      mark.add({p.radius_mm, p.height_mm, p.from_rad, p.to_rad});
    }
    void operator()(const Annulus& p) const {
      mark.add(p.centre_mm);
      mark.add({p.inner_radius_mm, p.outer_radius_mm, p.from_rad, p.to_rad});
    }
    void operator()(const Plate& p) const {
      mark.add(p.body_from_plate);
      mark.add({p.width_mm, p.height_mm});
    }
    void operator()(const CylinderRoom& p) const {
      mark.add(p.base_mm);
      mark.add({p.radius_mm, p.height_mm, p.tilt_rad});
    }
  };
  mark.add(static_cast<double>(patch.index()));
  std::visit(Of{mark}, patch);
}

void mark_shape(const Shape& shape, Mark& mark) {
  struct Of {
    Mark& mark;
    void operator()(const Box& s) const { mark.add(s.size_mm); }
    void operator()(const Capsule& s) const {
      mark.add(s.from_mm);
      mark.add(s.to_mm);
      mark.add(s.radius_mm);
    }
    void operator()(const Frustum& s) const { mark.add({s.bottom_radius_mm, s.top_radius_mm, s.height_mm}); }
  };
  mark.add(static_cast<double>(shape.index()));
  std::visit(Of{mark}, shape);
}

void mark_surface(const DeployableSurface& surface, Mark& mark) {
  for (const NamedPatch& one : surface.patches) mark_shape(one.patch, mark);
  for (const KeepOut& one : surface.keep_outs) {
    mark_shape(one.shape, mark);
    mark.add(one.body_from_shape);
  }
}

void mark_lens(const Lens& lens, Mark& mark) {
  mark.add({lens.fx, lens.fy, lens.skew, lens.cx, lens.cy});
  for (const double coefficient : lens.distortion) mark.add(coefficient);
  mark.add(lens.coefficients);
  mark.add(lens.width_px);
  mark.add(lens.height_px);
}

}  // namespace

std::string LayoutProblem::identity() const {
  const LayoutModel& model = *model_;
  std::string text = "layout of " + model.task.body + ":";
  for (const Q quantity : model.objectives) text += " " + info_of(quantity).name;
  for (const LayoutConstraint& constraint : model.constraints) {
    text += fmt::format(", {} {}", info_of(constraint.quantity).name, constraint.bound);
  }
  Mark mark;
  MarkOptions mark_options(mark);
  LayoutTask task = model.task;
  VisibilityOptions visibility = model.options.visibility;
  AccuracyOptions accuracy = model.options.accuracy;
  describe(task, mark_options);
  describe(visibility, mark_options);
  describe(accuracy, mark_options);
  OcclusionOptions occlusion = model.options.occlusion;
  describe(occlusion, mark_options);
  mark.add(static_cast<double>(model.occluders_mark >> 32));
  mark.add(static_cast<double>(model.occluders_mark & 0xFFFFFFFF));
  mark.add(identifiability_cap_mm_);
  mark_surface(model.rules.surface, mark);
  mark.add(model.rules.spacing_mm);
  for (const auto& poses : model.cell_poses) {
    for (const RigidMotion& pose : poses) mark.add(pose);
  }
  mark.add(model.motion.rig.right_from_left);
  mark_lens(model.motion.rig.left, mark);
  mark_lens(model.motion.rig.right, mark);
  if (model.volume) {
    WorkingVolume volume = *model.volume;
    describe(volume, mark_options);
  }
  for (const Vec3& point : model.points) mark.add(point);
  mark.add(model.present);
  for (const Body& other : model.others) mark.add(other.targets);
  return fmt::format("{}; {} to {} targets; {:016x}", text, model.rules.fewest, model.rules.most,
                     mark.value());
}

}  // namespace asterism
