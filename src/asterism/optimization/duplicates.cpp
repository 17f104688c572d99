// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/duplicates.hpp"

#include <bit>
#include <cstring>

namespace asterism {
namespace {

/// Two chains of multiplications side by side. No secret is kept and equality is checked afterwards.
std::uint64_t hash_of(const Genes& genes) {
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;
  std::uint64_t a = genes.size() + 1, b = kOdd;
  std::size_t i = 0;
  for (; i + 1 < genes.size(); i += 2) {
    a = (std::rotl(a, 29) ^ std::bit_cast<std::uint64_t>(genes[i])) * kOdd;
    b = (std::rotl(b, 29) ^ std::bit_cast<std::uint64_t>(genes[i + 1])) * kOdd;
  }
  if (i < genes.size()) a = (std::rotl(a, 29) ^ std::bit_cast<std::uint64_t>(genes[i])) * kOdd;
  const std::uint64_t both = (a ^ std::rotl(b, 32)) * kOdd;
  return both ^ (both >> 32);
}

bool same_bits(const Genes& a, const Genes& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

void Duplicates::clear(std::size_t most) { table_.assign(std::bit_ceil(2 * most + 1), Entry{0, nullptr}); }

bool Duplicates::add(const Genes& genes) {
  const std::uint64_t hash = hash_of(genes);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t slot = hash & mask;; slot = (slot + 1) & mask) {
    Entry& entry = table_[slot];
    if (entry.genes == nullptr) {
      entry = {hash, &genes};
      return true;
    }
    if (entry.hash == hash && same_bits(*entry.genes, genes)) return false;
  }
}

}  // namespace asterism
