// SPDX-License-Identifier: Apache-2.0
#include "asterism/tracking/tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/core/parallel.hpp"
#include "asterism/statistics/distributions.hpp"
#include "asterism/tracking/refused_targets.hpp"

namespace asterism {
namespace {

// Views found by a prediction alone were chosen to fit it; this much must be left over to contradict them.
constexpr int kRedundancyOfPrediction = 4;
// Of refusing a PARTIAL pose that fits as well as its body's poses usually do.
constexpr double kUnusual = 1e-4;
// A window larger than this finds no less by searching the whole image.
constexpr double kLargestWindow_px = 200;

StereoCentres detect(const StereoImage& image, const std::vector<SearchWindow>* left,
                     const std::vector<SearchWindow>* right, const DetectionOptions& options) {
  StereoCentres centres{image.frame, image.time_s, {}, {}};
  parallel_for(2, [&](std::size_t side) {
    const auto& picture = side == 0 ? image.left : image.right;
    const auto* windows = side == 0 ? left : right;
    auto& found = side == 0 ? centres.left : centres.right;
    if (!picture) return;
    found = windows ? detect_targets(*picture, *windows, options) : detect_targets(*picture, options);
  });
  return centres;
}

int targets_in_both(std::span<const TargetView> views, const std::vector<int>& rejected) {
  std::vector<int> left, right;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (std::binary_search(rejected.begin(), rejected.end(), static_cast<int>(i))) continue;
    (views[i].side == Side::Left ? left : right).push_back(views[i].target);
  }
  return static_cast<int>(std::count_if(left.begin(), left.end(), [&](int target) {
    return std::find(right.begin(), right.end(), target) != right.end();
  }));
}

int targets_in_any(std::span<const TargetView> views, const std::vector<int>& rejected) {
  std::vector<int> seen;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!std::binary_search(rejected.begin(), rejected.end(), static_cast<int>(i)))
      seen.push_back(views[i].target);
  }
  std::sort(seen.begin(), seen.end());
  return static_cast<int>(std::unique(seen.begin(), seen.end()) - seen.begin());
}

BodyPose body_pose(std::size_t body, const PoseSolution& solution, std::span<const TargetView> views) {
  const bool full = targets_in_both(views, solution.rejected) >= 4;
  return {static_cast<int>(body), full ? PoseStatus::Ok : PoseStatus::Partial, solution.estimate,
          targets_in_any(views, solution.rejected), solution.rms_px};
}

/// Is a pose where the prediction said it would be?
bool fits(const PoseEstimate& pose, const PoseEstimate& predicted, double gate_probability) {
  const Vec6 off = difference(pose.tracker_from_body, predicted.tracker_from_body);
  const auto solved = solve_positive(Mat6(pose.covariance + predicted.covariance), off);
  return solved && off.dot(*solved) < chi_square_quantile(1 - gate_probability, 6);
}

}  // namespace

void describe(TrackerOptions& options, OptionVisitor& visit) {
  const auto section = [&](std::string_view name, auto& part) {
    SectionVisitor visitor(name, visit);
    describe(part, visitor);
  };
  section("detection", options.detection);
  section("triangulation", options.triangulation);
  section("identification", options.identification);
  section("views", options.views);
  section("pose", options.pose);
  section("filter", options.filter);
  visit.integer(
      "full_search_interval", options.full_search_interval, {1, 1000000},
      "frames between searches of the whole image; between, tracked bodies are looked for in windows");
  visit.number("window_margin_px", options.window_margin_px, {0, 1000}, "about where a target should be");
}

Tracker::Tracker(StereoRig rig, std::vector<Body> bodies, TrackerOptions options)
    : rig_(std::move(rig)), catalogue_(std::move(bodies), options.identification), options_(options) {
  check_rig(rig_, "rig");
  for (std::size_t body = 0; body < catalogue_.bodies().size(); ++body)
    filters_.emplace_back(options_.filter);
  misfit_.assign(filters_.size(), 0.0);
  usual_misfit_ = misfit_;
}

TrackedFrame Tracker::process(const StereoImage& image) {
  check_time(image.frame, image.time_s);
  check_size(image);
  const Predictions predicted = predictions(image.time_s);
  if (++since_full_search_ < options_.full_search_interval) {
    if (const auto near = windows(predicted)) {
      TrackedFrame frame = measure(detect(image, &near->left, &near->right, options_.detection), predicted);
      if (covered(frame, *near)) return over_time(std::move(frame));
    }
  }
  since_full_search_ = 0;
  return over_time(measure(detect(image, nullptr, nullptr, options_.detection), predicted));
}

TrackedFrame Tracker::process(StereoCentres centres) {
  check_time(centres.frame, centres.time_s);
  const Predictions predicted = predictions(centres.time_s);
  return over_time(measure(std::move(centres), predicted));
}

TrackedFrame Tracker::measure(StereoCentres centres, const Predictions& predicted) {
  TrackedFrame frame;
  frame.centres = std::move(centres);
  frame.points = triangulate(frame.centres.left, frame.centres.right, rig_, options_.triangulation);

  std::vector<std::optional<PriorPose>> priors(predicted.size());
  for (std::size_t body = 0; body < predicted.size(); ++body) {
    if (predicted[body])
      priors[body] = PriorPose{predicted[body]->tracker_from_body, predicted[body]->covariance};
  }
  frame.labels = identify(frame.points, catalogue_, options_.identification, priors);

  CentreUse use(frame.centres);
  for (const BodyLabels& labels : frame.labels) {
    for (const LabelledPoint& label : labels.points) {
      const Point& point = frame.points[static_cast<std::size_t>(label.point)];
      use.left[static_cast<std::size_t>(point.left)] = 1;
      use.right[static_cast<std::size_t>(point.right)] = 1;
    }
  }
  for (std::size_t body = 0; body < bodies().size(); ++body) {
    frame.poses.push_back(measure_body(body, frame, predicted, use));
  }
  return frame;
}

BodyPose Tracker::measure_body(std::size_t body, const TrackedFrame& frame, const Predictions& predicted,
                               CentreUse& use) {
  const Body& shape = bodies()[body];
  const auto labels = std::find_if(frame.labels.begin(), frame.labels.end(),
                                   [&](const BodyLabels& l) { return l.body == static_cast<int>(body); });
  const bool found = labels != frame.labels.end();
  if (found && labels->status == LabelStatus::Ambiguous)
    return {static_cast<int>(body), PoseStatus::Ambiguous, {}, 0, 0};

  std::vector<TargetView> views;
  if (found) {
    views = labelled_views(*labels, frame.points, frame.centres, shape, rig_, options_.views);
  } else if (predicted[body]) {
    add_matched_views(views, shape, *predicted[body], frame.centres, use, rig_, options_.views);
  }
  if (views.empty()) return {static_cast<int>(body), PoseStatus::Lost, {}, 0, 0};
  const RigidMotion& start = found ? labels->tracker_from_body : predicted[body]->tracker_from_body;
  auto solution = estimate_pose(shape, views, rig_, start, options_.pose);
  if (!solution) {
    ++failures_[static_cast<std::size_t>(solution.error())];
    const bool twofold = solution.error() == PoseFailure::Ambiguous;
    return {static_cast<int>(body), twofold ? PoseStatus::Ambiguous : PoseStatus::Lost, {}, 0, 0};
  }

  // With a pose, the targets that one camera alone sees can be told.
  std::vector<TargetView> more = views;
  if (add_matched_views(more, shape, solution->estimate, frame.centres, use, rig_, options_.views) > 0) {
    const auto better = estimate_pose(shape, more, rig_, solution->estimate.tracker_from_body, options_.pose);
    if (better) {
      solution = better;
      views = std::move(more);
    }
  }
  const bool trusted =
      found || (solution->degrees_of_freedom >= kRedundancyOfPrediction &&
                fits(solution->estimate, *predicted[body], options_.filter.gate_probability));
  if (!trusted) return {static_cast<int>(body), PoseStatus::Lost, {}, 0, 0};
  BodyPose pose = body_pose(body, *solution, views);
  if (pose.status == PoseStatus::Partial && !fits_as_usual(body, *solution)) {
    ++failures_[static_cast<std::size_t>(PoseFailure::Inconsistent)];
    return {static_cast<int>(body), PoseStatus::Lost, {}, 0, 0};
  }
  pose.rejected = refused_targets(shape, {views, solution->rejected}, solution->estimate, frame.points, use,
                                  options_.views);
  misfit_[body] = solution->chi_square / solution->degrees_of_freedom;
  return pose;
}

/// Few targets leave little to contradict a wrong one. How well this rig and this body fit when all is well
/// is known from the frames before; a PARTIAL pose must not fit much worse.
bool Tracker::fits_as_usual(std::size_t body, const PoseSolution& solution) const {
  if (usual_misfit_[body] == 0) return true;
  const double scale = std::max(1.0, usual_misfit_[body]);
  return solution.chi_square / scale < chi_square_quantile(1 - kUnusual, solution.degrees_of_freedom);
}

TrackedFrame Tracker::over_time(TrackedFrame frame) {
  for (std::size_t body = 0; body < filters_.size(); ++body) {
    frame.filtered.push_back(filters_[body].update(frame.centres.time_s, frame.poses[body]));
    if (frame.poses[body].status != PoseStatus::Ok) continue;
    double& usual = usual_misfit_[body];
    usual = usual == 0 ? misfit_[body] : 0.9 * usual + 0.1 * misfit_[body];
  }
  last_frame_ = frame.centres.frame;
  last_time_s_ = frame.centres.time_s;
  return frame;
}

Tracker::Predictions Tracker::predictions(double time_s) const {
  Predictions predicted;
  for (const PoseFilter& filter : filters_) predicted.push_back(filter.predict(time_s));
  return predicted;
}

std::optional<Tracker::Windows> Tracker::windows(const Predictions& predicted) const {
  if (predicted.empty()) return std::nullopt;
  Windows windows;
  for (std::size_t body = 0; body < predicted.size(); ++body) {
    if (!predicted[body]) return std::nullopt;
    for (const ExpectedView& view : expected_views(bodies()[body], rig_, *predicted[body], options_.views)) {
      const double spread = std::sqrt(view.covariance.trace());
      const double radius = 4 * spread + 2 * view.image.semi_major + options_.window_margin_px;
      if (radius > kLargestWindow_px) return std::nullopt;
      (view.side == Side::Left ? windows.left : windows.right).push_back({view.image.centre, radius});
    }
  }
  return windows;
}

bool Tracker::covered(const TrackedFrame& frame, const Windows& windows) const {
  for (std::size_t body = 0; body < frame.poses.size(); ++body) {
    if (frame.poses[body].status != PoseStatus::Ok) return false;
    for (const ExpectedView& view :
         expected_views(bodies()[body], rig_, *frame.poses[body].estimate, options_.views)) {
      const auto& near = view.side == Side::Left ? windows.left : windows.right;
      const double reach = 1.5 * view.image.semi_major + 0.25 * options_.window_margin_px;
      const bool inside = std::any_of(near.begin(), near.end(), [&](const SearchWindow& window) {
        return (window.centre_px - view.image.centre).norm() + reach <= window.radius_px;
      });
      if (!inside) return false;
    }
  }
  return true;
}

void Tracker::check_time(int frame, double time_s) const {
  if (!std::isfinite(time_s))
    throw InputError(fmt::format("frame {}: its time is not a finite number", frame));
  if (!last_frame_ || time_s >= last_time_s_) return;
  throw InputError(fmt::format(
      "frame {}: its time {} s is before that of frame {} ({} s); frames must come in order of time", frame,
      time_s, *last_frame_, last_time_s_));
}

void Tracker::check_size(const StereoImage& image) const {
  for (const Side side : {Side::Left, Side::Right}) {
    const auto& picture = side == Side::Left ? image.left : image.right;
    const Lens& lens = rig_.lens(side);
    if (!picture || (width_of(*picture) == lens.width_px && height_of(*picture) == lens.height_px)) continue;
    throw InputError(fmt::format("frame {}: the {} image is {} × {}, the rig's is {} × {}", image.frame,
                                 side == Side::Left ? "left" : "right", width_of(*picture),
                                 height_of(*picture), lens.width_px, lens.height_px));
  }
}

}  // namespace asterism
