// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "asterism/core/options.hpp"
#include "asterism/core/output_file.hpp"
#include "asterism/core/result.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {
namespace {

/// T10 names T10.S1.f1 but not T1.
bool named_by(const std::string& id, const std::string& name) {
  return id == name || (id.starts_with(name) && id[name.size()] == '.');
}

/// A prose figure's id, P.F14.mean_cost_S1, is found under its figure's name too.
bool selects(const std::string& name, const std::string& id) {
  return named_by(id, name) || (id.starts_with("P.") && named_by(id.substr(2), name));
}

}  // namespace

std::vector<LedgerRow> Reproduction::rows() const {
  std::vector<LedgerRow> all;
  for (const Chapter& chapter : chapters) all.insert(all.end(), chapter.rows.begin(), chapter.rows.end());
  return all;
}

Reproduction reproduce_paper(std::uint64_t seed, const Progress& progress) {
  const std::vector<std::function<Chapter()>> parts = {
      [] { return projection_chapter(); },  [] { return frames_chapter(); },
      [&] { return losses_chapter(seed); }, [&] { return layouts_chapter(seed); },
      [] { return motion_chapter(); },      [&] { return errors_chapter(seed); },
      [] { return scanning_chapter(); }};
  Reproduction reproduction;
  for (const auto& part : parts) {
    progress("reproducing the paper", reproduction.chapters.size(), parts.size());
    reproduction.chapters.push_back(part());
  }
  progress("reproducing the paper", parts.size(), parts.size());
  return reproduction;
}

Reproduction select(const Reproduction& all, const std::vector<std::string>& only) {
  if (only.empty()) return all;
  Reproduction selected;
  std::vector<bool> used(only.size(), false);
  const auto wanted = [&](const std::string& id) {
    bool any = false;
    for (std::size_t i = 0; i < only.size(); ++i) {
      const bool hit = selects(only[i], id);
      used[i] = used[i] || hit;
      any = any || hit;
    }
    return any;
  };
  std::vector<std::string> known;
  for (const Chapter& chapter : all.chapters) {
    Chapter part{chapter.title, {}, {}};
    for (const LedgerRow& row : chapter.rows) {
      known.push_back(row.claim.id);
      if (wanted(row.claim.id)) part.rows.push_back(row);
    }
    for (const Exhibit& exhibit : chapter.exhibits) {
      known.push_back(exhibit.id);
      if (wanted(exhibit.id)) part.exhibits.push_back(exhibit);
    }
    if (!part.rows.empty() || !part.exhibits.empty()) selected.chapters.push_back(std::move(part));
  }
  const auto missed = std::find(used.begin(), used.end(), false);
  if (missed != used.end()) {
    const std::string& name = only[static_cast<std::size_t>(missed - used.begin())];
    const std::string nearest = nearest_name(name, known);
    throw InputError(
        "--only",
        fmt::format("`{}` is no row, table or figure of the paper{}; ids are like T10, F14, T10.S1.f1", name,
                    nearest.empty() ? "" : "; did you mean `" + nearest + "`?"));
  }
  return selected;
}

VerdictCounts count_verdicts(const std::vector<LedgerRow>& rows) {
  VerdictCounts counts{};
  for (const LedgerRow& row : rows) ++counts[static_cast<std::size_t>(row.verdict)];
  return counts;
}

std::string ledger_csv(const std::vector<LedgerRow>& rows) {
  std::string csv = "id,where,quantity,published,computed,definition,verdict,reason\n";
  for (const LedgerRow& row : rows) {
    const std::string cells[] = {row.claim.id, row.claim.where, row.claim.quantity, row.claim.published,
                                 row.computed, row.definition,  words(row.verdict), row.reason};
    for (std::size_t i = 0; i < std::size(cells); ++i) csv += (i > 0 ? "," : "") + csv_cell(cells[i]);
    csv += "\n";
  }
  return csv;
}

void write_reproduction(const std::filesystem::path& folder, const Reproduction& reproduction,
                        std::uint64_t seed) {
  write_file(folder / "ledger.csv", ledger_csv(reproduction.rows()));
  write_file(folder / "reproduction.html", reproduction_html(reproduction, seed));
}

}  // namespace asterism
