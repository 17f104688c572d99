// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace asterism::app {

/// From now on Ctrl-C (or a polite kill) lets the next call of a Progress throw Interrupted.
void stop_on_interrupt();

/// For work that ends by itself where it can be taken up again.
[[nodiscard]] bool stop_wanted();

}  // namespace asterism::app
