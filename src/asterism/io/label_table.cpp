// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/label_table.hpp"

#include <fmt/format.h>

#include "asterism/core/result.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {

std::vector<LabelRow> read_labels(const std::filesystem::path& file) {
  const CsvTable table(file, {"frame", "point", "body", "target"});
  std::vector<LabelRow> rows(table.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    LabelRow& row = rows[i];
    row.frame = table.integer(i, "frame");
    row.point = table.integer(i, "point");
    row.body = table.text(i, "body");
    row.target = table.text(i, "target");
    const std::string& status = table.text(i, "status");
    if (status == "AMBIGUOUS") {
      row.status = LabelStatus::Ambiguous;
    } else if (!status.empty() && status != "OK") {
      table.refuse(i, "status", fmt::format("`{}` must be OK or AMBIGUOUS", status));
    }
    row.margin_mm = table.optional_number(i, "margin_mm").value_or(0);
  }
  return rows;
}

LabelTable::LabelTable(const std::filesystem::path& file, std::vector<Body> bodies)
    : file_(file, OutputFile::Unfinished::Keep), bodies_(std::move(bodies)) {
  file_.write("frame,point,body,target,status,margin_mm\n");
}

void LabelTable::write(int frame, std::size_t points, const std::vector<BodyLabels>& labels) {
  std::vector<std::string> cells(points, ",,,");
  for (const BodyLabels& found : labels) {
    const Body& body = bodies_.at(static_cast<std::size_t>(found.body));
    const char* status = found.status == LabelStatus::Ok ? "OK" : "AMBIGUOUS";
    for (const LabelledPoint& label : found.points) {
      const std::string& target = body.targets.at(static_cast<std::size_t>(label.target)).id;
      cells.at(static_cast<std::size_t>(label.point)) =
          fmt::format("{},{},{},{:.4f}", csv_cell(body.name), csv_cell(target), status, found.margin_mm);
    }
  }
  for (std::size_t i = 0; i < points; ++i) file_.write(fmt::format("{},{},{}\n", frame, i, cells[i]));
}

}  // namespace asterism
