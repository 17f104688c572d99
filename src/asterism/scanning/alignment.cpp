// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/rigid_fit.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr int kSteps = 20;
constexpr double kStill = 1e-12;  // rad and mm: no further step

/// Where residuals say that points are known worse than stated, the covariance grows with them.
void hold_against_residuals(Alignment& alignment) {
  constexpr double kRare = 0.001;
  if (alignment.degrees < 1 || chi_square_tail(alignment.chi2, alignment.degrees) > kRare) return;
  alignment.covariance *= alignment.chi2 / alignment.degrees;
}

double rms_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// Probed and nominal points in pairs, by name.
std::vector<Vec3> nominal_of(std::span<const ProbedPoint> probed, std::span<const NominalPoint> nominal) {
  std::map<std::string, Vec3> by_name;
  for (const NominalPoint& point : nominal) by_name[point.name] = point.in_workpiece;
  std::set<std::string> seen;
  std::vector<Vec3> places;
  for (const ProbedPoint& point : probed) {
    const auto found = by_name.find(point.name);
    if (found == by_name.end())
      throw InputError("alignment", fmt::format("no nominal point is called `{}`", point.name));
    if (!seen.insert(point.name).second) {
      throw InputError("alignment", fmt::format("point `{}` is probed twice; give the mean", point.name));
    }
    places.push_back(found->second);
  }
  return places;
}

/// What a plane's points ask of a small motion of the part, told in its own frame: x' = x − ω × x − δ.
Eigen::Matrix<double, 1, 6> slope_of(const Vec3& normal, const Vec3& in_workpiece) {
  Eigen::Matrix<double, 1, 6> slope;
  slope << -in_workpiece.cross(normal).transpose(), -normal.transpose();
  return slope;
}

/// A motion (ω, δ) in the part's frame, as an error along the platform's axes.
Mat6 platform_axes(const Quaternion& platform_from_workpiece) {
  Mat6 turn = Mat6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = platform_from_workpiece.toRotationMatrix();
  return turn;
}

/// One datum plane with what belongs to it: its points, and the motions of the part it settles.
struct Datum {
  std::string name;
  NominalPlane plane;
  std::size_t needed;
  std::vector<const ProbedPoint*> points;
  std::vector<Vec6> settles;
};

std::vector<Datum> datums_of(std::span<const ProbedPoint> probed, const DatumPlanes& planes) {
  std::vector<Datum> datums = {{"primary", planes.primary, 3, {}, {}},
                               {"secondary", planes.secondary, 2, {}, {}},
                               {"tertiary", planes.tertiary, 1, {}, {}}};
  for (const ProbedPoint& point : probed) {
    const auto datum =
        std::find_if(datums.begin(), datums.end(), [&](const Datum& d) { return d.name == point.name; });
    if (datum == datums.end()) {
      throw InputError(
          "alignment",
          fmt::format("`{}` is no datum plane; primary, secondary or tertiary is needed", point.name));
    }
    datum->points.push_back(&point);
  }
  for (Datum& datum : datums) {
    datum.plane.normal.normalize();
    if (datum.points.size() >= datum.needed) continue;
    throw InputError("alignment", fmt::format("the {} plane needs {} points at least; there are {}",
                                              datum.name, datum.needed, datum.points.size()));
  }
  const Vec3 first = datums[0].plane.normal;
  const Vec3 beside = datums[1].plane.normal - first.dot(datums[1].plane.normal) * first;
  const Vec3 last = first.cross(beside);
  constexpr double kApart = 0.05;
  if (beside.norm() < kApart || std::abs(last.normalized().dot(datums[2].plane.normal)) < kApart) {
    throw InputError("alignment",
                     "the datum planes leave a motion free: their normals must point in three directions");
  }
  const Vec3 e2 = beside.normalized(), e3 = last.normalized();
  const auto motion = [](const Vec3& turn, const Vec3& slide) {
    Vec6 m;
    m << turn, slide;
    return m;
  };
  const Vec3 none = Vec3::Zero();
  datums[0].settles = {motion(e2, none), motion(e3, none), motion(none, first)};
  datums[1].settles = {motion(first, none), motion(none, e2)};
  datums[2].settles = {motion(none, e3)};
  return datums;
}

Vec3 mean_of(const std::vector<const ProbedPoint*>& points) {
  Vec3 mean = Vec3::Zero();
  for (const ProbedPoint* point : points) mean += point->in_platform;
  return mean / static_cast<double>(points.size());
}

/// The part lies behind its datum planes, so the other planes' points tell the first normal's side.
RigidMotion start_of(const std::vector<Datum>& datums) {
  const std::vector<const ProbedPoint*>& first = datums[0].points;
  const Vec3 at = mean_of(first);
  Mat3 spread = Mat3::Zero();
  for (const ProbedPoint* point : first)
    spread += (point->in_platform - at) * (point->in_platform - at).transpose();
  const SymmetricEigen3 eigen = symmetric_eigen(spread);
  constexpr double kWide = 1e-4;
  if (eigen.values[1] < kWide * eigen.values[2]) {
    throw InputError("alignment", "the points of the primary plane lie on a line; spread them");
  }
  Vec3 e1 = eigen.vectors.col(0);
  const Vec3 inner = 0.5 * (mean_of(datums[1].points) + mean_of(datums[2].points));
  if (e1.dot(inner - at) > 0) e1 = -e1;
  const Vec3 line = datums[1].points.back()->in_platform - datums[1].points.front()->in_platform;
  Vec3 e2 = e1.cross(line);
  if (e2.norm() < 1e-6 * line.norm() || line.norm() == 0) {
    throw InputError("alignment",
                     "the points of the secondary plane lie above each other; spread them along the part");
  }
  e2.normalize();
  const Vec3 others = 0.5 * (at + mean_of(datums[2].points));
  if (e2.dot(others - mean_of(datums[1].points)) > 0) e2 = -e2;
  Mat3 platform, workpiece;
  platform << e1, e2, e1.cross(e2);
  const Vec3 w1 = datums[0].plane.normal;
  const Vec3 w2 = datums[1].settles[1].tail<3>();
  workpiece << w1, w2, w1.cross(w2);
  const Quaternion turn = quaternion_from_matrix(platform * workpiece.transpose());
  return {turn, at - turn * datums[0].plane.at};
}

}  // namespace

Alignment align_points(std::span<const ProbedPoint> probed, std::span<const NominalPoint> nominal) {
  const std::vector<Vec3> in_workpiece = nominal_of(probed, nominal);
  std::vector<Vec3> in_platform;
  for (const ProbedPoint& point : probed) in_platform.push_back(point.in_platform);
  const auto start = fit_rigid_motion(in_platform, in_workpiece);
  if (!start) {
    throw InputError("alignment",
                     start.error() == RigidFitFailure::TooFewPoints
                         ? fmt::format("three points at least are needed; there are {}", probed.size())
                         : "the points lie on a line; spread them");
  }
  Alignment alignment;
  alignment.method = "points";
  alignment.points = probed.size();
  RigidMotion& pose = alignment.platform_from_workpiece = start->a_from_b;
  for (int step = 0; step < kSteps; ++step) {
    Mat6 information = Mat6::Zero();
    Vec6 pull = Vec6::Zero();
    for (std::size_t i = 0; i < probed.size(); ++i) {
      Mat36 slope;
      slope << -skew(pose.rotation * in_workpiece[i]), Mat3::Identity();
      const Mat3 weight = probed[i].covariance.inverse();
      information += slope.transpose() * weight * slope;
      pull += slope.transpose() * weight * (probed[i].in_platform - pose * in_workpiece[i]);
    }
    alignment.covariance = *inverse_positive(information);
    const Vec6 way = alignment.covariance * pull;
    pose = perturbed(pose, way);
    if (way.norm() < kStill) break;
  }
  for (std::size_t i = 0; i < probed.size(); ++i) {
    const Vec3 off = probed[i].in_platform - pose * in_workpiece[i];
    alignment.residuals_mm.push_back(off.norm());
    alignment.chi2 += off.dot(probed[i].covariance.inverse() * off);
  }
  alignment.degrees = 3 * static_cast<double>(probed.size()) - 6;
  alignment.rms_mm = rms_of(alignment.residuals_mm);
  hold_against_residuals(alignment);
  return alignment;
}

Alignment align_3_2_1(std::span<const ProbedPoint> probed, const DatumPlanes& planes, double ball_mm) {
  const std::vector<Datum> datums = datums_of(probed, planes);
  Alignment alignment;
  alignment.method = "3-2-1";
  alignment.points = probed.size();
  RigidMotion& pose = alignment.platform_from_workpiece = start_of(datums);
  const auto count = static_cast<Eigen::Index>(probed.size());
  MatX told;      // the motion by each point's residual
  VecX residual;  // in the order of the datums
  VecX variance(count);
  for (int step = 0; step < kSteps; ++step) {
    told = MatX::Zero(6, count);
    residual.resize(count);
    Eigen::Index row = 0;
    for (const Datum& datum : datums) {
      const auto points = static_cast<Eigen::Index>(datum.points.size());
      MatX slopes(points, 6), settles(6, static_cast<Eigen::Index>(datum.settles.size()));
      for (std::size_t k = 0; k < datum.settles.size(); ++k)
        settles.col(static_cast<Eigen::Index>(k)) = datum.settles[k];
      for (Eigen::Index i = 0; i < points; ++i) {
        const ProbedPoint& point = *datum.points[static_cast<std::size_t>(i)];
        const Vec3 at = pose.inverse() * point.in_platform;
        slopes.row(i) = slope_of(datum.plane.normal, at);
        residual[row + i] = datum.plane.normal.dot(at - datum.plane.at) - ball_mm;
        const Vec3 normal = pose.rotation * datum.plane.normal;
        variance[row + i] = normal.dot(point.covariance * normal);
      }
      // What earlier planes settled stays; this one settles its own motions of what is left.
      const MatX own = slopes * settles;
      MatX asked = -slopes * told;
      for (Eigen::Index i = 0; i < points; ++i) asked(i, row + i) -= 1;
      const auto inverse = inverse_positive(MatX(own.transpose() * own));
      if (!inverse)
        throw InputError(
            "alignment",
            fmt::format("the points of the {} plane leave a motion free; spread them", datum.name));
      told += settles * (*inverse * own.transpose() * asked);
      row += points;
    }
    const Vec6 way = told * residual;
    pose = pose * RigidMotion{exp_rotation(way.head<3>()), way.tail<3>()};
    if (way.norm() < kStill) break;
  }
  const Mat6 turn = platform_axes(pose.rotation);
  alignment.covariance = turn * Mat6(told * variance.asDiagonal() * told.transpose()) * turn.transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    alignment.residuals_mm.push_back(residual[i]);
    alignment.chi2 += residual[i] * residual[i] / variance[i];
  }
  alignment.degrees = static_cast<double>(count) - 6;
  alignment.rms_mm = rms_of(alignment.residuals_mm);
  hold_against_residuals(alignment);
  return alignment;
}

}  // namespace asterism
