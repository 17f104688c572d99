// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cinttypes>
#include <cstdio>
#include <string>
#include <system_error>

#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/crc32.hpp"

namespace asterism {
namespace {

constexpr std::string_view kTitle = "asterism checkpoint,";
constexpr int kVersion = 1;  // of the bytes that to_bytes(OptimizerState) writes

std::filesystem::path previous_of(const std::filesystem::path& file) {
  std::filesystem::path previous = file;
  return previous += ".previous";
}

/// A second name for the file that is about to be replaced, so that `file` is never missing.
void keep_previous(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return;
  std::filesystem::remove(previous_of(file), error);
  std::filesystem::create_hard_link(file, previous_of(file), error);
  if (error)  // a file system without links
    std::filesystem::copy_file(file, previous_of(file), std::filesystem::copy_options::overwrite_existing,
                               error);
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string what) {
  std::error_code error;
  if (std::filesystem::exists(previous_of(file), error))
    what += fmt::format("; the checkpoint before it is {}", previous_of(file).string());
  throw InputError(file.string(), what);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const OptimizerState& state) {
  const std::string bytes = to_bytes(state);
  OutputFile output(file);
  output.write(
      fmt::format("{} version {}, {} bytes, crc {:08x}\n", kTitle, kVersion, bytes.size(), crc32(bytes)));
  output.write(bytes);
  output.flush();
  keep_previous(file);
  output.finish();
}

OptimizerState read_checkpoint(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  if (!text.starts_with(kTitle))
    refuse(file, "is no checkpoint: such a file starts with \"" + std::string(kTitle) + "\"");
  const std::size_t line = text.find('\n');
  int version = 0;
  std::uint64_t size = 0;
  std::uint32_t crc = 0;
  const std::string head = text.substr(kTitle.size(), line - kTitle.size());
  const int told =
      std::sscanf(head.c_str(), " version %d, %" SCNu64 " bytes, crc %" SCNx32, &version, &size, &crc);
  if (told >= 1 && version != kVersion)
    refuse(file, fmt::format("is a checkpoint of version {}; this program goes on from version {} only",
                             version, kVersion));
  if (line == std::string::npos || told != 3) refuse(file, "is cut short or damaged in its first line");
  const std::string bytes = text.substr(line + 1);
  if (bytes.size() < size)
    refuse(file, fmt::format("is cut short: {} of {} bytes are there", bytes.size(), size));
  if (bytes.size() > size || crc32(bytes) != crc) refuse(file, "is damaged: its check sum does not hold");
  return optimizer_state_from_bytes(bytes);
}

void resume_from_checkpoint(Optimizer& optimizer, const std::filesystem::path& file) {
  const OptimizerState state = read_checkpoint(file);
  try {
    optimizer.restore(state);
  } catch (const InputError& error) {
    throw InputError(file.string(), error.what());
  }
}

}  // namespace asterism
