#include "study/comparison_page.h"

#include <nlohmann/json.hpp>

#include "base/how_many.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "study/study_page_frame.h"

namespace orthonav::engine {
namespace {

std::string signed_number(double value) { return (value > 0.0 ? "+" : "") + html_number(value, 2); }

void add_compared(const StudyComparison& comparison, std::string& html) {
  HtmlTable table({{""},
                   {comparison.first},
                   {comparison.second},
                   {comparison.first + " less " + comparison.second},
                   {"95 % interval"},
                   {"operations"},
                   {"pairs"}});
  for (const ComparedQuantity& q : comparison.quantities) {
    table.row(std::string(q.quantity.name) + " <small>" + std::string(q.quantity.unit) +
              "</small>");
    table.cell(html_number(q.first_mean, 2));
    table.cell(html_number(q.second_mean, 2));
    table.cell("<b>" + signed_number(q.difference.mean) + "</b>");
    table.cell(interval_html(q.difference, signed_number));
    table.cell(std::to_string(q.operations.size()));
    table.cell(how_many(q.pairs, q.quantity.per_screw ? "screw" : "level"));
  }
  html += "<section><h2>Means, pair by pair</h2>" + table.html() +
          "<p class=notes>Each operation counts once, with the mean over the screws or "
          "levels that have a value in both studies. Intervals by Student's t over the "
          "operations.</p></section>";
}

void add_completed(const StudyComparison& comparison, std::string& html) {
  HtmlTable table({{""}, {"completed, of those in both"}, {"in this study alone"}});
  const auto row = [&](const std::string& name, std::size_t completed, std::size_t alone) {
    table.row(html_escaped(name));
    table.cell(std::to_string(completed) + " of " + std::to_string(comparison.operations));
    table.cell(std::to_string(alone));
  };
  row(comparison.first, comparison.completed_first, comparison.only_first);
  row(comparison.second, comparison.completed_second, comparison.only_second);
  html += "<section><h2>Operations</h2>" + table.html() + "</section>";
}

nlohmann::json charts_of(const StudyComparison& comparison) {
  nlohmann::json charts = nlohmann::json::array();
  for (const ComparedQuantity& q : comparison.quantities) {
    nlohmann::json values = nlohmann::json::array();
    for (const PairedOperation& operation : q.operations) {
      values.push_back(operation.first - operation.second);
    }
    charts.push_back({{"title", q.quantity.name},
                      {"axis", comparison.first + " less " + comparison.second + ", " +
                                   std::string(q.quantity.unit)},
                      {"values", values},
                      {"mean", q.difference.mean},
                      {"low", q.difference.low},
                      {"high", q.difference.high}});
  }
  return charts;
}

}  // namespace

std::string comparison_html(const StudyComparison& comparison) {
  StudyPage page{"two studies", "", ""};
  page.intro = "<b>" + html_escaped(comparison.first) + "</b> beside <b>" +
               html_escaped(comparison.second) + "</b>: " + std::to_string(comparison.operations) +
               " simulated operations with the same cases and seeds.";
  add_compared(comparison, page.body);
  add_completed(comparison, page.body);
  page.body += "<section><h2>Paired differences</h2><div class=plots></div></section>";
  return framed(page, {{"differences", charts_of(comparison)}});
}

}  // namespace orthonav::engine
