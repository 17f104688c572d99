// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/quiet_opencv.hpp"

#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

namespace asterism {
namespace {

int say_nothing(int, const char*, const char*, const char*, int, void*) { return 0; }

}  // namespace

void quiet_opencv() {
  static const bool done = [] {
    cv::redirectError(say_nothing);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace asterism
