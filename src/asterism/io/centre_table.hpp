// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asterism/camera/stereo_rig.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/measurement/frame.hpp"

namespace asterism {

/// One row of a centres CSV.
struct CentreRow {
  int frame = 0;
  std::optional<Side> camera;  // empty: the file does not say
  int index = 0;               // column `centre`: of this camera in this frame
  std::string image;
  Centre centre;
};

/// Taken for each axis where a file gives no sigma.
inline constexpr double kUnstatedSigmaPx = 0.05;

/// Only `x_px,y_px` must be there. A missing frame is 0, a missing centre the row's place among those of
/// its frame and camera, a missing sigma kUnstatedSigmaPx.
[[nodiscard]] std::vector<CentreRow> read_centre_rows(const std::filesystem::path& file);

/// Writes rows as they come; the file is whole after finish.
class CentreTable {
 public:
  explicit CentreTable(const std::filesystem::path& file);
  void write(const CentreRow& row);
  void write(const StereoCentres& centres, const std::string& left_image, const std::string& right_image);
  void flush() { file_.flush(); }
  void finish() { file_.finish(); }

 private:
  OutputFile file_;
};

/// The rows of both cameras by frame, in order. `frames` with a time get it; others have time 0.
/// Throws InputError for a row without camera, and for a centre index that is not the row's place.
[[nodiscard]] std::vector<StereoCentres> stereo_centres(const std::vector<CentreRow>& rows,
                                                        const std::string& where);

/// Rows of one camera (or of none named) from a file that holds that camera's or both; `side` becomes
/// theirs.
[[nodiscard]] std::vector<CentreRow> rows_of_camera(const std::vector<CentreRow>& rows, Side side,
                                                    const std::string& where);

}  // namespace asterism
