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

void put_row(HtmlTable& table, const nlohmann::json& report, const nlohmann::json& beside,
             const PaperRow& row, bool simulated) {
  const nav::Summary s = nav::summarize(values_of(report, row.key, row.per_screw));
  const auto number = [&row](double value) { return html_number(value, row.decimals); };
  const auto mean_sd = [&number](const nav::Summary& of) {
    return of.count == 0 ? std::string(kNoValue)
                         : number(of.mean) + (of.count > 1 ? " \u00b1 " + number(of.sd) : "");
  };
  table.row(std::string(row.name) + " <small>" + std::string(row.unit) + "</small>");
  table.cell(number(row.mean) + " \u00b1 " + number(row.sd));
  table.cell(mean_sd(s), s.count == 0 ? "" : "ours");
  table.cell(s.count > 1 ? number(s.min) + "\u2013" + number(s.max) : kNoValue);
  if (beside.is_object()) {
    table.cell(mean_sd(nav::summarize(values_of(beside, row.key, row.per_screw))));
  }
  table.cell(how_many(s.count, row.per_screw ? "screw" : "level"));
  table.cell(simulated && row.input ? "an input: how the scripted surgeon strokes" : "measured");
}

}  // namespace

std::string paper_section(const nlohmann::json& report, const nlohmann::json& beside,
                          const std::string& beside_page) {
  if (is_of_rods_alone(report)) {
    return "";  // the paper measured no rod
  }
  // Only a simulated room has a seed.
  const bool simulated = report.contains("seed");
  std::vector<TableColumn> columns = {
      {"mean \u00b1 SD"}, {"Liebmann et al. 2019"}, {"this run"}, {"min\u2013max"}};
  std::string other;
  if (beside.is_object()) {
    const std::string method = text_in(beside, "method");
    columns.push_back({"method " + method});
    other = " Beside it: <a href=\"" + html_escaped(beside_page) + "\">the run with method " +
            html_escaped(method) + "</a>.";
  }
  columns.push_back({"n"});
  columns.push_back({"this run\u2019s figure is", "", true});
  HtmlTable table(std::move(columns));
  for (const PaperRow& row : kPaperTable) {
    put_row(table, report, beside, row, simulated);
  }
  return "<section id=paper><h2>Against the published system</h2>" + table.html() +
         "<p class=notes>The published figures come from a phantom study" +
         (simulated ? ", this run\u2019s from a simulation whose errors were put in" : "") +
         "; one run holds too few screws to compare means or spreads." + other + "</p></section>";
}

}  // namespace orthonav::engine
