// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "asterism/reproduction/reproduce.hpp"
#include "asterism/reproduction/svg.hpp"

namespace asterism {
namespace {

const char* const kStyle = R"(
:root{color-scheme:light dark;--ground:#fbfbf9;--card:#fff;--ink:#20252b;--soft:#68727d;--rule:#dfe2e6;--grid:#e9ebee;
--s1:#1f6fb4;--s2:#c8501e;--s3:#1d8a68;--s4:#a3559b;--s5:#b98210;--good:#1d7d4f;--mc:#1f6fb4;--bad:#b3351b;--open:#7a6a2b}
@media(prefers-color-scheme:dark){:root{--ground:#15181c;--card:#1c2026;--ink:#e4e7ea;--soft:#98a2ad;--rule:#333a42;--grid:#2a3037;
--s1:#6db1ea;--s2:#ef8a5a;--s3:#58c79f;--s4:#d18ccb;--s5:#e2b34c;--good:#62c792;--mc:#6db1ea;--bad:#f08a72;--open:#d4bf6a}}
*{box-sizing:border-box}html{scroll-behavior:smooth}
body{margin:0;background:var(--ground);color:var(--ink);font:16px/1.55 system-ui,"Segoe UI",Roboto,"Helvetica Neue",sans-serif}
main{max-width:1120px;margin:0 auto;padding:28px 22px 80px}
h1{font-size:1.75rem;line-height:1.25;margin:.2em 0}h2{font-size:1.3rem;margin:2.6em 0 .6em;border-bottom:1px solid var(--rule);padding-bottom:.3em}
h3{font-size:1.02rem;margin:0 0 .3em}p{margin:.4em 0}.lead{color:var(--soft);max-width:70ch}
nav{display:flex;flex-wrap:wrap;gap:4px 16px;margin:1em 0;font-size:.92rem}a{color:var(--s1)}
.counts{display:flex;flex-wrap:wrap;gap:12px;margin:1.4em 0}
.counts button{font:inherit;color:inherit;text-align:left;flex:1 1 190px;background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:10px 16px;border-left:5px solid var(--c);cursor:pointer}
.counts button[aria-pressed=true]{outline:2px solid var(--c)}
.counts b{display:block;font-size:1.6rem;line-height:1.2}
.exhibit{background:var(--card);border:1px solid var(--rule);border-radius:10px;padding:16px 18px;margin:14px 0}
.exhibits{columns:2 420px;column-gap:16px}.exhibits .exhibit{break-inside:avoid;margin:0 0 16px}
.exhibits .exhibit:has(.row),.exhibits .exhibit:has(th:nth-child(6)){column-span:all}
.exhibit .caption{color:var(--soft);font-size:.92rem;max-width:90ch}
figure{margin:8px 0}.row{display:flex;flex-wrap:wrap;gap:10px}.row figure{flex:1 1 280px;min-width:0}
figcaption{font-size:.88rem;color:var(--soft);text-align:center}
svg{width:100%;height:auto;display:block;margin:0 auto;font-family:inherit}
svg .ink{stroke:var(--ink);fill:none;stroke-width:1.3}svg .soft{stroke:var(--soft);fill:none;stroke-width:1}
svg .s1{stroke:var(--s1);fill:none;stroke-width:1.6}svg .s2{stroke:var(--s2);fill:none;stroke-width:1.6}svg .s3{stroke:var(--s3);fill:none;stroke-width:1.6}
svg .s4{stroke:var(--s4);fill:none;stroke-width:1.6}svg .s5{stroke:var(--s5);fill:none;stroke-width:1.6}
svg .ink.filled{fill:var(--ink);stroke:none}svg .soft.filled{fill:var(--soft);stroke:none;opacity:.55}
svg .s1.filled{fill:var(--s1);stroke:none}svg .s2.filled{fill:var(--s2);stroke:none}svg .s3.filled{fill:var(--s3);stroke:none}
svg .s4.filled{fill:var(--s4);stroke:none}svg .s5.filled{fill:var(--s5);stroke:none}
svg .faint{opacity:.28}svg .dashed{stroke-dasharray:5 4}svg .hollow,svg .curve{fill:none}svg .curve{stroke-linejoin:round}
svg .grid{stroke:var(--grid);stroke-width:1}svg .axis{stroke:var(--soft);stroke-width:1.1}
svg .box{fill:var(--ground);stroke:var(--soft);stroke-width:1.2}svg .question{stroke:var(--s2)}
svg text{fill:var(--ink);font-size:13px}svg .tick{fill:var(--soft);font-size:12px}svg .note{font-size:12px}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:5px 12px 5px 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--rule)}th{font-weight:600;color:var(--soft)}
.ledger{width:100%;margin-top:14px;font-size:.88rem}.ledger td:first-child{white-space:nowrap;color:var(--soft);font-size:.82rem}
.ledger .computed,.ledger .published{overflow-wrap:anywhere}.ledger small{color:var(--soft);display:block;max-width:60ch}
.verdict{font-weight:600}.v0{--c:var(--good)}.v1{--c:var(--mc)}.v2{--c:var(--bad)}.v3{--c:var(--open)}.verdict.v0,.verdict.v1,.verdict.v2,.verdict.v3{color:var(--c)}
tr[hidden]{display:none}
@media(max-width:640px){.ledger thead{display:none}.ledger tr{display:block;padding:8px 0;border-bottom:1px solid var(--rule)}.ledger td{display:block;border:0;padding:1px 0}
.ledger td[data-name]::before{content:attr(data-name) ": ";color:var(--soft)}}
@media print{.counts button{break-inside:avoid}.exhibit{break-inside:avoid}}
)";

// A click on a verdict's count shows its rows alone; another click shows all.
const char* const kScript = R"(
const buttons=[...document.querySelectorAll('.counts button')],rows=[...document.querySelectorAll('.ledger tr[data-v]')];
for(const b of buttons)b.onclick=()=>{const on=b.getAttribute('aria-pressed')!=='true';
for(const o of buttons)o.setAttribute('aria-pressed',o===b&&on);
for(const r of rows)r.hidden=on&&r.dataset.v!==b.dataset.v;};
)";

std::string counts_html(const VerdictCounts& counts) {
  std::string html = "<div class=\"counts\">";
  for (std::size_t v = 0; v < counts.size(); ++v) {
    html += fmt::format("<button class=\"v{0}\" data-v=\"{0}\" aria-pressed=\"false\"><b>{1}</b>{2}</button>",
                        v, counts[v], words(static_cast<Verdict>(v)));
  }
  return html + "</div>\n";
}

std::string row_html(const LedgerRow& row) {
  const int v = static_cast<int>(row.verdict);
  const bool because = row.verdict == Verdict::Mismatch || row.verdict == Verdict::CannotBeDetermined;
  const std::string reason =
      row.reason.empty()
          ? ""
          : fmt::format("<small>{}{}</small>", because ? "because: " : "", html_text(row.reason));
  return fmt::format(
      "<tr data-v=\"{0}\" id=\"{1}\"><td>{1}</td><td>{2}<small>{3}</small></td><td class=\"published\" "
      "data-name=\"published\">{4}</td>"
      "<td class=\"computed\" data-name=\"computed\">{5}<small>{6}</small></td><td><span class=\"verdict "
      "v{0}\">{7}</span>{8}</td></tr>\n",
      v, html_text(row.claim.id), html_text(row.claim.quantity), html_text(row.claim.where),
      html_text(row.claim.published), html_text(row.computed), html_text(row.definition), words(row.verdict),
      reason);
}

std::string exhibit_html(const Exhibit& exhibit) {
  return fmt::format(
      "<section class=\"exhibit\" id=\"{}\"><h3>{}</h3>{}<p class=\"caption\">{}</p></section>\n",
      html_text(exhibit.id), html_text(exhibit.title), exhibit.html, html_text(exhibit.caption));
}

std::string chapter_html(const Chapter& chapter, std::size_t number) {
  std::string html = fmt::format("<h2 id=\"chapter{}\">{}</h2>\n", number, html_text(chapter.title));
  html += "<div class=\"exhibits\">";
  for (const Exhibit& exhibit : chapter.exhibits) html += exhibit_html(exhibit);
  html += "</div>";
  if (chapter.rows.empty()) return html;
  html +=
      "<div class=\"scroll\"><table "
      "class=\"ledger\"><thead><tr><th>id</th><th>quantity</th><th>published</th><th>computed</th>"
      "<th>verdict</th></tr></thead><tbody>\n";
  for (const LedgerRow& row : chapter.rows) html += row_html(row);
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string reproduction_html(const Reproduction& reproduction, std::uint64_t seed) {
  std::string nav = "<nav>", body;
  for (std::size_t c = 0; c < reproduction.chapters.size(); ++c) {
    nav += fmt::format("<a href=\"#chapter{}\">{}</a>", c, html_text(reproduction.chapters[c].title));
    body += chapter_html(reproduction.chapters[c], c);
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>The paper, number by "
      "number</title><style>{}</style></head><body><main>\n"
      "<p class=\"lead\">asterism reproduce · seed {}</p><h1>“Dynamic Positioning and Optimization of "
      "Magnetic Target Based on "
      "Binocular Vision”, number by number</h1><p class=\"lead\">Machines 2025, 13, 592. What is printed, "
      "what comes out, and whether "
      "both agree. Every verdict is the outcome of a comparison: to the half unit of the last printed digit, "
      "or to four standard errors "
      "for what was drawn at random. Figures are drawn from the computed "
      "values.</p>\n{}{}{}</main><script>{}</script></body></html>\n",
      kStyle, seed, counts_html(count_verdicts(reproduction.rows())), nav + "</nav>\n", body, kScript);
}

}  // namespace asterism
