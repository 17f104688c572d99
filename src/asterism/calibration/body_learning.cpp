// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asterism/calibration/body_learning_bundle.hpp"
#include "asterism/calibration/body_learning_choice.hpp"
#include "asterism/calibration/body_learning_frame.hpp"
#include "asterism/calibration/body_learning_shape.hpp"

namespace asterism {
namespace {

constexpr std::size_t kLeastFrames = 3;
constexpr double kSmallTurn_rad = rad_from_deg(5.0);
// Covariances this many times too small (in sigmas) are worth a word.
constexpr double kPoorSigmas = 2.0;

BodyModel model_of(const RigidSet& set) {
  BodyModel model;
  for (const Point& target : set.targets) model.positions.push_back(target.in_tracker);
  for (const Sighting& sighting : set.sightings) model.tracker_from_body.push_back(sighting.tracker_from_set);
  model.normals.resize(model.positions.size());
  model.radii_mm.resize(model.positions.size(), 0.0);
  return model;
}

/// Of the sets those that may be meant: none that is another body, and where some are the nominal body only
/// these.
std::vector<RigidSet> candidates(std::vector<RigidSet> sets, const Body* nominal,
                                 std::span<const Body> others, double error_mm) {
  const auto is = [&](const RigidSet& set, const Body& body) {
    return nominal_frame(model_of(set), body, error_mm).has_value();
  };
  const auto is_another = [&](const RigidSet& set) {
    return std::any_of(others.begin(), others.end(), [&](const Body& other) { return is(set, other); });
  };
  if (!std::all_of(sets.begin(), sets.end(), is_another)) std::erase_if(sets, is_another);
  const auto is_nominal = [&](const RigidSet& set) { return nominal && is(set, *nominal); };
  if (std::any_of(sets.begin(), sets.end(), is_nominal)) {
    std::erase_if(sets, [&](const RigidSet& set) { return !is_nominal(set); });
  }
  return sets;
}

struct Claim {
  double distance_px;
  std::size_t target, centre;
};

/// The centres of one image that are targets: the nearest to where the model expects each.
std::vector<Claim> claims_in(const StereoRig& rig, const BodyModel& model, std::size_t slot, Side side,
                             const std::vector<Centre>& centres, double gate_px) {
  std::vector<Claim> all, claims;
  for (std::size_t t = 0; t < model.positions.size(); ++t) {
    const auto expected = expect_view(rig, model, slot, t, side);
    if (!expected) continue;
    for (std::size_t c = 0; c < centres.size(); ++c) {
      // The ellipse of a disc that is covered in part, or cut by the image's edge, is not the disc's.
      if ((centres[c].flags & (kOccluded | kBorder)) != 0) continue;
      const double distance = (centres[c].px() - expected->px).norm();
      if (distance <= gate_px + std::sqrt(centres[c].covariance.trace())) all.push_back({distance, t, c});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Claim& a, const Claim& b) { return a.distance_px < b.distance_px; });
  for (const Claim& claim : all) {
    const bool taken = std::any_of(claims.begin(), claims.end(), [&](const Claim& other) {
      return other.target == claim.target || other.centre == claim.centre;
    });
    if (!taken) claims.push_back(claim);
  }
  return claims;
}

/// The views of all frames, those of a single camera too.
std::vector<BodyView> views_of(const StereoRig& rig, const BodyModel& model, const RigidSet& set,
                               std::span<const ObservedFrame> frames, double gate_px) {
  constexpr std::size_t kLeastViews = 4;
  std::vector<BodyView> views;
  for (std::size_t slot = 0; slot < set.sightings.size(); ++slot) {
    const StereoCentres& centres = frames[set.sightings[slot].frame].centres;
    std::vector<BodyView> here;
    for (const Side side : {Side::Left, Side::Right}) {
      const auto& list = side == Side::Left ? centres.left : centres.right;
      for (const Claim& claim : claims_in(rig, model, slot, side, list, gate_px)) {
        here.push_back({slot, claim.target, side, list[claim.centre]});
      }
    }
    if (here.size() >= kLeastViews) views.insert(views.end(), here.begin(), here.end());
  }
  return views;
}

struct Adjusted {
  BodyModel model;
  std::vector<BodyView> views;
  BundleSummary summary;
  std::vector<Result<DiscShape, ShapeFailure>> shapes;
};

void learn_shapes(const StereoRig& rig, Adjusted& adjusted, const BodyLearningOptions& options) {
  adjusted.shapes.clear();
  for (std::size_t t = 0; t < adjusted.model.positions.size(); ++t) {
    const auto shape = fit_disc_shape(rig, adjusted.model, t, adjusted.views, options.shape_error_px);
    adjusted.model.normals[t] = shape ? std::optional<Vec3>(shape->normal) : std::nullopt;
    adjusted.model.radii_mm[t] = shape ? shape->radius_mm : 0.0;
    adjusted.shapes.push_back(shape);
  }
}

/// Coordinates and poses by the bundle, normals and radii by the shapes, in turn: each hardly needs the
/// other.
Result<Adjusted, NoBody> adjust(const StereoRig& rig, const RigidSet& set,
                                std::span<const ObservedFrame> frames, const BodyLearningOptions& options) {
  Adjusted adjusted{model_of(set), {}, {}, {}};
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) learn_shapes(rig, adjusted, options);
    adjusted.views = views_of(rig, adjusted.model, set, frames, options.view_gate_px);
    const auto summary = bundle_body(rig, adjusted.model, adjusted.views);
    if (!summary) {
      return tl::unexpected(
          NoBody{BodyLearningFailure::TooFewTargets,
                 summary.error() == BundleFailure::TooFewViews
                     ? "a target was seen clearly in fewer than two images; record more frames"
                     : "the frames do not determine the targets' coordinates; record more motion"});
    }
    adjusted.summary = *summary;
  }
  return adjusted;
}

double distance_sigma(const BodyModel& model, const MatX& covariance) {
  double sum = 0;
  int pairs = 0;
  const auto block = [&](std::size_t i, std::size_t j) {
    return Mat3(covariance.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)));
  };
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++pairs) {
      const Vec3 along = (model.positions[i] - model.positions[j]).normalized();
      sum += along.dot((block(i, i) + block(j, j) - block(i, j) - block(j, i)) * along);
    }
  }
  return std::sqrt(sum / pairs);
}

LearntTarget quality_of(const StereoRig& rig, const Adjusted& adjusted, std::size_t target) {
  LearntTarget quality;
  double squares = 0;
  std::size_t last_frame = adjusted.model.tracker_from_body.size();
  for (const BodyView& view : adjusted.views) {
    if (view.target != target || view.rejected) continue;
    ++quality.views;
    // Views come by frame, left before right.
    if (view.frame != last_frame) ++quality.frames;
    last_frame = view.frame;
    const auto expected = expect_view(rig, adjusted.model, view.frame, target, view.side);
    if (expected) squares += (view.centre.px() - expected->px).squaredNorm();
  }
  if (quality.views > 0) quality.rms_px = std::sqrt(squares / (2.0 * quality.views));
  const auto at = static_cast<Eigen::Index>(3 * target);
  quality.sigma_mm = adjusted.summary.covariance.block<3, 3>(at, at).diagonal().cwiseSqrt();
  if (adjusted.shapes[target]) quality.normal_sigma_rad = adjusted.shapes[target]->normal_sigma_rad;
  return quality;
}

void measure_motion(const BodyModel& model, LearntBody& learnt) {
  for (const RigidMotion& a : model.tracker_from_body) {
    for (const RigidMotion& b : model.tracker_from_body) {
      learnt.rotation_rad = std::max(learnt.rotation_rad, rotation_angle(a.rotation, b.rotation));
      learnt.translation_mm = std::max(learnt.translation_mm, (a.translation - b.translation).norm());
    }
  }
}

std::string_view words_of(ShapeFailure failure) {
  switch (failure) {
    case ShapeFailure::TooFewEllipses:
      return "too few whole ellipses were seen";
    case ShapeFailure::NoDisc:
      return "its images are not those of a flat disc";
    case ShapeFailure::Undetermined:
      return "its images tell its direction to more than 10° only";
  }
  return "";
}

void add_warnings(const Adjusted& adjusted, LearntBody& learnt) {
  if (learnt.rotation_rad < kSmallTurn_rad) {
    learnt.warnings.push_back(
        fmt::format("the body turned by {:.1f}° only: its normals, and its shape along the lines of "
                    "sight, are poorly checked; turn it by 10° and more",
                    deg_from_rad(learnt.rotation_rad)));
  }
  for (std::size_t t = 0; t < learnt.targets.size(); ++t) {
    const std::string& id = learnt.body.targets[t].id;
    if (learnt.targets[t].frames < 3) {
      learnt.warnings.push_back(fmt::format("{} was seen in {} frames only", id, learnt.targets[t].frames));
    }
    if (!adjusted.shapes[t]) {
      learnt.warnings.push_back(
          fmt::format("{} has no normal: {}", id, words_of(adjusted.shapes[t].error())));
    }
  }
  const double factor = std::sqrt(learnt.variance_factor);
  if (factor > kPoorSigmas) {
    learnt.warnings.push_back(
        fmt::format("the centres scatter {:.1f} times more than stated: is the rig still good, is "
                    "the body rigid, are the images sharp?",
                    factor));
  }
}

LearntBody report(const StereoRig& rig, Adjusted adjusted, const BodyFrame& frame, const std::string& name,
                  std::size_t frames_given) {
  LearntBody learnt;
  learnt.body.name = name;
  // Everything that goes by target is told in the frame's order from here on.
  std::vector<std::size_t> place(frame.order.size());
  std::vector<Result<DiscShape, ShapeFailure>> shapes;
  for (std::size_t t = 0; t < frame.order.size(); ++t) {
    place[frame.order[t]] = t;
    shapes.push_back(adjusted.shapes[frame.order[t]]);
  }
  adjusted.shapes = std::move(shapes);
  adjusted.model = in_frame(adjusted.model, frame);
  adjusted.summary.covariance = in_frame(adjusted.summary.covariance, frame);
  for (BodyView& view : adjusted.views) view.target = place[view.target];

  for (std::size_t t = 0; t < frame.order.size(); ++t) {
    Target target{frame.ids[t], adjusted.model.positions[t], adjusted.model.normals[t], std::nullopt,
                  std::nullopt};
    if (target.normal) target.diameter_mm = 2 * adjusted.model.radii_mm[t];
    const auto at = static_cast<Eigen::Index>(3 * t);
    target.covariance = Mat3(adjusted.summary.covariance.block<3, 3>(at, at));
    learnt.body.targets.push_back(std::move(target));
    learnt.targets.push_back(quality_of(rig, adjusted, t));
  }
  learnt.covariance = adjusted.summary.covariance;
  learnt.distance_sigma_mm = distance_sigma(adjusted.model, learnt.covariance);
  learnt.frames_given = static_cast<int>(frames_given);
  std::vector<bool> used(adjusted.model.tracker_from_body.size(), false);
  for (const BodyView& view : adjusted.views) used[view.frame] = used[view.frame] || !view.rejected;
  learnt.frames_used = static_cast<int>(std::count(used.begin(), used.end(), true));
  learnt.views_rejected = adjusted.summary.rejected;
  learnt.rms_px = adjusted.summary.rms_px;
  learnt.variance_factor = adjusted.summary.variance_factor;
  measure_motion(adjusted.model, learnt);
  add_warnings(adjusted, learnt);
  return learnt;
}

}  // namespace

void describe(BodyLearningOptions& options, OptionVisitor& visit) {
  visit.integer("targets", options.targets, {3, 100}, "how many targets the body has");
  visit.number("deformation_mm", options.deformation_mm, {0, 10},
               "how far a distance may change beyond what the covariances allow");
  visit.number("least_motion_mm", options.least_motion_mm, {0.01, 1000},
               "what moves less than this over the recording is background");
  visit.number("view_gate_px", options.view_gate_px, {0.1, 20},
               "how far a centre may lie from where the learnt body expects it");
  visit.number("shape_error_px", options.shape_error_px, {0, 1},
               "error of an ellipse's semi-axes that its noise does not tell");
  visit.number("least_margin_mm", options.least_margin_mm, {0, 100},
               "wrong labels that fit better than this are warned of");
  visit.number("nominal_error_mm", options.nominal_error_mm, {0.01, 100},
               "how far nominal coordinates may be off");
}

Result<LearntBody, NoBody> learn_body(const StereoRig& rig, std::span<const ObservedFrame> frames,
                                      const std::string& name, const BodyLearningOptions& options,
                                      const Body* nominal, std::span<const Body> others) {
  if (options.targets < 3)
    throw InputError("a body needs 3 targets or more; how many are on it must be told");
  if (nominal && nominal->targets.size() != static_cast<std::size_t>(options.targets)) {
    throw InputError(fmt::format("the nominal body `{}` has {} targets, not the {} told", nominal->name,
                                 nominal->targets.size(), options.targets));
  }
  if (frames.size() < kLeastFrames) {
    return tl::unexpected(
        NoBody{BodyLearningFailure::TooFewFrames,
               fmt::format("{} frames are too few to learn a body from; it needs {} or more, in different "
                           "poses",
                           frames.size(), kLeastFrames)});
  }
  const auto sets = candidates(find_rigid_sets(frames, options), nominal, others, options.nominal_error_mm);
  auto chosen = choose_set(sets, frames, options);
  if (!chosen) return tl::unexpected(chosen.error());
  auto adjusted = adjust(rig, chosen->set, frames, options);
  if (!adjusted) return tl::unexpected(adjusted.error());

  const auto frame = nominal ? nominal_frame(adjusted->model, *nominal, options.nominal_error_mm)
                             : std::optional<BodyFrame>(own_frame(rig, adjusted->model));
  if (!frame) {
    return tl::unexpected(
        NoBody{BodyLearningFailure::NotTheNominalBody,
               fmt::format("the {} targets learnt do not fit the nominal body `{}` to {} mm each",
                           options.targets, nominal->name, options.nominal_error_mm)});
  }
  LearntBody learnt = report(rig, std::move(*adjusted), *frame, name, frames.size());
  learnt.ambiguity = find_ambiguity(learnt.body, options.least_margin_mm);
  const std::string advice = advice_against(learnt.ambiguity, learnt.body, options.least_margin_mm);
  if (!advice.empty()) learnt.warnings.push_back(advice);
  learnt.warnings.insert(learnt.warnings.begin(), chosen->warnings.begin(), chosen->warnings.end());
  if (nominal) {
    learnt.warnings.push_back(fmt::format(
        "the frame is the nominal body's; its coordinates were {:.3f} mm RMS off", frame->rms_mm));
    if (frame->second_rms_mm > 0) {
      learnt.warnings.push_back(
          fmt::format("the targets fit the nominal ones in another order too ({:.3f} mm RMS): are "
                      "the ids right?",
                      frame->second_rms_mm));
    }
  }
  return learnt;
}

}  // namespace asterism
