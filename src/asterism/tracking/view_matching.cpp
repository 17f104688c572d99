// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/view_matching.hpp"

#include <algorithm>
#include <cmath>

#include "asterism/camera/disc_image.hpp"

namespace asterism {
namespace {

const std::vector<Centre>& centres_of(const StereoCentres& centres, Side side) {
  return side == Side::Left ? centres.left : centres.right;
}

/// Where a pose puts a target in a camera; empty behind it or when turned away.
std::optional<ExpectedView> expected_view(const Body& body, int target, Side side, const StereoRig& rig,
                                          const PoseEstimate& pose, double smallest_cosine) {
  const Target& t = body.targets[static_cast<std::size_t>(target)];
  const RigidMotion camera_from_body = rig.camera_from_tracker(side) * pose.tracker_from_body;
  Disc disc{camera_from_body * t.position, Vec3::UnitZ(), t.imaged_radius_mm()};
  if (t.normal) {
    disc.normal = camera_from_body.rotation * *t.normal;
    if (-disc.normal.dot(disc.centre) < smallest_cosine * disc.centre.norm()) return std::nullopt;
  }
  const auto at = project_disc_centre(rig.lens(side), disc);
  if (!at) return std::nullopt;
  Mat36 tracker_by_pose;
  tracker_by_pose << -skew(pose.tracker_from_body.rotation * t.position), Mat3::Identity();
  const Mat3 camera_from_tracker = rig.camera_from_tracker(side).rotation.toRotationMatrix();
  const Mat26 by_pose = at->by_centre * camera_from_tracker * tracker_by_pose;
  ExpectedView view{target, side, {}, by_pose * pose.covariance * by_pose.transpose()};
  view.image.centre = at->px;
  if (disc.radius == 0) return view;
  const auto image = image_of_disc(rig.lens(side), disc);
  if (image) view.image = *image;
  return view;
}

/// Seen over expected size; 0 where either is not known.
double size_ratio(const Centre& seen, const Ellipse& expected) {
  const bool whole = (seen.flags & (kOccluded | kTouching | kBorder | kCoarse | kSmall)) == 0;
  return whole && expected.semi_major > 0 ? seen.ellipse.semi_major / expected.semi_major : 0.0;
}

bool size_fits(double ratio, double usual, double max_ratio) {
  return ratio == 0 || (ratio < max_ratio * usual && usual < max_ratio * ratio);
}

struct Match {
  std::size_t view, centre;
};

/// The one unused centre within the gate of where a target should be; none when there are two to choose from.
std::optional<std::size_t> only_candidate(const ExpectedView& expected, const std::vector<Centre>& centres,
                                          const std::vector<char>& used, double usual_size,
                                          const ViewOptions& options) {
  const Mat2 by_model = options.match_error_px * options.match_error_px * Mat2::Identity();
  const double gate = options.match_sigmas * options.match_sigmas;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (used[i] != 0) continue;
    const Vec2 off = centres[i].px() - expected.image.centre;
    const Mat2 spread = expected.covariance + centres[i].covariance + by_model;
    const double square = off.dot(spread.inverse() * off);
    // A second centre anywhere near makes the choice a guess.
    if (square > 4 * gate) continue;
    if (found) return std::nullopt;
    const bool fits = square <= gate && (centres[i].flags & kBorder) == 0 &&
                      size_fits(size_ratio(centres[i], expected.image), usual_size, options.max_size_ratio);
    if (!fits) return std::nullopt;
    found = i;
  }
  return found;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void describe(ViewOptions& options, OptionVisitor& visit) {
  visit.number("doubtful_sigma_px", options.doubtful_sigma_px, {0, 100},
               "added to a centre that is occluded, touched or coarse");
  visit.number("match_sigmas", options.match_sigmas, {0.1, 100},
               "how near to its place a target's centre must lie");
  visit.number("match_error_px", options.match_error_px, {0, 100},
               "what rig and body may add to that, one sigma");
  visit.number("max_size_ratio", options.max_size_ratio, {1, 100}, "of a disc's seen and expected size");
  visit.number("max_incidence_deg", options.max_incidence_deg, {0, 180},
               "discs turned further away are not looked for");
  visit.number("moved_reach_mm", options.moved_reach_mm, {0, 1000},
               "how far from its place a target that was knocked is looked for");
}

TargetView view_of(const Centre& centre, int target, Side side, const ViewOptions& options) {
  TargetView view{target, side, centre.px(), centre.covariance};
  if ((centre.flags & (kOccluded | kTouching | kCoarse)) != 0) {
    view.covariance += options.doubtful_sigma_px * options.doubtful_sigma_px * Mat2::Identity();
  }
  return view;
}

std::vector<ExpectedView> expected_views(const Body& body, const StereoRig& rig, const PoseEstimate& pose,
                                         const ViewOptions& options) {
  const double smallest_cosine = std::cos(rad_from_deg(options.max_incidence_deg));
  std::vector<ExpectedView> views;
  for (int target = 0; target < static_cast<int>(body.targets.size()); ++target) {
    for (const Side side : {Side::Left, Side::Right}) {
      const auto view = expected_view(body, target, side, rig, pose, smallest_cosine);
      if (!view) continue;
      const Lens& lens = rig.lens(side);
      const Vec2& at = view->image.centre;
      if (at.x() < 0 || at.y() < 0 || at.x() > lens.width_px - 1 || at.y() > lens.height_px - 1) continue;
      views.push_back(*view);
    }
  }
  return views;
}

std::vector<TargetView> labelled_views(const BodyLabels& labels, std::span<const Point> points,
                                       const StereoCentres& centres, const Body& body, const StereoRig& rig,
                                       const ViewOptions& options) {
  std::vector<TargetView> views;
  std::vector<double> ratios;
  const PoseEstimate pose{labels.tracker_from_body, Mat6::Zero()};
  for (const LabelledPoint& label : labels.points) {
    const Point& point = points[static_cast<std::size_t>(label.point)];
    for (const Side side : {Side::Left, Side::Right}) {
      const int index = side == Side::Left ? point.left : point.right;
      const Centre& centre = centres_of(centres, side)[static_cast<std::size_t>(index)];
      if ((centre.flags & kBorder) != 0) continue;
      views.push_back(view_of(centre, label.target, side, options));
      const auto expected = expected_view(body, label.target, side, rig, pose, -1.0);
      ratios.push_back(expected ? size_ratio(centre, expected->image) : 0.0);
    }
  }
  std::vector<double> known;
  std::copy_if(ratios.begin(), ratios.end(), std::back_inserter(known),
               [](double ratio) { return ratio > 0; });
  if (known.empty()) return views;
  const double usual = median(known);
  std::vector<TargetView> kept;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (size_fits(ratios[i], usual, options.max_size_ratio)) kept.push_back(views[i]);
  }
  return kept;
}

int add_matched_views(std::vector<TargetView>& views, const Body& body, const PoseEstimate& pose,
                      const StereoCentres& centres, CentreUse& use, const StereoRig& rig,
                      const ViewOptions& options) {
  const auto has_view = [&](int target, Side side) {
    return std::any_of(views.begin(), views.end(),
                       [&](const TargetView& view) { return view.target == target && view.side == side; });
  };
  const auto expected = expected_views(body, rig, pose, options);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [target, side, image, covariance] = expected[i];
    if (has_view(target, side)) continue;
    const auto candidate = only_candidate(expected[i], centres_of(centres, side), use.of(side), 1.0, options);
    if (candidate) matches.push_back({i, *candidate});
  }
  int added = 0;
  for (const Match& match : matches) {
    const Side side = expected[match.view].side;
    const auto same = [&](const Match& other) {
      return other.centre == match.centre && expected[other.view].side == side;
    };
    // A centre that two targets claim is left to neither.
    if (std::count_if(matches.begin(), matches.end(), same) > 1) continue;
    use.of(side)[match.centre] = 1;
    views.push_back(
        view_of(centres_of(centres, side)[match.centre], expected[match.view].target, side, options));
    ++added;
  }
  return added;
}

}  // namespace asterism
