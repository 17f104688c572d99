// SPDX-License-Identifier: Apache-2.0
#include "asterism/scanning/registration.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/geometry/symmetric_eigen.hpp"
#include "asterism/scanning/free_motions.hpp"
#include "asterism/statistics/distributions.hpp"

namespace asterism {
namespace {

constexpr std::size_t kFewestPairs = 50;
constexpr int kSteps = 12;
constexpr double kSameFacing = 0.95;  // at edges a plane says nothing of the place beside it
constexpr double kAlike = 10;         // pairs that lie together share planes: so many count as one
constexpr double kFar = 3.5;          // robust standard deviations; pairs beyond do not count

/// The plane found for a spot, once that was moved, and how far the spot lies off it. Its lever is told at
/// the plane's own place: at the spot's, which lies a little aside, a cylinder would seem to determine its
/// turn.
struct Pair {
  Vec3 at, normal;
  double off_mm, variance_mm2;
};

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<Pair> pairs_of(std::span<const SurfaceSpot> scan, const FindSpot& find, const RigidMotion& moved,
                           const RegistrationOptions& options) {
  std::vector<std::optional<Pair>> found(scan.size());
  constexpr std::size_t kBlock = 256;
  parallel_for((scan.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(scan.size(), (block + 1) * kBlock); ++i) {
      const SurfaceSpot spot{moved * scan[i].at, moved.rotation * scan[i].normal, scan[i].variance_mm2};
      const auto other = find(spot);
      if (!other || other->normal.dot(spot.normal) < kSameFacing) continue;
      const double off = other->normal.dot(spot.at - other->at);
      if (std::abs(off) > options.within_mm) continue;
      found[i] = Pair{other->at, other->normal, off, spot.variance_mm2 + other->variance_mm2};
    }
  });
  std::vector<Pair> pairs;
  std::vector<double> sizes;
  for (const auto& pair : found) {
    if (!pair) continue;
    pairs.push_back(*pair);
    sizes.push_back(pair->off_mm);
  }
  if (pairs.size() < kFewestPairs) return {};
  const double middle = median_of(sizes);
  for (double& size : sizes) size = std::abs(size - middle);
  const double spread = median_of(sizes) / normal_quantile(0.75);
  std::erase_if(pairs,
                [&](const Pair& pair) { return std::abs(pair.off_mm - middle) > kFar * spread + 1e-9; });
  return pairs;
}

/// What pairs ask of a motion about a place.
struct Asked {
  Mat6 information = Mat6::Zero();
  Vec6 pull = Vec6::Zero();
  double chi2 = 0, square_mm2 = 0;
};
Asked asked_by(const std::vector<Pair>& pairs, const Vec3& about) {
  Asked asked;
  for (const Pair& pair : pairs) {
    Vec6 slope;
    slope << (pair.at - about).cross(pair.normal), pair.normal;
    asked.information += slope * slope.transpose() / pair.variance_mm2;
    asked.pull -= slope * pair.off_mm / pair.variance_mm2;
    asked.chi2 += pair.off_mm * pair.off_mm / pair.variance_mm2;
    asked.square_mm2 += pair.off_mm * pair.off_mm;
  }
  return asked;
}

RigidMotion motion_about(const Vec6& motion, const Vec3& about) {
  RigidMotion turn = rotation_about(about, exp_rotation(motion.head<3>()));
  turn.translation += motion.tail<3>();
  return turn;
}

/// Covariance of a motion told at another place.
Mat6 carried_to(const Mat6& covariance, const Vec3& from, const Vec3& to) {
  Mat6 jacobian = Mat6::Identity();
  jacobian.bottomLeftCorner<3, 3>() = -skew(to - from);
  return jacobian * covariance * jacobian.transpose();
}

/// Weighs what the shape asks for against the tracked pose: the best of both, and how well they agree.
void weigh(Registration& found, const Determined& determined, double scale, const Mat6& pose,
           const Mat6& others, const RegistrationOptions& options) {
  // Only along what the shape determines, in its own coordinates: m = B z.
  const SymmetricEigen6 eigen = symmetric_eigen6(determined.inverse);
  MatX basis(6, determined.degrees);
  for (int i = 0; i < determined.degrees; ++i) basis.col(i) = eigen.vectors.col(5 - i);
  const MatX onto = (basis.transpose() * basis).inverse() * basis.transpose() * MatX(determined.projector);
  const VecX asked = onto * found.by_shape;
  const MatX of_shape = onto * MatX(scale * determined.inverse + others) * onto.transpose();
  const MatX of_pose = onto * MatX(pose) * onto.transpose();
  const double least = 1e-18;
  const MatX both = of_shape + of_pose + least * MatX::Identity(determined.degrees, determined.degrees);
  const auto inverse = inverse_positive(both);
  if (!inverse) return;
  found.chi2 = asked.dot(*inverse * asked);
  const MatX gain = MatX(pose) * onto.transpose() * *inverse;  // of a measurement z of the pose's error
  found.correction = gain * asked;
  found.covariance = pose - Mat6(gain * onto * MatX(pose));
  const bool rare = chi_square_tail(found.chi2, found.degrees) < options.flag_p;
  const bool large = found.shift_mm > options.least_mm || found.turn_deg > options.least_deg;
  found.disagrees = rare && large && found.before_mm > options.least_gain * found.rms_mm;
}

}  // namespace

void describe(RegistrationOptions& options, OptionVisitor& visit) {
  visit.number("within_mm", options.within_mm, {1e-3, 1e4},
               "farther apart, two places do not belong together");
  visit.number("free_mm", options.free_mm, {1e-6, 1e4}, "a motion that the shape tells worse is not judged");
  visit.number("flag_p", options.flag_p, {0, 0.5},
               "a scan is flagged when its disagreement is rarer than this");
  visit.number("least_mm", options.least_mm, {0, 1e4}, "and larger than this,");
  visit.number("least_deg", options.least_deg, {0, 180}, "or turned by more than this");
  visit.number("least_gain", options.least_gain, {1, 1000},
               "and the shapes lie so many times closer after it");
  visit.integer("most_spots", options.most_spots, {100, 1000000}, "places of one scan that are compared");
}

Result<Registration, RegistrationFailure> register_scan(std::span<const SurfaceSpot> scan,
                                                        const FindSpot& find, const Mat6& pose,
                                                        const Mat6& others, const Vec3& origin,
                                                        const RegistrationOptions& options) {
  std::vector<Pair> pairs = pairs_of(scan, find, {}, options);
  if (pairs.empty()) return because(RegistrationFailure::TooFewPairs);
  Registration found;
  for (const Pair& pair : pairs) found.about += pair.at / static_cast<double>(pairs.size());
  for (const Pair& pair : pairs) found.reach_mm = std::max(found.reach_mm, (pair.at - found.about).norm());
  const Asked tracked = asked_by(pairs, found.about);
  found.before_mm = std::sqrt(tracked.square_mm2 / static_cast<double>(pairs.size()));
  Determined determined;
  RigidMotion moved;
  for (int step = 0; step < kSteps; ++step) {
    const Asked asked = asked_by(pairs, found.about);
    determined = determined_by(Mat6(asked.information / kAlike), found.reach_mm, options.free_mm);
    determined.inverse /= kAlike;
    const Vec6 way = determined.inverse * asked.pull;
    const double moved_mm = way.head<3>().norm() * found.reach_mm + way.tail<3>().norm();
    moved = motion_about(way, found.about) * moved;
    constexpr double kStill_mm = 1e-4;
    std::vector<Pair> next = pairs_of(scan, find, moved, options);
    if (next.empty()) return because(RegistrationFailure::TooFewPairs);
    pairs = std::move(next);
    if (moved_mm < kStill_mm) break;
  }
  const Asked left = asked_by(pairs, found.about);
  found.pairs = pairs.size();
  found.rms_mm = std::sqrt(left.square_mm2 / static_cast<double>(pairs.size()));
  found.by_shape << log_rotation(moved.rotation), moved * found.about - found.about;
  found.turn_deg = deg_from_rad(found.by_shape.head<3>().norm());
  found.shift_mm = found.by_shape.tail<3>().norm();
  found.degrees = determined.degrees;
  for (const Vec6& motion : determined.free)
    found.free.push_back(words_of(motion, found.about, found.reach_mm));
  if (determined.degrees == 0) return found;
  // Rough surfaces, and planes that stand for curved ones, spread more than the noise.
  weigh(found, determined, kAlike * std::max(1.0, left.chi2 / static_cast<double>(pairs.size())),
        carried_to(pose, origin, found.about), carried_to(others, origin, found.about), options);
  return found;
}

Mat6 covariance_at(const Registration& registration, const Vec3& place) {
  return carried_to(registration.covariance, registration.about, place);
}

RigidMotion motion_of(const Registration& registration) {
  return motion_about(registration.correction, registration.about);
}

}  // namespace asterism
