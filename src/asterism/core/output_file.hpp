// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace asterism {

/// A file that is whole or not there: it is written beside its place as NAME.partial and takes its name
/// in `finish`. What is written into a device (/dev/stdout) goes straight there.
/// Every failure (no such folder, no right to write, disk full) is an InputError that says what to do.
class OutputFile {
 public:
  /// What becomes of NAME.partial when the work breaks off before `finish`.
  enum class Unfinished { Remove, Keep };

  /// Makes the folder too where it is missing.
  explicit OutputFile(std::filesystem::path file, Unfinished unfinished = Unfinished::Remove);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(std::string_view text);
  /// Hands what was written to the system, so that a crash does not take it along.
  void flush();
  void finish();

 private:
  [[noreturn]] void fail(const std::string& doing, int error) const;

  std::filesystem::path file_, written_;
  Unfinished unfinished_;
  int descriptor_ = -1;
  std::string buffer_;
  long long size_ = 0;         // bytes in the file
  long long whole_lines_ = 0;  // of these, up to the last line's end: what is kept of a broken-off table
};

/// The whole of a small file at once.
void write_file(const std::filesystem::path& file, std::string_view text);

/// The whole of a file. Throws InputError naming it.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

}  // namespace asterism
