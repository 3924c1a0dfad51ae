#include "engine/report/levels_section.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

/// Accepted, not accepted after a number of attempts, or never tried.
std::string verdict_on(const json& level) {
  if (value_of(level, "attempts").value_or(0.0) <= 0.0) {
    return "<span>not registered</span>";
  }
  return std::string(is_true(level, "accepted") ? "<span class=good>accepted</span>"
                                                : "<span class=bad>refused</span>") +
         " <small>attempt " + figure(level, "attempts", 0) + "</small>";
}

}  // namespace

std::string levels_section(const json& report) {
  HtmlTable table({{"level"},
                   {"registration"},
                   {"RMSE", "mm"},
                   {"error to expect at the screws", "mm"},
                   {"true error at the screws", "mm"},
                   {"points"},
                   {"time", "s"}});
  for (const json& level : report["levels"]) {
    table.row(html_escaped(text_in(level, "label")));
    table.cell(verdict_on(level));
    table.cell(figure(level, "rmse_mm", 2));
    table.cell(figure(level, "predicted_tre_mm", 2) +
               (is_true(level, "registration_only") ? kRegistrationOnlyHtml : ""));
    table.cell(figure(level, "tre_mm", 2));
    table.cell(figure(level, "points", 0));
    table.cell(figure(level, "digitization_s", 1));
  }
  return table.empty() ? ""
                       : "<section id=levels><h2>Registration</h2>" + table.html() +
                             "<p class=notes>To expect: root mean square at the worst entry "
                             "or target, as the registration says. True: mean over entries "
                             "and targets, against the simulation\u2019s truth. RMSE is of "
                             "the points and a poor indicator of either.</p></section>";
}

std::string rods_section(const json& report) {
  const json& rod = object_in(report, "rod");
  if (rod.empty()) {
    return "<section id=rods><h2>Rod template</h2><p>No rod was templated.</p></section>";
  }
  std::string html = "<section id=rods><h2>Rod template</h2><p>Length <b>" +
                     figure(rod, "length_mm", 1) + " mm</b>, length error " +
                     figure(rod, "length_error_mm", 2) + " mm, error of the heads " +
                     figure(rod, "head_error_mm", 2) + " mm.</p>";
  HtmlTable table({{"side"},
                   {"heads touched"},
                   {"length", "mm"},
                   {"length error", "mm"},
                   {"error of the heads", "mm"},
                   {"bends measured", "\u00b0"}});
  for (const json& side : rod.value("sides", json::array())) {
    table.row(html_escaped(text_in(side, "side")));
    table.cell(figure(side, "heads", 0));
    table.cell(figure(side, "length_mm", 1));
    table.cell(figure(side, "length_error_mm", 2));
    table.cell(figure(side, "head_error_mm", 2));
    std::string measured;
    for (const json& bend : side.value("measured", json::array())) {
      measured += (measured.empty() ? "" : ", ") + figure(bend, "angle_deg", 1) + " \u00b1 " +
                  figure(bend, "angle_se_deg", 1);
    }
    table.cell(measured.empty() ? "\u2013" : measured);
  }
  return html + (table.empty() ? "" : table.html()) + "</section>";
}

}  // namespace orthonav::engine
