// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asterism {

/// Keeps OpenCV from printing: what goes wrong is told by our own errors. May be called often.
void quiet_opencv();

}  // namespace asterism
