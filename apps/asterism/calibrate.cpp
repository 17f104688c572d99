// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>

#include "asterism/calibration/image_pairs.hpp"
#include "asterism/calibration/stereo_calibration.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/io/image_file.hpp"
#include "asterism/io/rig_file.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "scale_bars.hpp"

namespace asterism::app {
namespace {

using Json = nlohmann::ordered_json;

struct Call {
  std::string pattern = "chessboard", size, left, right, out = "rig.yaml";
  double pitch_mm = 0, circle_diameter_mm = 0;
  std::vector<std::string> scale_bars;
};

struct Options {
  CalibrationOptions calibration;
  BoardSearchOptions board;
};

void describe(Options& options, OptionVisitor& visit) {
  describe(options.calibration, visit);
  describe(options.board, visit);
}

Board board_of(const Call& call) {
  Board board;
  const std::map<std::string, BoardPattern> patterns = {
      {"chessboard", BoardPattern::Chessboard},
      {"circles", BoardPattern::Circles},
      {"asymmetric-circles", BoardPattern::AsymmetricCircles}};
  board.pattern = patterns.at(call.pattern);
  read_board_size(call.size, board);
  board.pitch_mm = call.pitch_mm;
  board.circle_diameter_mm = call.circle_diameter_mm;
  if (board.pattern == BoardPattern::Chessboard && call.circle_diameter_mm != 0) {
    throw InputError("--circle-diameter-mm belongs to circle patterns; a chessboard has none");
  }
  check_board(board);
  return board;
}

/// An image that cannot be read is refused with its reason, as one without a board is.
CalibrationImage look_at(const std::filesystem::path& file, const Image* first, const Board& board,
                         const BoardSearchOptions& options) {
  try {
    const Image image = read_image(file);
    const Image& like = first == nullptr ? image : *first;
    return view_image(file.string(), image, width_of(like), height_of(like), board, options);
  } catch (const InputError& error) {
    CalibrationImage refused;
    refused.name = file.string();
    refused.refused = error.what();
    return refused;
  }
}

Image first_readable(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    try {
      return read_image(file);
    } catch (const InputError&) {
      if (file == files.back()) throw;
    }
  }
  throw InputError("no images");
}

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.string());
  return names;
}

CalibrationInput look_at_all(const Call& call, const Options& options, const Common& common) {
  CalibrationInput input;
  input.board = board_of(call);
  const auto left = list_images(call.left), right = list_images(call.right);
  const ImagePairing pairing = pair_images(names_of(left), names_of(right));
  const Image first_left = first_readable(left), first_right = first_readable(right);
  input.left_width_px = width_of(first_left);
  input.left_height_px = height_of(first_left);
  input.right_width_px = width_of(first_right);
  input.right_height_px = height_of(first_right);
  input.pairs.resize(pairing.pairs.size());
  const Progress progress = make_progress(common);
  std::atomic<std::size_t> done = 0;
  std::mutex drawing;
  parallel_for(2 * pairing.pairs.size(), [&](std::size_t index) {
    const bool is_left = index % 2 == 0;
    const ImagePair& pair = pairing.pairs[index / 2];
    const auto& place = is_left ? pair.left : pair.right;
    CalibrationImage& image = is_left ? input.pairs[index / 2].left : input.pairs[index / 2].right;
    if (place) {
      image = look_at((is_left ? left : right)[*place], is_left ? &first_left : &first_right, input.board,
                      options.board);
    } else {
      image.name = is_left ? "(no left image)" : "(no right image)";
      image.refused = "no image of this number";
    }
    const std::size_t so_far = ++done;
    const std::scoped_lock lock(drawing);
    progress("finding the board", so_far, 2 * pairing.pairs.size());
  });
  return input;
}

Json json_of(const CalibrationImage& image) {
  Json json = {{"name", image.name}, {"used", image.refused.empty()}};
  if (image.refused.empty()) {
    json["rms_px"] = image.rms_px;
    json["outliers"] = image.outliers;
  } else {
    json["refused"] = image.refused;
  }
  return json;
}

Json json_of(const StereoCalibration& result) {
  Json json = {{"stereo_rms_px", result.stereo_rms_px},
               {"held_out_rms_px", result.held_out_rms_px},
               {"baseline_mm", result.baseline_mm},
               {"baseline_sigma_mm", result.baseline_sigma_mm},
               {"coefficients", result.rig.left.coefficients},
               {"pairs_used", result.pairs_used},
               {"point_sigma_px", result.corner_sigma_px},
               {"model_sigma_px", result.model_sigma_px},
               {"pitch_mm", result.pitch_mm}};
  if (result.circle_diameter_mm > 0) json["circle_diameter_mm"] = result.circle_diameter_mm;
  json["trials"] = Json::array();
  for (const ModelTrial& trial : result.trials) {
    json["trials"].push_back({{"coefficients", trial.coefficients},
                              {"stereo_rms_px", trial.stereo_rms_px},
                              {"held_out_rms_px", trial.held_out_rms_px}});
  }
  json["sigmas"] = Json::object();
  for (std::size_t i = 0; i < result.rig.covariance_order.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    json["sigmas"][result.rig.covariance_order[i]] = std::sqrt(result.rig.covariance(k, k));
  }
  json["images"] = Json::array();
  for (const CalibrationPair& pair : result.pairs) {
    json["images"].push_back({{"left", json_of(pair.left)}, {"right", json_of(pair.right)}});
  }
  json["scale_bar_errors_mm"] = result.bar_errors_mm;
  json["notes"] = result.notes;
  return json;
}

std::string line_of(const CalibrationImage& image) {
  if (!image.refused.empty()) return fmt::format("  {}  refused: {}\n", image.name, image.refused);
  const std::string left_out = image.outliers > 0 ? fmt::format("  {} points left out", image.outliers) : "";
  return fmt::format("  {}  {:.4f} px{}\n", image.name, image.rms_px, left_out);
}

std::string text_of(const StereoCalibration& result, const std::string& out) {
  std::string text = "image  RMS residual\n";
  for (const CalibrationPair& pair : result.pairs) text += line_of(pair.left) + line_of(pair.right);
  if (result.trials.size() > 1) {
    text += "coefficients  stereo RMS  held-out RMS (px)\n";
    for (const ModelTrial& trial : result.trials) {
      const bool chosen = trial.coefficients == result.rig.left.coefficients;
      text += fmt::format("{:12}  {:10.4f}  {:12.4f}{}\n", trial.coefficients, trial.stereo_rms_px,
                          trial.held_out_rms_px,
                          chosen ? "  chosen: the fewest that predict as well as any" : "");
    }
  }
  const auto sigma = [&](Eigen::Index i) { return std::sqrt(result.rig.covariance(i, i)); };
  const Lens &left = result.rig.left, &right = result.rig.right;
  const Eigen::Index second = 5 + left.coefficients;
  text += fmt::format("stereo_rms_px {:.4f}  held_out_rms_px {:.4f}  pairs {}  coefficients {}\n",
                      result.stereo_rms_px, result.held_out_rms_px, result.pairs_used, left.coefficients);
  text += fmt::format("baseline {:.4f} ± {:.4f} mm\n", result.baseline_mm, result.baseline_sigma_mm);
  text +=
      fmt::format("left  fx {:.3f} ± {:.3f}  fy {:.3f} ± {:.3f}  cx {:.3f} ± {:.3f}  cy {:.3f} ± {:.3f}\n",
                  left.fx, sigma(0), left.fy, sigma(1), left.cx, sigma(3), left.cy, sigma(4));
  text += fmt::format(
      "right fx {:.3f} ± {:.3f}  fy {:.3f} ± {:.3f}  cx {:.3f} ± {:.3f}  cy {:.3f} ± {:.3f}\n", right.fx,
      sigma(second), right.fy, sigma(second + 1), right.cx, sigma(second + 3), right.cy, sigma(second + 4));
  if (result.circle_diameter_mm > 0)
    text += fmt::format("circle diameter {:.3f} mm\n", result.circle_diameter_mm);
  if (!result.bar_errors_mm.empty())
    text += fmt::format("board pitch by the scale bars {:.4f} mm\n", result.pitch_mm);
  for (const double error : result.bar_errors_mm) text += fmt::format("scale bar: {:+.4f} mm\n", error);
  for (const std::string& note : result.notes) text += "note: " + note + "\n";
  return text + "written: " + out;
}

void run(const Call& call, const Options& options, const Common& common) {
  CalibrationInput input = look_at_all(call, options, common);
  StereoCalibration result = calibrate_stereo(input, options.calibration);
  if (!call.scale_bars.empty()) {
    input.bars = find_scale_bars(call.scale_bars, result.rig);
    result = calibrate_stereo(input, options.calibration);
  }
  write_rig(call.out, result.rig);
  print_result(common, json_of(result), text_of(result, call.out));
}

}  // namespace

void add_calibrate(CLI::App& root, Common& common) {
  CLI::App* command = add_command(root, common, "calibrate", "images of a board → rig with covariance",
                                  "asterism calibrate --pattern chessboard --size 11x8 --pitch-mm 40 --left "
                                  "left/ --right right/ --out rig.yaml");
  auto call = std::make_shared<Call>();
  command->add_option("--pattern", call->pattern, "what is on the board")
      ->check(CLI::IsMember({"chessboard", "circles", "asymmetric-circles"}));
  command->add_option("--size", call->size, "columns x rows of inner corners or circles, e.g. 11x8")
      ->required();
  command
      ->add_option("--pitch-mm", call->pitch_mm, "from point to point; asymmetric circles: from row to row")
      ->required();
  command->add_option("--circle-diameter-mm", call->circle_diameter_mm, "of the circles; 0 = estimated");
  command->add_option("--left", call->left, "images of the left camera: a folder or a pattern")->required();
  command->add_option("--right", call->right, "images of the right camera")->required();
  command->add_option("--out", call->out, "the rig file to write")->capture_default_str();
  command->add_option(
      "--scale-bar", call->scale_bars,
      "RECORDING=length[,sigma] in mm: two targets at a known distance, moved through the volume");
  const auto options = step_options<Options>(*command);
  on_call(*command, common, [=, &common] { run(*call, options(), common); });
}

}  // namespace asterism::app
