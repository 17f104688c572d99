// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/detect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "asterism/core/parallel.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/centre_table.hpp"
#include "asterism/io/image_file.hpp"
#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::vector<std::string> images;
  std::string camera, out;
};

struct Picture {
  std::string file;
  std::optional<Side> camera;
  int frame = 0;
  std::vector<Centre> centres;
  std::string fault;  // why it could not be read
};

std::optional<Side> camera_of(const Call& call, const std::filesystem::path& file) {
  if (call.camera == "left") return Side::Left;
  if (call.camera == "right") return Side::Right;
  for (const std::string& name : {file.parent_path().filename().string(), file.stem().string()}) {
    if (name.starts_with("left") || name == "cam0") return Side::Left;
    if (name.starts_with("right") || name == "cam1") return Side::Right;
  }
  return std::nullopt;
}

/// The number a file's name ends in.
std::optional<int> number_of(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t first = stem.find_last_not_of("0123456789") + 1;  // npos + 1 is 0
  if (first == stem.size() || stem.size() - first > 9) return std::nullopt;
  return std::stoi(stem.substr(first));
}

/// A frame's number is its file's where each file of a camera has its own, else its place.
void number_frames(std::vector<Picture>& pictures) {
  std::set<std::pair<int, int>> seen;
  const auto key = [](const Picture& picture) {
    return picture.camera ? static_cast<int>(*picture.camera) : -1;
  };
  const bool numbered = std::all_of(pictures.begin(), pictures.end(), [&](const Picture& picture) {
    const auto number = number_of(picture.file);
    return number && seen.emplace(key(picture), *number).second;
  });
  std::map<int, int> next;
  for (Picture& picture : pictures)
    picture.frame = numbered ? *number_of(picture.file) : next[key(picture)]++;
}

std::vector<Picture> pictures_of(const Call& call) {
  std::vector<Picture> pictures;
  for (const std::string& named : call.images) {
    for (const auto& file : list_images(named))
      pictures.push_back({file.string(), camera_of(call, file), 0, {}, {}});
  }
  number_frames(pictures);
  return pictures;
}

void detect_in(Picture& picture, const DetectionOptions& options) {
  try {
    picture.centres = detect_targets(read_image(picture.file), options);
  } catch (const InputError& error) {
    picture.fault = error.what();
  }
}

nlohmann::ordered_json json_of(const std::vector<Picture>& pictures) {
  nlohmann::ordered_json images = nlohmann::ordered_json::array();
  for (const Picture& picture : pictures) {
    nlohmann::ordered_json image = {{"image", picture.file}, {"frame", picture.frame}};
    if (picture.camera) image["camera"] = *picture.camera == Side::Left ? "left" : "right";
    image["centres"] = picture.centres.size();
    if (!picture.fault.empty()) image["fault"] = picture.fault;
    images.push_back(image);
  }
  return images;
}

void run(const Call& call, DetectionOptions options, const Common& common) {
  std::vector<Picture> pictures = pictures_of(call);
  CentreTable table(call.out);
  const Progress progress = make_progress(common);
  constexpr std::size_t kBatch = 8;  // images in memory at once
  std::size_t found = 0;
  std::vector<std::string> faults;
  for (std::size_t first = 0; first < pictures.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, pictures.size() - first);
    parallel_for(count, [&](std::size_t i) { detect_in(pictures[first + i], options); });
    for (std::size_t i = first; i < first + count; ++i) {
      const Picture& picture = pictures[i];
      if (!picture.fault.empty()) faults.push_back(picture.fault);
      for (std::size_t c = 0; c < picture.centres.size(); ++c) {
        table.write({picture.frame, picture.camera, static_cast<int>(c), picture.file, picture.centres[c]});
      }
      found += picture.centres.size();
    }
    progress("detecting targets", first + count, pictures.size());
  }
  table.finish();
  print_result(
      common,
      {{"images", pictures.size()},
       {"centres", found},
       {"unreadable", faults.size()},
       {"out", call.out},
       {"per_image", json_of(pictures)},
       {"options", json_of_options(describing(options))}},
      fmt::format("{} centres in {} images → {}\n", found, pictures.size() - faults.size(), call.out));
  if (faults.empty()) return;
  throw InputError(fmt::format("{} ({} of {} images could not be read; what the others show is in {})",
                               faults.front(), faults.size(), pictures.size(), call.out));
}

}  // namespace

void add_detect(CLI::App& root, Common& common) {
  CLI::App* command = add_command(root, common, "detect", "Find the centres of round targets in images",
                                  "asterism detect left/*.png right/*.png --out centres.csv");
  auto call = std::make_shared<Call>();
  command->add_option("images", call->images, "images, folders of images, or quoted patterns")->required();
  command->add_option("--out", call->out, "CSV file of the centres")->required();
  command
      ->add_option("--camera", call->camera,
                   "left or right; else told from the folder's or the file's name where it says so")
      ->check(CLI::IsMember({"left", "right"}));
  const auto options = step_options<DetectionOptions>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
