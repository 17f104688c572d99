// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/scan_folder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/cloud_file.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {
namespace {

constexpr std::size_t kAtOnce = 1 << 20;  // points

/// A piece of a scan's file as part of the scan.
void append(ReadScan& read, const Cloud& piece, const std::vector<double>* times) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (times != nullptr && !std::isfinite((*times)[i])) {
      ++read.not_finite;
      continue;
    }
    read.scan.in_scanner.emplace_back(piece.points[i].cast<float>());
    if (times != nullptr) read.scan.times_s.push_back((*times)[i]);
    if (!piece.normals.empty()) read.scan.normals.push_back(piece.normals[i]);
  }
}

}  // namespace

std::vector<ScanEntry> read_scan_entries(const std::filesystem::path& folder) {
  const CsvTable table(folder / "scans.csv", {"scan", "file"});
  std::vector<ScanEntry> entries;
  std::set<int> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ScanEntry entry;
    entry.scan = table.integer(row, "scan");
    if (!numbers.insert(entry.scan).second)
      table.refuse(row, "scan", fmt::format("scan {} is given twice", entry.scan));
    entry.file = table.text(row, "file");
    if (entry.file.empty()) table.refuse(row, "file", "is empty; the scan's PLY file is needed");
    if (!std::filesystem::is_regular_file(folder / entry.file))
      table.refuse(row, "file", fmt::format("`{}` is not there", (folder / entry.file).string()));
    entry.time_s = table.optional_number(row, "time_s");
    if (!table.text(row, "body").empty()) entry.body = table.text(row, "body");
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::size_t read_scan_pieces(const std::filesystem::path& folder, const ScanEntry& entry, std::size_t most,
                             const std::function<void(Scan&&)>& take) {
  CloudReader reader(folder / entry.file);
  std::size_t not_finite = 0;
  for (std::size_t left = reader.points(); left > 0; left -= std::min(left, most)) {
    const Cloud piece = reader.next(std::min(left, most));
    const std::vector<double>* times = piece.field("time_s");
    if (times == nullptr && !entry.time_s) {
      throw InputError((folder / entry.file).string(),
                       fmt::format("no time is told for scan {}: give its points `scalar_time_s` or it a "
                                   "`time_s` in scans.csv",
                                   entry.scan));
    }
    ReadScan read;
    read.scan.number = entry.scan;
    read.scan.body = entry.body;
    append(read, piece, times);
    not_finite += read.not_finite;
    read.scan.time_s = entry.time_s.value_or(read.scan.times_s.empty() ? 0 : read.scan.times_s.front());
    if (!read.scan.in_scanner.empty()) take(std::move(read.scan));
  }
  return not_finite + reader.not_finite();
}

ReadScan read_scan(const std::filesystem::path& folder, const ScanEntry& entry) {
  ReadScan read;
  read.scan.number = entry.scan;
  read.scan.body = entry.body;
  read.scan.time_s = entry.time_s.value_or(0);
  read.not_finite = read_scan_pieces(folder, entry, kAtOnce, [&](Scan&& piece) {
    Scan& scan = read.scan;
    if (!entry.time_s && scan.in_scanner.empty()) scan.time_s = piece.time_s;
    scan.in_scanner.insert(scan.in_scanner.end(), piece.in_scanner.begin(), piece.in_scanner.end());
    scan.times_s.insert(scan.times_s.end(), piece.times_s.begin(), piece.times_s.end());
    scan.normals.insert(scan.normals.end(), piece.normals.begin(), piece.normals.end());
  });
  return read;
}

ScanEntry entry_of(const Scan& scan) {
  return {scan.number, fmt::format("scans/{:03}.ply", scan.number), scan.time_s, scan.body};
}

void write_scan(const std::filesystem::path& folder, const Scan& scan) {
  Cloud cloud;
  cloud.points.reserve(scan.in_scanner.size());
  for (const Vec3f& point : scan.in_scanner) cloud.points.emplace_back(point.cast<double>());
  cloud.normals = scan.normals;
  if (!scan.times_s.empty()) cloud.fields.push_back({"time_s", scan.times_s});
  write_cloud(folder / entry_of(scan).file, cloud, CloudFormat::BinaryLittleEndian, Coordinates::Single);
}

void write_scan_entries(const std::filesystem::path& folder, const std::vector<ScanEntry>& entries) {
  std::string text = "scan,file,time_s,body\n";
  for (const ScanEntry& entry : entries) {
    text += fmt::format("{},{},{},{}\n", entry.scan, csv_cell(entry.file),
                        entry.time_s ? fmt::format("{}", *entry.time_s) : "", csv_cell(entry.body));
  }
  write_file(folder / "scans.csv", text);
}

}  // namespace asterism
