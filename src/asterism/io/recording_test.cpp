// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/recording.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/rig_file.hpp"

namespace asterism {
namespace {

/// A folder with two frames of 8 × 6 px, a rig that took them and no bodies.
class RecordingFolder : public TestFolder {
 public:
  RecordingFolder() {
    for (const char* name : {"left/0.png", "right/0.png", "left/1.png"})
      write_image(*this / name, Raster8(8, 6));
    frames("0,0.0,left/0.png,right/0.png\n3,0.5,left/1.png,\n");
    StereoRig rig;
    rig.left = rig.right = {10, 10, 0, 4, 3, {}, 0, 8, 6};
    rig.right_from_left.translation = {-100, 0, 0};
    write_rig(*this / "rig.yaml", rig);
  }
  void frames(const std::string& rows) const { write("frames.csv", "frame,time_s,left,right\n" + rows); }
};

std::string fault_of(const TestFolder& folder) {
  return input_error_of([&] { static_cast<void>(open_recording(folder.path())); });
}

TEST(OpenRecording, ReadsFramesAndLeavesOutWhatACameraLost) {
  const RecordingFolder folder;
  const Recording recording = open_recording(folder.path());
  ASSERT_EQ(recording.frames.size(), 2U);
  EXPECT_TRUE(recording.rig);
  EXPECT_FALSE(recording.bodies);
  const StereoImage image = read_frame(recording, 1);
  EXPECT_EQ(image.frame, 3);
  EXPECT_EQ(image.time_s, 0.5);
  EXPECT_TRUE(image.left);
  EXPECT_FALSE(image.right);
}

TEST(OpenRecording, NamesTheLineOfAnAbsentImage) {
  const RecordingFolder folder;
  folder.frames("0,0.0,left/0.png,right/0.png\n1,0.5,left/9.png,\n");
  EXPECT_TELLS(fault_of(folder), "frames.csv:3: column `left`: the image");
  EXPECT_TELLS(fault_of(folder), "left/9.png is not there");
}

TEST(OpenRecording, RefusesTimeThatGoesBackAndFramesGivenTwice) {
  const RecordingFolder folder;
  folder.frames("0,0.5,left/0.png,\n1,0.25,left/1.png,\n");
  EXPECT_TELLS(fault_of(folder), "frames.csv:3: column `time_s`: time must go on, but 0.25 follows 0.5");
  folder.frames("0,0.0,left/0.png,\n0,0.5,left/1.png,\n");
  EXPECT_TELLS(fault_of(folder), "frames.csv:3: column `frame`: 0 is given twice");
  folder.frames("");
  EXPECT_TELLS(fault_of(folder), "names no frames");
}

TEST(OpenRecording, SaysWhatARecordingIsWhenItIsNone) {
  const TestFolder folder;
  EXPECT_TELLS(fault_of(folder), "holds neither frames.csv nor centres.csv");
  EXPECT_TELLS(input_error_of([] { static_cast<void>(open_recording("/no/such")); }),
               "/no/such: is no folder");
}

TEST(OpenRecording, TakesCentresInPlaceOfImages) {
  const TestFolder folder;
  folder.write("centres.csv", "frame,camera,x_px,y_px\n4,left,1,2\n4,right,3,4\n2,left,5,6\n");
  const Recording loose = open_recording(folder.path());
  ASSERT_EQ(loose.frames.size(), 2U);
  EXPECT_EQ(loose.frames[1].time_s, 4);
  folder.write("frames.csv", "frame,time_s,left,right\n2,0.0,,\n3,0.1,,\n4,0.2,,\n");
  const Recording timed = open_recording(folder.path());
  ASSERT_TRUE(timed.centres);
  ASSERT_EQ(timed.centres->size(), 3U);
  EXPECT_TRUE((*timed.centres)[1].left.empty());
  EXPECT_EQ((*timed.centres)[2].right.size(), 1U);
  EXPECT_EQ((*timed.centres)[2].time_s, 0.2);
  folder.write("frames.csv", "frame,time_s\n2,0.0\n");
  EXPECT_TELLS(fault_of(folder), "holds frame 4, which frames.csv does not name");
}

TEST(ReadFrame, RefusesAnImageOfAnotherSizeThanTheRigs) {
  const RecordingFolder folder;
  write_image(folder / "right/0.png", Raster8(9, 6));
  const Recording recording = open_recording(folder.path());
  EXPECT_THROW(static_cast<void>(read_frame(recording, 0)), WrongImageSize);
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_frame(recording, 0)); }),
               "right/0.png: is 9 × 6 px but the rig was calibrated at 8 × 6");
}

TEST(RecordingOfImages, PairsInOrderAndRefusesUnequalNumbers) {
  const Recording recording = recording_of_images({"a", "b"}, {"c", "d"}, 20);
  EXPECT_EQ(recording.frames[1].right, "d");
  EXPECT_EQ(recording.frames[1].time_s, 0.05);
  EXPECT_TELLS(input_error_of([] {
                 static_cast<void>(recording_of_images({"a", "b"}, {"c"}, 20));
               }),
               "2 left and 1 right images");
}

}  // namespace
}  // namespace asterism
