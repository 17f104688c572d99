// SPDX-License-Identifier: Apache-2.0
#include "scale_bars.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "asterism/detection/detect.hpp"
#include "asterism/io/recording.hpp"
#include "asterism/tracking/triangulation.hpp"

namespace asterism::app {
namespace {

struct GivenBar {
  std::string folder;
  double length_mm = 0, sigma_mm = 0.01;
};

GivenBar read_bar(const std::string& text) {
  const auto refuse = [&] {
    throw InputError(fmt::format(
        "--scale-bar {}: expected RECORDING=length_mm[,sigma_mm], e.g. bar/=1389.688,0.005", text));
  };
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) refuse();
  GivenBar bar;
  bar.folder = text.substr(0, equals);
  const char* end = text.data() + text.size();
  const auto length = std::from_chars(text.data() + equals + 1, end, bar.length_mm);
  if (length.ec != std::errc() || (length.ptr != end && *length.ptr != ',')) refuse();
  if (length.ptr != end) {
    const auto sigma = std::from_chars(length.ptr + 1, end, bar.sigma_mm);
    if (sigma.ec != std::errc() || sigma.ptr != end) refuse();
  }
  if (!(bar.length_mm > 0 && bar.sigma_mm > 0)) refuse();
  return bar;
}

StereoCentres centres_of(const Recording& recording, std::size_t index) {
  if (recording.centres) return (*recording.centres)[index];
  const StereoImage images = read_frame(recording, index);
  StereoCentres centres;
  if (images.left) centres.left = detect_targets(*images.left, {});
  if (images.right) centres.right = detect_targets(*images.right, {});
  return centres;
}

/// The bar in one frame; empty when no pair of points, or more than one, fits its length.
std::optional<ScaleBarView> bar_in(const StereoCentres& centres, const StereoRig& rig, const GivenBar& bar) {
  const std::vector<Point> points = triangulate(centres.left, centres.right, rig, {});
  std::optional<ScaleBarView> found;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      if (points[a].left == points[b].left || points[a].right == points[b].right) continue;
      const double length = (points[a].in_tracker - points[b].in_tracker).norm();
      if (std::abs(length - bar.length_mm) > 0.02 * bar.length_mm) continue;
      if (found) return std::nullopt;
      found = ScaleBarView{bar.length_mm, bar.sigma_mm, {}, {}};
      for (int end = 0; end < 2; ++end) {
        const Point& point = points[end == 0 ? a : b];
        const Centre& left = centres.left[static_cast<std::size_t>(point.left)];
        const Centre& right = centres.right[static_cast<std::size_t>(point.right)];
        found->px[0][end] = left.px();
        found->px[1][end] = right.px();
        found->covariance[0][end] = left.covariance;
        found->covariance[1][end] = right.covariance;
      }
    }
  }
  return found;
}

}  // namespace

std::vector<ScaleBarView> find_scale_bars(const std::vector<std::string>& given, const StereoRig& rig) {
  std::vector<ScaleBarView> views;
  for (const std::string& text : given) {
    const GivenBar bar = read_bar(text);
    const Recording recording = open_recording(bar.folder);
    const std::size_t frames = recording.centres ? recording.centres->size() : recording.frames.size();
    const std::size_t before = views.size();
    for (std::size_t i = 0; i < frames; ++i) {
      if (const auto view = bar_in(centres_of(recording, i), rig, bar)) views.push_back(*view);
    }
    if (views.size() == before) {
      throw MeasurementError(fmt::format("{}: no frame shows exactly one pair of targets {} mm apart",
                                         bar.folder, bar.length_mm));
    }
  }
  return views;
}

}  // namespace asterism::app
