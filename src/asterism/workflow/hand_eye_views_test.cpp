// SPDX-License-Identifier: Apache-2.0
#include "asterism/workflow/hand_eye_views.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/hand_eye_file.hpp"

namespace asterism {
namespace {

const RigidMotion kBodyFromScanner{exp_rotation({0.1, -0.2, 3}), {4, -7, -105}};
const RigidMotion kPlateFromArtefact{exp_rotation({0, 0.3, 0}), {50, 20, 10}};
constexpr const char* kHead = "frame,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";

std::string line(int frame, const std::string& body, const RigidMotion& motion) {
  const auto& [q, t] = motion;
  return fmt::format("{},{},{:.12g},{:.12g},{:.12g},{:.15g},{:.15g},{:.15g},{:.15g}\n", frame, body, t.x(),
                     t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

/// Six views of an artefact on a plate that moves too; the last of them the tracker has not.
HandEyeJob write_views(const TestFolder& folder) {
  std::string seen = kHead, tracked = kHead;
  for (int i = 0; i < 6; ++i) {
    const RigidMotion tracker_from_plate{exp_rotation({0.05 * i, 0, 0}), {0, 10.0 * i, 2000}};
    const RigidMotion tracker_from_body{exp_rotation({0.4 * i, 0.5 - 0.3 * i, 0.2 * (i % 3)}),
                                        {30.0 * i, 0, 1700}};
    const RigidMotion scanner_from_artefact =
        (tracker_from_body * kBodyFromScanner).inverse() * tracker_from_plate * kPlateFromArtefact;
    seen += line(i, "ball plate", scanner_from_artefact);
    if (i == 5) continue;
    tracked += line(i, "plate", tracker_from_plate) + line(i, "scanner", tracker_from_body);
  }
  return {folder.write("seen.csv", seen), folder.write("poses.csv", tracked), "scanner", "plate", {}};
}

TEST(HandEyeViews, FindTheScannerInItsBodyThoughThePlateMoves) {
  const TestFolder folder;
  const auto views = hand_eye_views(write_views(folder));
  ASSERT_EQ(views.size(), 5u);
  const auto found = hand_eye(views);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->body_from_scanner.translation - kBodyFromScanner.translation).norm(), 1e-6);
  EXPECT_LT(rotation_angle(found->body_from_scanner.rotation, kBodyFromScanner.rotation), 1e-9);
  const KnownMotion again = read_hand_eye(folder.write("found.json", json_of(*found, views.size()).dump()));
  EXPECT_LT((again.motion.translation - found->body_from_scanner.translation).norm(), 1e-9);
  EXPECT_LT((again.covariance - found->covariance).norm(), 1e-15);
}

TEST(HandEyeViews, SayWhatIsWrong) {
  const TestFolder folder;
  HandEyeJob job = write_views(folder);
  job.body = "scaner";
  EXPECT_TELLS(input_error_of([&] { return hand_eye_views(job).size(); }), "tells no pose of body `scaner`");
  job = write_views(folder);
  job.artefact = job.poses;
  EXPECT_TELLS(input_error_of([&] { return hand_eye_views(job).size(); }), "tells of several bodies");
  job = write_views(folder);
  job.artefact = folder.write("late.csv", kHead + line(77, "ball plate", {}));
  EXPECT_TELLS(input_error_of([&] { return hand_eye_views(job).size(); }), "none of its frames has a pose");
  EXPECT_TELLS(input_error_of([&] { (void)read_hand_eye(folder.write("x.json", "{}")); }),
               "`body_from_scanner` with `at_mm`");
}

}  // namespace
}  // namespace asterism
