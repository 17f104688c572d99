// SPDX-License-Identifier: Apache-2.0
#include "asterism/cell/layout_task.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

LayoutTask sound() {
  LayoutTask task;
  task.body = "platform";
  task.surface.patches = {{"room", CylinderRoom{{0, 0, 580}, 350, 40, 0.3}}};
  task.surface.keep_outs = {{"clamp", Box{{100, 50, 50}}, {}}};
  task.points = {{"rim", {200, 0, 900}}};
  return task;
}

std::string complaint(const std::function<void(LayoutTask&)>& spoil) {
  LayoutTask task = sound();
  spoil(task);
  try {
    check_layout_task(task, "cell.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(CheckLayoutTask, TakesASoundOne) {
  EXPECT_EQ(complaint([](LayoutTask&) {}), "none");
}

TEST(CheckLayoutTask, SaysWhatIsWrong) {
  EXPECT_EQ(complaint([](LayoutTask& task) { task.surface.patches.clear(); }),
            "cell.toml: layout task: no patch is named on which targets may stand");
  EXPECT_EQ(complaint([](LayoutTask& task) {
              task.surface.patches.push_back({"side", CylinderSide{Vec3::Zero(), 100, 50, 0, 7}});
            }),
            "cell.toml: layout task: patch `side`: its angles span more than one turn");
  EXPECT_EQ(
      complaint([](LayoutTask& task) {
        task.surface.patches.push_back({"ring", Annulus{Vec3::Zero(), 100, 50}});
      }),
      "cell.toml: layout task: patch `ring`: its outer radius must be larger than its inner radius, and "
      "that not negative");
  EXPECT_EQ(complaint([](LayoutTask& task) {
              task.surface.patches.push_back({"plate", Plate{{}, 0, 10}});
            }),
            "cell.toml: layout task: patch `plate`: its width and height must be positive");
  EXPECT_EQ(complaint([](LayoutTask& task) { task.surface.patches.push_back(task.surface.patches[0]); }),
            "cell.toml: layout task: patch `room`: is given twice");
  EXPECT_EQ(complaint([](LayoutTask& task) {
              task.surface.keep_outs[0].shape = Box{{0, 1, 1}};
            }),
            "cell.toml: layout task: keep-out `clamp`: its sizes must be positive");
  EXPECT_EQ(complaint([](LayoutTask& task) { task.fewest = 3; }),
            "cell.toml: layout task: `fewest` is 3; it must lie between 4 and 64");
  EXPECT_EQ(complaint([](LayoutTask& task) { task.fewest = 8, task.most = 6; }),
            "cell.toml: layout task: `most` is 6, below `fewest`, which is 8");
  EXPECT_EQ(complaint([](LayoutTask& task) { task.points[0].in_body_mm.x() = 1.0 / 0.0; }),
            "cell.toml: layout task: point `rim`: a coordinate is not a finite number");
  EXPECT_EQ(complaint([](LayoutTask& task) { task.body.clear(); }),
            "cell.toml: layout task: `body` must name the body whose targets are to be placed");
}

}  // namespace
}  // namespace asterism
