// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "asterism/core/progress.hpp"
#include "asterism/reproduction/chapters.hpp"

namespace asterism {

/// The whole paper: published, computed, verdict.
struct Reproduction {
  std::vector<Chapter> chapters;
  [[nodiscard]] std::vector<LedgerRow> rows() const;
};

/// All of it. Same bits for the same seed on any number of threads but for the two rows of times.
[[nodiscard]] Reproduction reproduce_paper(std::uint64_t seed, const Progress& progress = no_progress);

/// What `only` names: the id of a row (T10.S1.f1), its beginning (T10, F14) or that of a figure. Throws
/// InputError for what names nothing.
[[nodiscard]] Reproduction select(const Reproduction& all, const std::vector<std::string>& only);

/// How many rows have each verdict, in the order of Verdict.
using VerdictCounts = std::array<std::size_t, 4>;
[[nodiscard]] VerdictCounts count_verdicts(const std::vector<LedgerRow>& rows);

/// id,where,quantity,published,computed,definition,verdict,reason
[[nodiscard]] std::string ledger_csv(const std::vector<LedgerRow>& rows);

/// One page that needs nothing else: figures, tables, and the ledger with a filter.
[[nodiscard]] std::string reproduction_html(const Reproduction& reproduction, std::uint64_t seed);

/// ledger.csv and reproduction.html into `folder`, which is made where it is missing.
void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction,
                        std::uint64_t seed);

}  // namespace asterism
