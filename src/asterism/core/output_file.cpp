// SPDX-License-Identifier: Apache-2.0
#include "asterism/core/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

bool is_device(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path file, Unfinished unfinished)
    : file_(std::move(file)), written_(file_), unfinished_(unfinished) {
  if (std::filesystem::is_directory(file_)) throw InputError(file_.string(), "is a folder; name a file");
  if (!is_device(file_)) written_ += ".partial";
  std::error_code error;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), error);
  if (error) throw InputError(file_.parent_path().string(), "the folder cannot be made: " + error.message());
  descriptor_ = ::open(written_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot be written", errno);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      written_(std::move(other.written_)),
      unfinished_(other.unfinished_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      buffer_(std::move(other.buffer_)),
      size_(other.size_),
      whole_lines_(other.whole_lines_) {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  try {
    if (unfinished_ == Unfinished::Keep) flush();
  } catch (const InputError&) {  // NOLINT(bugprone-empty-catch)
    // The failure that broke off the work has been told; what could be written is kept.
  }
  if (size_ > whole_lines_ && ::ftruncate(descriptor_, whole_lines_) != 0) unfinished_ = Unfinished::Remove;
  ::close(descriptor_);
  if (written_ != file_ && (unfinished_ == Unfinished::Remove || whole_lines_ == 0))
    ::unlink(written_.c_str());
}

void OutputFile::write(std::string_view text) {
  require(descriptor_ >= 0, "nothing is written to a finished file");
  buffer_ += text;
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::flush() {
  std::string_view left = buffer_;
  while (!left.empty()) {
    const ssize_t count = ::write(descriptor_, left.data(), left.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int error = errno;
      buffer_.clear();
      fail("cannot be written", error);
    }
    const std::size_t line_end = left.substr(0, static_cast<std::size_t>(count)).rfind('\n');
    if (line_end != std::string_view::npos) whole_lines_ = size_ + static_cast<long long>(line_end) + 1;
    size_ += count;
    left.remove_prefix(static_cast<std::size_t>(count));
  }
  buffer_.clear();
}

void OutputFile::finish() {
  flush();
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0) fail("cannot be written", errno);
  if (written_ != file_ && std::rename(written_.c_str(), file_.c_str()) != 0)
    fail("cannot take its name", errno);
}

void OutputFile::fail(const std::string& doing, int error) const {
  std::string advice = "choose another place with --out";
  if (error == ENOSPC || error == EDQUOT || error == EFBIG)
    advice = "make room or choose another place with --out";
  throw InputError(file_.string(), fmt::format("{}: {}; {}", doing, std::strerror(error), advice));
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  OutputFile output(file);
  output.write(text);
  output.finish();
}

std::string read_file(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw InputError(file.string(), "is a folder; a file is needed");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), fmt::format("cannot be read: {}", std::strerror(errno)));
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

}  // namespace asterism
