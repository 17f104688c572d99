// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/recording.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "asterism/core/result.hpp"
#include "asterism/io/body_file.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/csv_file.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/rig_file.hpp"

namespace asterism {
namespace {

std::vector<FrameEntry> read_frames(const std::filesystem::path& folder, bool with_images) {
  std::vector<std::string> columns = {"frame", "time_s"};
  if (with_images) columns.insert(columns.end(), {"left", "right"});
  const CsvTable table(folder / "frames.csv", columns);
  std::vector<FrameEntry> frames;
  std::set<int> seen;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    FrameEntry entry{table.integer(row, "frame"), table.number(row, "time_s"), table.text(row, "left"),
                     table.text(row, "right")};
    if (!seen.insert(entry.frame).second)
      table.refuse(row, "frame", fmt::format("{} is given twice", entry.frame));
    if (!frames.empty() && entry.time_s <= frames.back().time_s) {
      table.refuse(row, "time_s",
                   fmt::format("time must go on, but {} follows {}", entry.time_s, frames.back().time_s));
    }
    for (const char* side : {"left", "right"}) {
      const std::string& image = table.text(row, side);
      if (!with_images || image.empty() || std::filesystem::is_regular_file(folder / image)) continue;
      table.refuse(
          row, side,
          fmt::format("the image {} is not there; leave the cell empty when the camera lost the frame",
                      (folder / image).string()));
    }
    frames.push_back(std::move(entry));
  }
  if (frames.empty()) throw InputError((folder / "frames.csv").string(), "names no frames");
  return frames;
}

/// The centres of each frame of the list, which is made from them where there is no frames.csv.
void read_centres(Recording& recording) {
  const std::filesystem::path file = recording.folder / "centres.csv";
  std::map<int, StereoCentres> by_frame;
  for (StereoCentres& centres : stereo_centres(read_centre_rows(file), file.string())) {
    by_frame[centres.frame] = std::move(centres);
  }
  if (std::filesystem::exists(recording.folder / "frames.csv")) {
    recording.frames = read_frames(recording.folder, false);
  } else {
    for (const auto& [frame, centres] : by_frame)
      recording.frames.push_back({frame, static_cast<double>(frame), "", ""});
  }
  recording.centres.emplace();
  for (const FrameEntry& entry : recording.frames) {
    StereoCentres centres;
    if (auto found = by_frame.extract(entry.frame)) centres = std::move(found.mapped());
    centres.frame = entry.frame;
    centres.time_s = entry.time_s;
    recording.centres->push_back(std::move(centres));
  }
  if (!by_frame.empty()) {
    throw InputError(file.string(),
                     fmt::format("holds frame {}, which frames.csv does not name", by_frame.begin()->first));
  }
  if (recording.frames.empty()) throw InputError(file.string(), "holds no centres");
}

bool names_images(const std::filesystem::path& folder) {
  const CsvTable table(folder / "frames.csv", {});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!table.text(row, "left").empty() || !table.text(row, "right").empty()) return true;
  }
  return false;
}

}  // namespace

Recording open_recording(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError(folder.string(),
                     "is no folder; a recording is a folder with frames.csv, rig.yaml and bodies.toml");
  }
  Recording recording;
  recording.folder = folder;
  const bool listed = std::filesystem::exists(folder / "frames.csv");
  const bool centres = std::filesystem::exists(folder / "centres.csv");
  if (!listed && !centres) {
    throw InputError(folder.string(),
                     "holds neither frames.csv nor centres.csv; for loose images give --left and --right");
  }
  if (listed && (!centres || names_images(folder))) {
    recording.frames = read_frames(folder, true);
  } else {
    read_centres(recording);
  }
  if (std::filesystem::exists(folder / "rig.yaml")) recording.rig = read_rig(folder / "rig.yaml");
  if (std::filesystem::exists(folder / "bodies.toml")) recording.bodies = read_bodies(folder / "bodies.toml");
  return recording;
}

Recording recording_of_images(const std::vector<std::filesystem::path>& left,
                              const std::vector<std::filesystem::path>& right, double rate_hz) {
  if (left.size() != right.size()) {
    throw InputError(
        fmt::format("{} left and {} right images: each needs its partner; list lost ones in frames.csv",
                    left.size(), right.size()));
  }
  Recording recording;
  for (std::size_t i = 0; i < left.size(); ++i) {
    recording.frames.push_back(
        {static_cast<int>(i), static_cast<double>(i) / rate_hz, left[i].string(), right[i].string()});
  }
  return recording;
}

std::optional<Image> read_frame_image(const Recording& recording, std::size_t index, Side side) {
  const FrameEntry& entry = recording.frames.at(index);
  const std::string& name = side == Side::Left ? entry.left : entry.right;
  if (name.empty()) return std::nullopt;
  Image image = read_image(recording.folder / name);
  if (recording.rig) {
    const Lens& lens = recording.rig->lens(side);
    if (width_of(image) != lens.width_px || height_of(image) != lens.height_px) {
      throw WrongImageSize((recording.folder / name).string(),
                           fmt::format("is {} × {} px but the rig was calibrated at {} × {}", width_of(image),
                                       height_of(image), lens.width_px, lens.height_px));
    }
  }
  return image;
}

StereoImage read_frame(const Recording& recording, std::size_t index) {
  const FrameEntry& entry = recording.frames.at(index);
  return {entry.frame, entry.time_s, read_frame_image(recording, index, Side::Left),
          read_frame_image(recording, index, Side::Right)};
}

}  // namespace asterism
