// SPDX-License-Identifier: Apache-2.0
#include "asterism/calibration/body_learning.hpp"

#include <fmt/format.h>

#include "asterism/calibration/body_learning_bundle.hpp"
#include "asterism/calibration/body_learning_choice.hpp"
#include "asterism/calibration/body_learning_frame.hpp"
#include "asterism/calibration/body_learning_known.hpp"
#include "asterism/calibration/body_learning_report.hpp"
#include "asterism/calibration/body_learning_search.hpp"
#include "asterism/calibration/body_learning_shape.hpp"
#include "asterism/calibration/body_learning_views.hpp"

namespace asterism {
namespace {

constexpr std::size_t kLeastFrames = 3;

BodyModel model_of(const RigidSet& set) {
  BodyModel model;
  for (const Point& target : set.targets) model.positions.push_back(target.in_tracker);
  for (const Sighting& sighting : set.sightings) model.tracker_from_body.push_back(sighting.tracker_from_set);
  model.normals.resize(model.positions.size());
  model.radii_mm.resize(model.positions.size(), 0.0);
  return model;
}

void learn_shapes(const StereoRig& rig, AdjustedBody& adjusted, const BodyLearningOptions& options) {
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
Result<AdjustedBody, NoBody> adjust(const StereoRig& rig, const RigidSet& set,
                                    std::span<const ObservedFrame> frames,
                                    const BodyLearningOptions& options) {
  AdjustedBody adjusted{model_of(set), {}, {}, {}};
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
  const auto sets =
      unknown_sets(find_rigid_sets(frames, options), name, nominal, others, options.nominal_error_mm);
  if (!sets) return tl::unexpected(sets.error());
  auto chosen = choose_set(*sets, frames, options);
  if (!chosen) return tl::unexpected(chosen.error());
  if (auto known = mistaken_for_known(chosen->set, name, nominal, others, options.nominal_error_mm)) {
    return tl::unexpected(std::move(*known));
  }
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
  LearntBody learnt = report_body(rig, std::move(*adjusted), *frame, name, frames.size());
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
