// SPDX-License-Identifier: Apache-2.0
#include "asterism/optimization/duplicates.hpp"

#include <bit>
#include <cstring>

namespace asterism {
namespace {

constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;

std::uint64_t mixed(std::uint64_t chain, double gene) {
  return (std::rotl(chain, 29) ^ std::bit_cast<std::uint64_t>(gene)) * kOdd;
}

/// Four chains of multiplications side by side. No secret is kept and equality is checked afterwards.
std::uint64_t hash_of(const Genes& genes) {
  std::uint64_t a = genes.size(), b = kOdd, c = ~kOdd, d = kOdd >> 1;
  std::size_t i = 0;
  for (; i + 3 < genes.size(); i += 4) {
    a = mixed(a, genes[i]);
    b = mixed(b, genes[i + 1]);
    c = mixed(c, genes[i + 2]);
    d = mixed(d, genes[i + 3]);
  }
  for (; i < genes.size(); ++i) a = mixed(a, genes[i]);
  const std::uint64_t all = (((a * kOdd ^ b) * kOdd ^ c) * kOdd ^ d) * kOdd;
  return all ^ (all >> 32);
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
