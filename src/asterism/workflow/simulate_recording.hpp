// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "asterism/core/progress.hpp"
#include "asterism/simulation/simulate.hpp"

namespace asterism {

enum class PictureFormat { Png, Pgm };

struct SimulateJob {
  std::filesystem::path out;  // the recording's folder
  SimulationOptions options;
  PictureFormat format =
      PictureFormat::Png;  // PGM: not packed, so two to three times the size, and much faster
};

struct SimulatedRecording {
  std::size_t frames = 0;
  std::size_t lost = 0;            // images that a camera lost
  std::size_t targets_seen = 0;    // in an image, at least 98 % visible
  std::size_t targets_hidden = 0;  // less than that
  std::size_t fallen = 0;          // targets that fell off by the last frame
  std::size_t knocked = 0;         // targets that stand beside their place by the last frame
  std::size_t scans = 0, scan_points = 0;
};

/// Makes all frames of the cell and writes them as a recording with truth: rig.yaml, bodies.toml,
/// frames.csv, left/ and right/ images or centres.csv, truth_poses.csv, truth_targets.csv, the cell itself as
/// cell.toml, where it has a platform what that says of itself as read_out.csv, and where it has scan passes
/// scans/NNN.ply, scans.csv and truth_scans/NNN.ply. frames.csv comes last: a folder that has it is whole.
/// Throws InputError when the cell is not sound or the folder cannot be written.
SimulatedRecording simulate_recording(const Cell& cell, const SimulateJob& job, const Progress& progress);

}  // namespace asterism
