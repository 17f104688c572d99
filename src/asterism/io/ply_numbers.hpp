// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "asterism/io/byte_stream.hpp"
#include "asterism/io/ply_header.hpp"

namespace asterism {

/// The numbers of a PLY file one after the other, bytes or words, from a stream that stands behind the
/// header.
class PlyNumbers {
 public:
  PlyNumbers(ByteStream& stream, const PlyHeader& header)
      : stream_(stream), encoding_(header.encoding), order_(header.order()), line_(header.lines + 1) {}

  double next(PlyNumber type);
  /// How many numbers of a list follow; complains when the file cannot hold them.
  std::size_t list_size(const PlyProperty& list);
  /// Complains when what follows cannot be so many of it.
  void check_count(const PlyElement& element) const;
  /// With the byte or the line.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  [[nodiscard]] std::string_view word();
  /// Bytes that one number takes at least.
  [[nodiscard]] std::size_t least(PlyNumber type) const;
  /// Bytes that follow; the last word needs no blank behind it.
  [[nodiscard]] std::size_t left() const;

  ByteStream& stream_;
  PlyEncoding encoding_;
  std::endian order_;
  std::size_t line_;
};

}  // namespace asterism
