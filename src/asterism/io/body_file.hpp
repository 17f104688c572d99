// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "asterism/cell/body.hpp"

namespace asterism {

/// Bodies from bodies.toml, a CSV table `body,id,x_mm,y_mm,z_mm[,nx,ny,nz,diameter_mm]`, or an NDI .rom
/// tool file (positions only; the body takes the file's name). Checked by check_bodies; throws InputError
/// with file and line.
[[nodiscard]] std::vector<Body> read_bodies(const std::filesystem::path& file);

/// As TOML.
void write_bodies(const std::filesystem::path& file, const std::vector<Body>& bodies);

}  // namespace asterism
