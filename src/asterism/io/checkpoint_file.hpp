// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "asterism/optimization/optimizer.hpp"

// A run of the optimiser on disk: a line of text that tells version, length and check sum, then the state.
// The file is replaced as a whole, and the one before stays beside it as NAME.previous: whenever the program
// is killed, one of them is whole.

namespace asterism {

void write_checkpoint(const std::filesystem::path& file, const OptimizerState& state);

/// Throws InputError for a file that is no checkpoint, of another version, cut short or damaged; the message
/// names NAME.previous where there is one.
[[nodiscard]] OptimizerState read_checkpoint(const std::filesystem::path& file);

/// Lets `optimizer` go on from there. Throws InputError, with the file's name, for another problem or options
/// that decide about the result; generations, evaluations and time may be others.
void resume_from_checkpoint(Optimizer& optimizer, const std::filesystem::path& file);

}  // namespace asterism
