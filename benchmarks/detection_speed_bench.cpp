// SPDX-License-Identifier: Apache-2.0
// Time to find and fit about 110 discs in a frame of 4.2 megapixels, one thread, beside OpenCV in the same
// run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "asterism/core/parallel.hpp"
#include "asterism/detection/candidates.hpp"
#include "asterism/detection/detect.hpp"
#include "asterism/detection/rendered_disc.hpp"
#include "bench.hpp"

namespace asterism {
namespace {

constexpr int kSide = 2048;

std::vector<Ellipse> discs() {
  std::vector<Ellipse> result;
  RandomStream random(30, 0);
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 11; ++column) {
      result.push_back(
          {{100 + 184 * column + random.uniform(-40, 40), 100 + 204 * row + random.uniform(-40, 40)},
           8,
           6.55,
           random.uniform(-1.5, 1.5)});
    }
  }
  return result;
}

/// A dark field with a slope in its light and sensor noise.
Raster8 frame(const std::vector<Ellipse>& discs) {
  RandomStream random(31, 0);
  Canvas canvas(kSide, kSide, 0);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) canvas.at(x, y) = 12 + 8.0 * x / kSide + 6.0 * y / kSide;
  }
  for (const Ellipse& disc : discs) add_disc(canvas, disc, 180, 0.7);
  return digitise(canvas, 1.5, random);
}

/// Median of the thread's own time in seconds, the calls taken in turn: other load on the machine does not
/// count.
std::vector<double> own_seconds_in_turn(const std::vector<std::function<void()>>& calls, int repeats) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  std::vector<std::vector<double>> samples(calls.size());
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t i = 0; i < calls.size(); ++i) {
      const double start = now();
      calls[i]();
      samples[i].push_back(now() - start);
    }
  }
  std::vector<double> medians;
  for (auto& sample : samples) {
    std::sort(sample.begin(), sample.end());
    medians.push_back(sample[sample.size() / 2]);
  }
  return medians;
}

/// The floor: every byte read once.
std::uint64_t read_plainly(const Raster8& image) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, &image.pixels[i], 8);
    sum ^= word;
  }
  return sum;
}

int run() {
  set_thread_count(1);
  cv::setNumThreads(1);
  const auto truth = discs();
  const Raster8 raster = frame(truth);
  const Image image = raster;
  const cv::Mat view(kSide, kSide, CV_8U, const_cast<std::uint8_t*>(raster.pixels.data()));
  std::uint64_t sum = 0;
  std::size_t found = 0, fitted = 0, contours_found = 0;
  const DetectionOptions options;
  cv::Mat binary;
  const auto find_contours = [&](std::vector<std::vector<cv::Point>>& contours) {
    cv::threshold(view, binary, 110, 255, cv::THRESH_BINARY);
    cv::findContours(binary, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  };
  std::vector<SearchWindow> windows;
  for (const Ellipse& disc : truth) windows.push_back({disc.centre, 20});
  const auto seconds = own_seconds_in_turn(
      {[&] { sum ^= read_plainly(raster); },
       [&] {
         std::vector<std::vector<cv::Point>> contours;
         find_contours(contours);
         contours_found = contours.size();
       },
       [&] { found = find_candidates(raster, Tone<std::uint8_t>{}, options).candidates.size(); },
       [&] {
         std::vector<std::vector<cv::Point>> contours;
         find_contours(contours);
         for (const auto& contour : contours)
           sum ^= static_cast<std::uint64_t>(cv::fitEllipse(contour).center.x);
       },
       [&] { fitted = detect_targets(image, options).size(); },
       [&] { sum ^= detect_targets(image, windows, options).size(); },
       [&] {
         for (const Ellipse& disc : truth) sum ^= fit_target(image, disc, options).has_value();
       }},
      61);
  bench::Table table("4.2-megapixel frame, 110 discs of 8 px semi-axis, one thread",
                     {"what", "ms", "ratio", "limit"});
  const auto row = [&](const char* what, double s, double peer, const char* limit) {
    table.row({what, fmt::format("{:.3f}", 1e3 * s), peer > 0 ? fmt::format("{:.2f}", s / peer) : "", limit});
  };
  row("plain read", seconds[0], 0, "");
  row("cv thresh+contours", seconds[1], 0, "");
  row("search", seconds[2], seconds[1], "1.00");
  row("cv ..+fitEllipse", seconds[3], 0, "");
  row("detect_targets", seconds[4], seconds[3], "1.50");
  row("in windows", seconds[5], seconds[3], "");
  const double fit_us = 1e6 * (seconds[4] - seconds[2]) / static_cast<double>(truth.size());
  table.row({"fits, us a target", fmt::format("{:.1f}", fit_us), "", "25.0"});
  table.row({"fit_target, us", fmt::format("{:.1f}", 1e6 * seconds[6] / static_cast<double>(truth.size())),
             "", ""});
  table.print_json();
  fmt::print(stderr, "found {} candidates, {} fitted, {} contours; {}\n", found, fitted, contours_found,
             sum & 1);
  return found == truth.size() && fitted == truth.size() ? 0 : 1;
}

}  // namespace
}  // namespace asterism

int main() { return asterism::run(); }
