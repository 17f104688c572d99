// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/hand_eye.hpp"

#include <cmath>

#include "asterism/geometry/linear_algebra.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFewest = 3;
constexpr double kLeastTurn_rad = 0.02;  // between two views
constexpr double kLeastAside = 1e-3;     // of the turns' second direction, as a share of the first's spread

/// A motion of the body and the scanner's motion it goes with: a X = X b.
struct Move {
  RigidMotion of_body, of_scanner;
};

std::vector<Move> moves_of(std::span<const HandEyeView> views) {
  std::vector<Move> moves;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) {
      moves.push_back({views[j].reference_from_body.inverse() * views[i].reference_from_body,
                       views[j].scanner_from_artefact * views[i].scanner_from_artefact.inverse()});
    }
  }
  return moves;
}

/// Park & Martin: α = R β for the rotation vectors of all moves, then (R_a − I) t = R t_b − t_a.
Result<RigidMotion, HandEyeFailure> start_of(const std::vector<Move>& moves) {
  Mat3 both = Mat3::Zero(), turns = Mat3::Zero();
  for (const Move& move : moves) {
    const Vec3 alpha = log_rotation(move.of_body.rotation), beta = log_rotation(move.of_scanner.rotation);
    both += alpha * beta.transpose();
    turns += alpha * alpha.transpose() / static_cast<double>(moves.size());
  }
  const SymmetricEigen3 spread = symmetric_eigen(turns);
  if (spread.values[2] < kLeastTurn_rad * kLeastTurn_rad) return because(HandEyeFailure::NoTurn);
  if (spread.values[1] < kLeastAside * spread.values[2]) return because(HandEyeFailure::OneAxis);
  const Svd3 parts = svd(both);
  Vec3 sign = Vec3::Ones();
  if ((parts.u * parts.v.transpose()).determinant() < 0) sign.z() = -1;
  const Quaternion rotation = quaternion_from_matrix(parts.u * sign.asDiagonal() * parts.v.transpose());
  Mat3 information = Mat3::Zero();
  Vec3 pull = Vec3::Zero();
  for (const Move& move : moves) {
    const Mat3 slope = move.of_body.rotation.toRotationMatrix() - Mat3::Identity();
    information += slope.transpose() * slope;
    pull += slope.transpose() * (rotation * move.of_scanner.translation - move.of_body.translation);
  }
  return RigidMotion{rotation, information.inverse() * pull};
}

/// Of a change of X (along the body's axes) on A X B.
Mat6 slope_of_scanner(const RigidMotion& reference_from_body, const RigidMotion& body_from_scanner,
                      const RigidMotion& scanner_from_artefact) {
  const Mat3 turn = reference_from_body.rotation.toRotationMatrix();
  Mat6 slope = Mat6::Zero();
  slope.topLeftCorner<3, 3>() = slope.bottomRightCorner<3, 3>() = turn;
  slope.bottomLeftCorner<3, 3>() =
      -turn * skew(body_from_scanner.rotation * scanner_from_artefact.translation);
  return slope;
}

}  // namespace

std::string text_of(HandEyeFailure failure) {
  switch (failure) {
    case HandEyeFailure::TooFewViews:
      return "three views at least are needed";
    case HandEyeFailure::NoTurn:
      return "all views have one attitude; turn the scanner between them";
    case HandEyeFailure::OneAxis:
      return "all turns are about one axis; turn the scanner about a second one";
  }
  return "";
}

Result<HandEye, HandEyeFailure> hand_eye(std::span<const HandEyeView> views) {
  if (views.size() < kFewest) return because(HandEyeFailure::TooFewViews);
  const auto start = start_of(moves_of(views));
  if (!start) return because(start.error());
  HandEye found;
  found.body_from_scanner = *start;
  RigidMotion& x = found.body_from_scanner;
  RigidMotion& y = found.reference_from_artefact;
  y = views[0].reference_from_body * x * views[0].scanner_from_artefact;
  constexpr int kSteps = 20;
  for (int step = 0; step < kSteps; ++step) {
    MatX information = MatX::Zero(12, 12);
    VecX pull = VecX::Zero(12);
    found.chi2 = found.rms_mm = found.rms_deg = 0;
    for (const HandEyeView& view : views) {
      const RigidMotion reference_from_scanner = view.reference_from_body * x;
      const Mat6 of_scanner = covariance_of_product(view.reference_from_body, view.of_body, x, Mat6::Zero());
      const Mat6 of_view = covariance_of_product(reference_from_scanner, of_scanner,
                                                 view.scanner_from_artefact, view.of_artefact);
      const Vec6 off = difference(reference_from_scanner * view.scanner_from_artefact, y);
      const auto weight = inverse_positive(of_view);
      require(weight.has_value(), "each view's poses have a covariance");
      MatX slope(6, 12);
      slope << slope_of_scanner(view.reference_from_body, x, view.scanner_from_artefact), -Mat6::Identity();
      information += slope.transpose() * *weight * slope;
      pull -= slope.transpose() * (*weight * off);
      found.chi2 += off.dot(*weight * off);
      found.rms_deg += std::pow(deg_from_rad(off.head<3>().norm()), 2) / static_cast<double>(views.size());
      found.rms_mm += off.tail<3>().squaredNorm() / static_cast<double>(views.size());
    }
    const auto way = solve_positive(information, pull);
    if (!way) return because(HandEyeFailure::OneAxis);
    x = perturbed(x, way->head<6>());
    y = perturbed(y, way->tail<6>());
    found.covariance = inverse_positive(information)->topLeftCorner<6, 6>();
    constexpr double kStill = 1e-12;
    if (way->norm() < kStill) break;
  }
  found.rms_mm = std::sqrt(found.rms_mm);
  found.rms_deg = std::sqrt(found.rms_deg);
  found.degrees = 6 * static_cast<double>(views.size()) - 12;
  return found;
}

}  // namespace asterism
