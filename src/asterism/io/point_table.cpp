// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/point_table.hpp"

#include <fmt/format.h>

#include <map>

#include "asterism/core/result.hpp"
#include "asterism/geometry/linear_algebra.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {
namespace {

Mat3 covariance_of(const CsvTable& table, std::size_t row) {
  if (!table.optional_number(row, "cxx")) return Mat3::Zero();
  const auto at = [&](const char* column) { return table.number(row, column); };
  Mat3 covariance;
  covariance << at("cxx"), at("cxy"), at("cxz"), at("cxy"), at("cyy"), at("cyz"), at("cxz"), at("cyz"),
      at("czz");
  if (!(symmetric_eigen(covariance).values(0) > 0)) {
    throw InputError(table.place(row), "the covariance cxx to czz is not positive definite");
  }
  return covariance;
}

}  // namespace

std::vector<FramePoints> read_points(const std::filesystem::path& file) {
  const CsvTable table(file, {"frame", "point", "x_mm", "y_mm", "z_mm"});
  std::map<int, std::map<int, Point>> frames;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Point point;
    point.in_tracker = {table.number(row, "x_mm"), table.number(row, "y_mm"), table.number(row, "z_mm")};
    point.covariance = covariance_of(table, row);
    point.epipolar_error_px = table.optional_number(row, "epipolar_px").value_or(0);
    point.left = table.optional_integer(row, "left").value_or(-1);
    point.right = table.optional_integer(row, "right").value_or(-1);
    if (!frames[table.integer(row, "frame")].emplace(table.integer(row, "point"), point).second) {
      table.refuse(row, "point", fmt::format("{} is given twice in this frame", table.integer(row, "point")));
    }
  }
  std::vector<FramePoints> result;
  for (const auto& [frame, points] : frames) {
    FramePoints& made = result.emplace_back(FramePoints{frame, {}});
    for (const auto& [index, point] : points) {
      if (index != static_cast<int>(made.points.size())) {
        throw InputError(file.string(),
                         fmt::format("frame {}: point {} is missing; they must count from 0 without gaps",
                                     frame, made.points.size()));
      }
      made.points.push_back(point);
    }
  }
  return result;
}

PointTable::PointTable(const std::filesystem::path& file) : file_(file, OutputFile::Unfinished::Keep) {
  file_.write("frame,point,left,right,x_mm,y_mm,z_mm,cxx,cxy,cxz,cyy,cyz,czz,epipolar_px\n");
}

void PointTable::write(int frame, const std::vector<Point>& points) {
  const auto index = [](int centre) { return centre < 0 ? std::string() : fmt::format("{}", centre); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    const Vec3& p = point.in_tracker;
    const Mat3& c = point.covariance;
    file_.write(
        fmt::format("{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.6e},{:.5f}\n",
                    frame, i, index(point.left), index(point.right), p.x(), p.y(), p.z(), c(0, 0), c(0, 1),
                    c(0, 2), c(1, 1), c(1, 2), c(2, 2), point.epipolar_error_px));
  }
}

}  // namespace asterism
