#include "engine/report/paper_section.h"

#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/paper_table.h"
#include "engine/report/report_values.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

void put_row(HtmlTable& table, const nlohmann::json& report, const PaperRow& row, bool simulated) {
  const nav::Summary s = nav::summarize(values_of(report, row.key, row.per_screw));
  const auto number = [&row](double value) { return html_number(value, row.decimals); };
  table.row(std::string(row.name) + " <small>" + std::string(row.unit) + "</small>");
  table.cell(number(row.mean) + " \u00b1 " + number(row.sd));
  if (s.count == 0) {
    table.cell(kNoValue);
    table.cell(kNoValue);
  } else {
    table.cell(number(s.mean) + (s.count > 1 ? " \u00b1 " + number(s.sd) : ""), "ours");
    table.cell(s.count > 1 ? number(s.min) + "\u2013" + number(s.max) : kNoValue);
  }
  table.cell(how_many(s.count, row.per_screw ? "screw" : "level"));
  table.cell(simulated && row.input ? "an input: how the scripted surgeon strokes" : "measured");
}

}  // namespace

std::string paper_section(const nlohmann::json& report) {
  if (is_of_rods_alone(report)) {
    return "";  // the paper measured no rod
  }
  // Only a simulated room has a seed.
  const bool simulated = report.contains("seed");
  HtmlTable table({{"mean \u00b1 SD"},
                   {"Liebmann et al. 2019"},
                   {"this run"},
                   {"min\u2013max"},
                   {"n"},
                   {"this run\u2019s figure is", "", true}});
  for (const PaperRow& row : kPaperTable) {
    put_row(table, report, row, simulated);
  }
  return "<section id=paper><h2>Against the published system</h2>" + table.html() +
         "<p class=notes>The published figures come from a phantom study" +
         (simulated ? ", this run\u2019s from a simulation whose errors were put in" : "") +
         "; one run holds too few screws to compare means or spreads.</p></section>";
}

}  // namespace orthonav::engine
