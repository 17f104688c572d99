// SPDX-License-Identifier: Apache-2.0
#include "asterism/report/whole_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "asterism/core/result.hpp"

namespace asterism {

void write_whole_file(const std::filesystem::path& path, std::string_view content) {
  std::filesystem::path beside = path;
  beside += ".part";
  const auto fail = [&](const std::string& why) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw InputError(path.string(), "cannot be written: " + why);
  };

  errno = 0;
  std::ofstream file(beside, std::ios::binary | std::ios::trunc);
  if (!file) fail(std::strerror(errno));
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) fail(errno != 0 ? std::strerror(errno) : "the disk may be full");

  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) fail(error.message());
}

}  // namespace asterism
