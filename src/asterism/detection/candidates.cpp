// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "asterism/detection/runs.hpp"

namespace asterism {
namespace {

// Shares of the way from background to peak at which a component is looked at, half height first.
constexpr std::array<double, 7> kShares = {0.5, 0.25, 0.75, 0.12, 0.375, 0.625, 0.875};
constexpr int kDirections = 24;

/// Cosine and sine of the directions in which an outline is looked at.
const std::array<Vec2, kDirections>& directions() {
  static const auto kAll = [] {
    std::array<Vec2, kDirections> all;
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / kDirections;
      all[k] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return kAll;
}

template <class Grey>
class Search {
 public:
  Search(const Raster<Grey>& image, Tone<Grey> tone, const DetectionOptions& options)
      : image_(image), tone_(tone), options_(options) {}

  FoundCandidates run() {
    if (image_.width < 3 || image_.height < 3) return {};
    const ThresholdMap map = threshold_map(image_, tone_);
    found_.step = map.step;
    look(map);
    const int reach =
        std::max(1, static_cast<int>(std::ceil(options_.max_diameter_px / (2.5 * ThresholdMap::kTile))));
    const ThresholdMap low = lowered(map, reach);
    for (std::size_t tile = 0; tile < map.background.size(); ++tile) {
      if (map.background[tile] - low.background[tile] <= options_.min_contrast_levels * map.step) continue;
      look(low);
      break;
    }
    return std::move(found_);
  }

 private:
  void look(const ThresholdMap& map) {
    runs_.clear();
    std::vector<Grey> thresholds;
    for (int y = 0; y < image_.height; ++y) {
      // Eight rows share their thresholds: the map is a smooth one.
      if (y % 8 == 0) {
        thresholds_of_row(map, y + 4, options_.min_contrast_levels, options_.min_contrast_noise, thresholds);
      }
      append_runs_of_row(image_, y, 0, image_.width, thresholds.data(), Grey{0}, tone_, runs_);
    }
    for (const Blob& blob : blobs_of(runs_)) look_inside(blob, map);
  }

  void look_inside(const Blob& blob, const ThresholdMap& map) {
    if (blob.count < least_pixels()) return;
    const double background = map.background_at(blob.mean.x(), blob.mean.y());
    const PixelBox box = {std::max(0, blob.box.x_begin - 1), std::max(0, blob.box.y_begin - 1),
                          std::min(image_.width, blob.box.x_end + 1),
                          std::min(image_.height, blob.box.y_end + 1)};
    const double peak = peak_of(box);
    found_.brightest = std::max(found_.brightest, peak);
    for (const double share : kShares) {
      const auto level = static_cast<Grey>(background + share * (peak - background));
      inner_runs_.clear();
      for (int y = box.y_begin; y < box.y_end; ++y) {
        append_runs_of_row<Grey>(image_, y, box.x_begin, box.x_end, nullptr, level, tone_, inner_runs_);
      }
      bool all = true;
      for (const Blob& inner : blobs_of(inner_runs_))
        all &= inner.count < least_pixels() || judge(inner, map);
      if (all) return;
    }
  }

  [[nodiscard]] double least_pixels() const {
    return std::max(4.0, 0.5 * options_.min_diameter_px * options_.min_diameter_px);
  }

  [[nodiscard]] double peak_of(const PixelBox& box) const {
    Grey peak = 0;
    // Of a large box every second pixel will do.
    const int every = std::min(box.x_end - box.x_begin, box.y_end - box.y_begin) > 10 ? 2 : 1;
    for (int y = box.y_begin; y < box.y_end; y += every) {
      const Grey* row = image_.row(y);
      for (int x = box.x_begin; x < box.x_end; x += every) peak = std::max(peak, tone_(row[x]));
    }
    return peak;
  }

  /// Takes the blob for a candidate if it is one; false if not.
  bool judge(const Blob& blob, const ThresholdMap& map) {
    const Mat2 shape = 4.0 * (blob.covariance - Mat2::Identity() / 12.0);
    if (!(shape.determinant() > 0) || !(shape(0, 0) > 0)) return false;
    Candidate candidate;
    candidate.ellipse = ellipse_from_shape(blob.mean, shape);
    const Ellipse& e = candidate.ellipse;
    if (2 * e.semi_minor < options_.min_diameter_px || 2 * e.semi_major > options_.max_diameter_px)
      return false;
    if (e.semi_major > options_.max_aspect * e.semi_minor) return false;
    const double fill = blob.count / (std::numbers::pi * e.semi_major * e.semi_minor);
    // A few pixels fill an ellipse only roughly.
    const double least_fill = options_.min_fill - 0.5 / std::sqrt(blob.count);
    if (fill < least_fill || fill > 1.0 / least_fill) return false;
    measure_edge(candidate);
    if (candidate.contrast < options_.min_contrast_levels * map.step) return false;
    if (candidate.edge_support < options_.min_edge_support) return false;
    keep(candidate);
    return true;
  }

  void measure_edge(Candidate& candidate) const {
    const Ellipse& e = candidate.ellipse;
    const Vec2 major(std::cos(e.angle_rad), std::sin(e.angle_rad));
    const Vec2 minor(-major.y(), major.x());
    const double out = 1.5 + 0.05 * e.semi_minor;
    const double in = std::min(out, 0.8 * e.semi_minor);
    std::array<double, kDirections> fall{};
    std::size_t seen = 0;
    for (const Vec2& direction : directions()) {
      const double c = direction.x(), s = direction.y();
      const Vec2 edge = e.centre + e.semi_major * c * major + e.semi_minor * s * minor;
      const Vec2 normal = (c / e.semi_major * major + s / e.semi_minor * minor).normalized();
      double inside = 0, outside = 0;
      if (!grey_at(edge - in * normal, inside) || !grey_at(edge + out * normal, outside)) continue;
      fall[seen++] = inside - outside;
    }
    if (seen < kDirections / 3) return;
    auto middle = fall;
    std::nth_element(middle.begin(), middle.begin() + static_cast<std::ptrdiff_t>(seen / 2),
                     middle.begin() + static_cast<std::ptrdiff_t>(seen));
    candidate.contrast = middle[seen / 2];
    const auto good = std::count_if(fall.begin(), fall.begin() + static_cast<std::ptrdiff_t>(seen),
                                    [&](double f) { return f > 0.4 * candidate.contrast && f > 0; });
    candidate.edge_support = static_cast<double>(good) / static_cast<double>(seen);
  }

  bool grey_at(const Vec2& px, double& grey) const {
    const int x = static_cast<int>(std::floor(px.x() + 0.5)), y = static_cast<int>(std::floor(px.y() + 0.5));
    if (!image_.contains(x, y)) return false;
    grey = tone_(image_.at(x, y));
    return true;
  }

  /// Of candidates that lie in one another the one with the stronger edge stays.
  void keep(const Candidate& candidate) {
    for (Candidate& other : found_.candidates) {
      const double distance = (other.ellipse.centre - candidate.ellipse.centre).norm();
      if (distance > std::max(other.ellipse.semi_minor, candidate.ellipse.semi_minor)) continue;
      if (candidate.contrast * candidate.edge_support > 1.1 * other.contrast * other.edge_support)
        other = candidate;
      return;
    }
    found_.candidates.push_back(candidate);
  }

  const Raster<Grey>& image_;
  Tone<Grey> tone_;
  const DetectionOptions& options_;
  std::vector<Run> runs_, inner_runs_;
  FoundCandidates found_;
};

}  // namespace

template <class Grey>
FoundCandidates find_candidates(const Raster<Grey>& image, Tone<Grey> tone, const DetectionOptions& options) {
  return Search<Grey>(image, tone, options).run();
}

template FoundCandidates find_candidates(const Raster8&, Tone<std::uint8_t>, const DetectionOptions&);
template FoundCandidates find_candidates(const Raster16&, Tone<std::uint16_t>, const DetectionOptions&);

}  // namespace asterism
