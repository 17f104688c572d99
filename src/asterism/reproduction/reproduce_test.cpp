// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/reproduce.hpp"

#include <gtest/gtest.h>

#include <set>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/parallel.hpp"
#include "asterism/io/csv_file.hpp"

namespace asterism {
namespace {

const Reproduction& whole() {
  static const Reproduction reproduction = reproduce_paper(1);
  return reproduction;
}

bool is_a_time(const LedgerRow& row) {
  return row.claim.id.ends_with("_time") || row.claim.id == "time" || row.claim.id == "time2";
}

TEST(ReproducePaper, GivesEveryRowAVerdictAndAReasonWhereItFails) {
  std::set<std::string> ids;
  for (const LedgerRow& row : whole().rows()) {
    EXPECT_TRUE(ids.insert(row.claim.id).second) << "twice: " << row.claim.id;
    EXPECT_FALSE(words(row.verdict).empty());
    EXPECT_FALSE(row.claim.where.empty() || row.claim.quantity.empty() || row.claim.published.empty())
        << row.claim.id;
    const bool fails = row.verdict == Verdict::Mismatch || row.verdict == Verdict::CannotBeDetermined;
    EXPECT_TRUE(!fails || !row.reason.empty()) << row.claim.id;
    EXPECT_TRUE(row.verdict == Verdict::CannotBeDetermined || !row.computed.empty()) << row.claim.id;
  }
}

TEST(ReproducePaper, DrawsEveryFigureAndTableThatCanBeComputed) {
  std::set<std::string> drawn;
  for (const Chapter& chapter : whole().chapters) {
    for (const Exhibit& exhibit : chapter.exhibits) {
      EXPECT_TRUE(drawn.insert(exhibit.id).second) << exhibit.id;
      EXPECT_GT(exhibit.html.size(), 200U) << exhibit.id;
      EXPECT_EQ(exhibit.html.find("nan"), std::string::npos) << exhibit.id;
    }
  }
  for (const char* id : {"F1",  "F2",  "F3",  "F4",  "F5",  "F6",  "F7",  "F8",  "F9",  "F10", "F11",
                         "F12", "F13", "F14", "F17", "F18", "F19", "F20", "F21", "F22", "F23", "F24",
                         "T1",  "T2",  "T9",  "T10", "T11", "T13", "T14", "T15", "T16"}) {
    EXPECT_TRUE(drawn.contains(id)) << id;
  }
}

TEST(ReproducePaper, GivesTheSameBitsForAnyThreadCountButForTimes) {
  set_thread_count(1);
  const std::vector<LedgerRow> one = reproduce_paper(1).rows();
  set_thread_count(0);
  const std::vector<LedgerRow> many = whole().rows();
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (is_a_time(one[i])) continue;
    EXPECT_EQ(one[i].computed, many[i].computed) << one[i].claim.id;
    EXPECT_EQ(one[i].reason, many[i].reason) << one[i].claim.id;
  }
}

TEST(ReproducePaper, KeepsItsVerdictsWithOtherSeeds) {
  const std::vector<LedgerRow> first = whole().rows();
  for (const std::uint64_t seed : {2U, 3U}) {
    const std::vector<LedgerRow> other = reproduce_paper(seed).rows();
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_EQ(first[i].verdict, other[i].verdict) << first[i].claim.id << " with seed " << seed;
    }
  }
}

TEST(Select, FindsRowsAndFiguresByIdOrItsBeginning) {
  EXPECT_EQ(select(whole(), {"T10.S1.f1"}).rows().size(), 1U);
  EXPECT_EQ(select(whole(), {"T10"}).rows().size(), 15U);
  EXPECT_EQ(select(whole(), {"T1"}).rows().size(), 0U);  // a table alone
  EXPECT_EQ(select(whole(), {"T1"}).chapters.at(0).exhibits.size(), 1U);
  EXPECT_GE(select(whole(), {"F14"}).rows().size(), 22U);  // with the prose's numbers of the figure
  EXPECT_EQ(select(whole(), {}).rows().size(), whole().rows().size());
}

TEST(Select, NamesTheNearestForAnUnknownId) {
  EXPECT_TELLS(input_error_of([] { return select(whole(), {"T10.S1.f9"}); }), "did you mean `T10.S1.f1`?");
  EXPECT_TELLS(input_error_of([] {
                 return select(whole(), {"F14", "nonsense"});
               }),
               "`nonsense` is no row, table or figure of the paper");
}

TEST(WriteReproduction, WritesALedgerThatReadsBackAndOnePageWithoutLinksOut) {
  const TestFolder folder;
  write_reproduction(folder / "paper", whole(), 1);
  const CsvTable table(folder / "paper/ledger.csv", {"id", "where", "quantity", "published", "computed",
                                                     "definition", "verdict", "reason"});
  const std::vector<LedgerRow> rows = whole().rows();
  ASSERT_EQ(table.rows(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(table.text(i, "id"), rows[i].claim.id);
    EXPECT_EQ(table.text(i, "verdict"), words(rows[i].verdict));
  }
  const std::string page = folder.read("paper/reproduction.html");
  EXPECT_EQ(page.find("http"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST(WriteReproduction, SaysWhenTheFolderCannotBeMade) {
  const TestFolder folder;
  const auto file = folder.write("file", "x");
  EXPECT_TELLS(input_error_of([&] { write_reproduction(file / "paper", whole(), 1); }), "file");
}

}  // namespace
}  // namespace asterism
