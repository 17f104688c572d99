// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "asterism/optimization/problem.hpp"

namespace asterism {

/// A set of genomes that tells whether one, bit for bit, is in it. It keeps pointers: what was added must
/// stay where it is until `clear`.
class Duplicates {
 public:
  /// Empties the set and makes room for so many.
  void clear(std::size_t most);
  /// False when an equal one is there already.
  bool add(const Genes& genes);

 private:
  struct Entry {
    std::uint64_t hash;
    const Genes* genes;
  };
  std::vector<Entry> table_;  // open addressing; its size is a power of two
};

}  // namespace asterism
