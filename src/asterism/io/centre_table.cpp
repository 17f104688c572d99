// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/centre_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "asterism/core/result.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {
namespace {

std::optional<Side> side_of(const CsvTable& table, std::size_t row) {
  const std::string& camera = table.text(row, "camera");
  if (camera.empty()) return std::nullopt;
  if (camera == "left") return Side::Left;
  if (camera == "right") return Side::Right;
  table.refuse(row, "camera", fmt::format("`{}` must be left or right", camera));
}

Mat2 covariance_of(const CsvTable& table, std::size_t row) {
  const double x = table.optional_number(row, "sigma_x_px").value_or(kUnstatedSigmaPx);
  const double y = table.optional_number(row, "sigma_y_px").value_or(kUnstatedSigmaPx);
  const double rho = table.optional_number(row, "rho_xy").value_or(0);
  if (!(x > 0)) table.refuse(row, "sigma_x_px", "must be positive");
  if (!(y > 0)) table.refuse(row, "sigma_y_px", "must be positive");
  if (!(std::abs(rho) < 1)) table.refuse(row, "rho_xy", "must lie between -1 and 1");
  Mat2 covariance;
  covariance << x * x, rho * x * y, rho * x * y, y * y;
  return covariance;
}

}  // namespace

std::vector<CentreRow> read_centre_rows(const std::filesystem::path& file) {
  const CsvTable table(file, {"x_px", "y_px"});
  std::vector<CentreRow> rows(table.rows());
  std::map<std::pair<int, int>, int> counts;  // of a frame and camera
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CentreRow& row = rows[i];
    row.frame = table.optional_integer(i, "frame").value_or(0);
    row.camera = side_of(table, i);
    const int place = counts[{row.frame, row.camera ? static_cast<int>(*row.camera) : -1}]++;
    row.index = table.optional_integer(i, "centre").value_or(place);
    if (row.index < 0) table.refuse(i, "centre", "must not be negative");
    row.image = table.text(i, "image");
    Ellipse& ellipse = row.centre.ellipse;
    ellipse.centre = {table.number(i, "x_px"), table.number(i, "y_px")};
    ellipse.semi_major = table.optional_number(i, "semi_major_px").value_or(0);
    ellipse.semi_minor = table.optional_number(i, "semi_minor_px").value_or(0);
    ellipse.angle_rad = rad_from_deg(table.optional_number(i, "angle_deg").value_or(0));
    row.centre.covariance = covariance_of(table, i);
    row.centre.amplitude = table.optional_number(i, "amplitude").value_or(0);
    row.centre.background = table.optional_number(i, "background").value_or(0);
    try {
      row.centre.flags = flags_of_text(table.text(i, "flags"));
    } catch (const InputError& error) {
      table.refuse(i, "flags", error.what());
    }
  }
  return rows;
}

CentreTable::CentreTable(const std::filesystem::path& file) : file_(file, OutputFile::Unfinished::Keep) {
  file_.write(
      "frame,camera,centre,image,x_px,y_px,semi_major_px,semi_minor_px,angle_deg,sigma_x_px,sigma_y_px,rho_"
      "xy,"
      "amplitude,background,flags\n");
}

void CentreTable::write(const CentreRow& row) {
  const char* camera = !row.camera ? "" : *row.camera == Side::Left ? "left" : "right";
  const Ellipse& ellipse = row.centre.ellipse;
  const Mat2& c = row.centre.covariance;
  const double sigma_x = std::sqrt(c(0, 0));
  const double sigma_y = std::sqrt(c(1, 1));
  file_.write(fmt::format(
      "{},{},{},{},{:.6f},{:.6f},{:.4f},{:.4f},{:.3f},{:.6f},{:.6f},{:.5f},{:.2f},{:.2f},{}\n", row.frame,
      camera, row.index, csv_cell(row.image), ellipse.centre.x(), ellipse.centre.y(), ellipse.semi_major,
      ellipse.semi_minor, deg_from_rad(ellipse.angle_rad), sigma_x, sigma_y, c(0, 1) / (sigma_x * sigma_y),
      row.centre.amplitude, row.centre.background, text_of_flags(row.centre.flags)));
}

void CentreTable::write(const StereoCentres& centres, const std::string& left_image,
                        const std::string& right_image) {
  for (const Side side : {Side::Left, Side::Right}) {
    const auto& found = side == Side::Left ? centres.left : centres.right;
    for (std::size_t i = 0; i < found.size(); ++i) {
      write({centres.frame, side, static_cast<int>(i), side == Side::Left ? left_image : right_image,
             found[i]});
    }
  }
}

std::vector<StereoCentres> stereo_centres(const std::vector<CentreRow>& rows, const std::string& where) {
  std::map<int, StereoCentres> frames;
  std::map<std::pair<int, Side>, std::map<int, const Centre*>> found;
  for (const CentreRow& row : rows) {
    if (!row.camera) throw InputError(where, "a row names no camera; column `camera` must be left or right");
    frames[row.frame].frame = row.frame;
    if (!found[{row.frame, *row.camera}].emplace(row.index, &row.centre).second) {
      throw InputError(where, fmt::format("frame {}: centre {} of the {} camera is given twice", row.frame,
                                          row.index, *row.camera == Side::Left ? "left" : "right"));
    }
  }
  for (const auto& [key, centres] : found) {
    StereoCentres& frame = frames[key.first];
    std::vector<Centre>& side = key.second == Side::Left ? frame.left : frame.right;
    for (const auto& [index, centre] : centres) {
      if (index != static_cast<int>(side.size())) {
        throw InputError(
            where, fmt::format("frame {}: centre {} of the {} camera is missing; they must count from 0 "
                               "without gaps",
                               key.first, side.size(), key.second == Side::Left ? "left" : "right"));
      }
      side.push_back(*centre);
    }
  }
  std::vector<StereoCentres> result;
  result.reserve(frames.size());
  for (auto& [frame, centres] : frames) result.push_back(std::move(centres));
  return result;
}

std::vector<CentreRow> rows_of_camera(const std::vector<CentreRow>& rows, Side side,
                                      const std::string& where) {
  std::vector<CentreRow> chosen;
  for (const CentreRow& row : rows) {
    if (row.camera && *row.camera != side) continue;
    chosen.push_back(row);
    chosen.back().camera = side;
  }
  if (chosen.empty() && !rows.empty()) {
    throw InputError(where,
                     fmt::format("holds no centres of the {} camera", side == Side::Left ? "left" : "right"));
  }
  return chosen;
}

}  // namespace asterism
