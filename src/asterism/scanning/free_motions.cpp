// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/free_motions.hpp"

#include <fmt/format.h>

#include <cmath>

#include "asterism/geometry/symmetric_eigen.hpp"

namespace asterism {
namespace {

/// The same axis has two directions: the one whose largest component is positive is shown, −0 as 0.
std::string text_of_axis(Vec3 axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0) axis = -axis;
  const auto shown = [](double value) { return std::abs(value) < 0.005 ? 0.0 : value; };
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", shown(axis.x()), shown(axis.y()), shown(axis.z()));
}

std::string text_of_place(const Vec3& place) {
  const auto shown = [](double value) { return std::abs(value) < 0.5 ? 0.0 : value; };
  return fmt::format("({:.0f}, {:.0f}, {:.0f})", shown(place.x()), shown(place.y()), shown(place.z()));
}

}  // namespace

Determined determined_by(const Mat6& information, double reach_mm, double free_mm) {
  // In lengths at the rim: ω · reach.
  Vec6 scale;
  scale << Vec3::Constant(1 / reach_mm), Vec3::Ones();
  const SymmetricEigen6 eigen = symmetric_eigen6(Mat6(scale.asDiagonal() * information * scale.asDiagonal()));
  Determined determined;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Vec6 motion = scale.asDiagonal() * eigen.vectors.col(i);
    if (eigen.values[i] * free_mm * free_mm < 1) {
      determined.free.push_back(motion);
      continue;
    }
    const Vec6 back = scale.cwiseInverse().asDiagonal() * eigen.vectors.col(i);
    determined.inverse += motion * motion.transpose() / eigen.values[i];
    determined.projector += motion * back.transpose();
    ++determined.degrees;
  }
  return determined;
}

std::string words_of(const Vec6& motion, const Vec3& about, double reach_mm) {
  const Vec3 turn = motion.head<3>(), slide = motion.tail<3>();
  constexpr double kSmall = 0.1;
  if (turn.norm() * reach_mm < kSmall * slide.norm()) {
    return fmt::format("a slide along {}", text_of_axis(slide.normalized()));
  }
  const Vec3 axis = turn.normalized();
  const Vec3 through = about + turn.cross(slide) / turn.squaredNorm();
  const double along = std::abs(axis.dot(slide));
  return fmt::format("a turn about the axis {} through {}{}", text_of_axis(axis), text_of_place(through),
                     along > kSmall * turn.norm() * reach_mm ? ", with a slide along it" : "");
}

}  // namespace asterism
