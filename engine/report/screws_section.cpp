#include "engine/report/screws_section.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_limits.h"
#include "engine/report/report_values.h"
#include "engine/report/verdict.h"
#include "engine/report/wire_section.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

/// "6.5 × 40".
std::string size_of(const json& screw) {
  const json& planned = object_in(screw, "planned");
  const auto diameter = value_of(planned, "diameter_mm");
  const auto length = value_of(planned, "length_mm");
  return diameter && length
             ? html_number(*diameter, 1) + "\u00a0\u00d7\u00a0" + html_number(*length, 0)
             : "not stated";
}

/// A cell with an error against the truth, and its limit.
void error_cell(HtmlTable& table, const std::optional<double>& value, double limit,
                const char* none) {
  table.cell(value ? html_number_beside(*value, limit, 1) : none,
             value && *value > limit ? "bad" : "");
}

/// Against the truth where one is known, else as tracked: "2.9 A", "2.0 A 93 % as tracked".
void clearance_cell(HtmlTable& table, const json& screw, const char* none) {
  const json& tracked = object_in(screw, "tracked");
  const bool known = value_of(screw, "clearance_mm").has_value();
  const json& from = known ? screw : tracked;
  const auto clearance = value_of(from, "clearance_mm");
  if (!clearance) {
    table.cell(none);
    return;
  }
  table.cell(html_number(*clearance, 1) + " " + html_escaped(text_in(from, "grade")) +
                 (known ? "" : " <small>as tracked</small>"),
             *clearance < 0.0 ? "bad" : "");
}

void put_line(HtmlTable& table, const std::string& name, const json& screw) {
  const bool placed = is_placed(screw);
  const char* none = placed ? kNoValue : "";
  table.row(html_escaped(name) + (placed ? "" : " <small>not placed</small>"));
  error_cell(table, value_of(screw, "angle_error_deg"), degrees(kOnTarget_rad), none);
  error_cell(table, value_of(screw, "entry_error_mm"), kOnTarget_m * 1e3, none);
  clearance_cell(table, screw, none);
}

void put_details(HtmlTable& table, const std::string& name, const json& screw) {
  const bool placed = is_placed(screw);
  table.row(html_escaped(name));
  table.cell(size_of(screw));
  table.cell(placed ? figure(object_in(screw, "executed"), "depth_mm", 1) : "");
  table.cell(placed || screw.contains("wire") ? wire_as_placed(screw) : "");
  if (const json& change = object_in(screw, "planned_in_surgery"); !change.empty()) {
    table.below("planned in surgery: " + html_escaped(text_in(change, "text")));
  }
}

}  // namespace

std::string screws_section(const json& report) {
  HtmlTable table(
      {{"screw"}, {"angle error", "\u00b0"}, {"entry error", "mm"}, {"clearance, grade", "mm"}});
  HtmlTable details({{"screw"},
                     {"planned size", "mm"},
                     {"depth as tracked", "mm"},
                     {placed_tool(report) + " as measured in place"}});
  bool truth = false;
  for_each_screw(report, [&](const json&, const std::string& name, const json& screw) {
    put_line(table, name, screw);
    put_details(details, name, screw);
    truth = truth || has_truth(screw);
  });
  if (is_of_rods_alone(report)) {
    return "";
  }
  if (table.empty()) {
    return "<section id=screws><h2>Screws</h2><p>None planned.</p></section>";
  }
  const std::string errors =
      truth ? "Errors, clearance and grade are against the simulation\u2019s truth; red: beyond " +
                  html_number(degrees(kOnTarget_rad), 0) + "\u00b0 or " +
                  html_number(kOnTarget_m * 1e3, 0) + " mm, or a breach. "
            : "Errors against the truth are unknown here. ";
  return "<section id=screws><h2>Screws</h2>" + table.html("lines") + "<details><summary>" +
         "size, depth, and the " + placed_tool(report) + " in place</summary>" + details.html() +
         "<p class=notes>" + errors +
         "Depth: of the tool\u2019s tip past the planned entry when it was last tracked, not of "
         "the screw. Clearance: least depth of the planned screw below the bone\u2019s surface "
         "along the way taken.</p></details></section>";
}

}  // namespace orthonav::engine
