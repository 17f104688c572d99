// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "asterism/measurement/cloud.hpp"

namespace asterism {

enum class CloudFormat { BinaryLittleEndian, Ascii };
enum class Coordinates { Double, Single };

/// A PLY file that CloudCompare, MeshLab and PCL read: x y z (double unless told), nx ny nz (float) where
/// there are normals, and each field as `scalar_NAME` (float; double where NAME ends in time_s). Nothing else
/// in its header.
void write_cloud(const std::filesystem::path& file, const Cloud& cloud,
                 CloudFormat format = CloudFormat::BinaryLittleEndian,
                 Coordinates coordinates = Coordinates::Double);

/// A cloud read piece by piece, so that memory does not grow with the file. Ascii or binary of either byte
/// order; `scalar_` is taken off names, colours and what is no number at a vertex are passed over, other
/// elements and faces too. A normal that is not finite becomes zero; a field may hold NaN.
/// Throws InputError with line or byte for: no PLY, no x y z, a cut-off file, a header that promises what is
/// not there.
class CloudReader {
 public:
  explicit CloudReader(const std::filesystem::path& file);
  ~CloudReader();
  /// As the header promises.
  [[nodiscard]] std::size_t points() const;
  /// The next points, at most so many; empty at the end. Points that are not finite are left out and counted.
  [[nodiscard]] Cloud next(std::size_t most);
  [[nodiscard]] std::size_t not_finite() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole of it. Throws InputError for a file without one finite point.
[[nodiscard]] Cloud read_cloud(const std::filesystem::path& file);

}  // namespace asterism
