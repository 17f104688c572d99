// SPDX-License-Identifier: Apache-2.0
#include "asterism/reproduction/reproduce.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "common.hpp"

namespace asterism::app {
namespace {

struct Call {
  std::string out;
  std::vector<std::string> only;
};

nlohmann::ordered_json json_of(const LedgerRow& row) {
  return {{"id", row.claim.id},
          {"where", row.claim.where},
          {"quantity", row.claim.quantity},
          {"published", row.claim.published},
          {"computed", row.computed},
          {"definition", row.definition},
          {"verdict", words(row.verdict)},
          {"reason", row.reason}};
}

void run(const Call& call, const Common& common) {
  const Reproduction reproduction = select(reproduce_paper(common.seed, make_progress(common)), call.only);
  write_reproduction(call.out, reproduction, common.seed);
  const std::vector<LedgerRow> rows = reproduction.rows();
  const VerdictCounts counts = count_verdicts(rows);
  std::string text = fmt::format("{} quantities of the paper\n", rows.size());
  nlohmann::ordered_json json = {{"seed", common.seed}, {"out", call.out}, {"rows", rows.size()}};
  for (std::size_t v = 0; v < counts.size(); ++v) {
    const std::string verdict = words(static_cast<Verdict>(v));
    text += fmt::format("  {:>4}  {}\n", counts[v], verdict);
    json["verdicts"][verdict] = counts[v];
  }
  text += fmt::format("→ {0}/ledger.csv, {0}/reproduction.html\n", call.out);
  json["ledger"] = nlohmann::ordered_json::array();
  for (const LedgerRow& row : rows) json["ledger"].push_back(json_of(row));
  print_result(common, json, text);
}

}  // namespace

void add_reproduce(CLI::App& root, Common& common) {
  CLI::App* command =
      add_command(root, common, "reproduce", "the paper's tables and figures: published, computed, verdict",
                  "asterism reproduce --out paper");
  auto call = std::make_shared<Call>();
  command->add_option("--out", call->out, "folder for ledger.csv and reproduction.html")->required();
  command->add_option("--only", call->only, "rows, tables or figures by id: T10, F14, T10.S1.f1 …");
  on_call(*command, common, [=, &common] { run(*call, common); });
}

}  // namespace asterism::app
