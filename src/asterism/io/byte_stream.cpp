// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/byte_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "asterism/core/result.hpp"

namespace asterism {
namespace {

constexpr std::size_t kPiece = 1 << 18;

}  // namespace

ByteStream::ByteStream(std::filesystem::path file) : file_(std::move(file)) {
  if (std::filesystem::is_directory(file_)) throw InputError(file_.string(), "is a folder; a file is needed");
  stream_.open(file_, std::ios::binary);
  if (!stream_) throw InputError(file_.string(), fmt::format("cannot be read: {}", std::strerror(errno)));
  std::error_code error;
  size_ = std::filesystem::file_size(file_, error);
  if (error) throw InputError(file_.string(), "is no regular file; its size must be known");
}

std::string_view ByteStream::ready(std::size_t count) {
  const std::size_t held = buffer_.size() - begin_;
  if (held < count && read_ < size_) {
    buffer_.erase(0, begin_);
    begin_ = 0;
    const std::size_t more = std::min(std::max(count - held, kPiece), size_ - read_);
    buffer_.resize(held + more);
    stream_.read(buffer_.data() + held, static_cast<std::streamsize>(more));
    const auto got = static_cast<std::size_t>(stream_.gcount());
    buffer_.resize(held + got);
    read_ += got;
    if (got < more) size_ = read_;  // it has been cut off since
  }
  return std::string_view(buffer_).substr(begin_);
}

}  // namespace asterism
