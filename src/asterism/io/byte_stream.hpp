// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace asterism {

/// A file read piece by piece from its begin to its end, however large it is.
class ByteStream {
 public:
  /// Throws InputError for a file that cannot be read.
  explicit ByteStream(std::filesystem::path file);
  /// What was read already; `file` is for messages only.
  ByteStream(std::string_view bytes, std::filesystem::path file)
      : file_(std::move(file)), buffer_(bytes), read_(bytes.size()), size_(bytes.size()) {}

  /// The next bytes: so many or more, fewer only at the end of the file.
  [[nodiscard]] std::string_view ready(std::size_t count);
  /// Goes on behind so many of those that are ready.
  void take(std::size_t count) { begin_ += count; }

  /// Bytes before the next, and from there to the end.
  [[nodiscard]] std::size_t at() const { return read_ - (buffer_.size() - begin_); }
  [[nodiscard]] std::size_t left() const { return size_ - at(); }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string buffer_;
  std::size_t begin_ = 0;            // of what is not taken, in the buffer
  std::size_t read_ = 0, size_ = 0;  // bytes of the file
};

}  // namespace asterism
