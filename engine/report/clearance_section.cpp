#include "engine/report/clearance_section.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_text.h"
#include "engine/report/report_values.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

constexpr const char* kAbsent = "\u2013";

json part_of(const json& object, const char* key) {
  return object.contains(key) && object[key].is_object() ? object[key] : json::object();
}

std::string word_of(const json& object, const char* key) {
  return object.contains(key) && object[key].is_string()
             ? html_escaped(object[key].get<std::string>())
             : kAbsent;
}

/// `beside`: what stands behind the number, where there is one.
std::string millimetre_cell(const json& object, const char* key, const char* beside = "") {
  const auto value = value_of(object, key);
  const char* const open = value && *value < 0.0 ? "<td class=bad>" : "<td>";
  return open + (value ? html_number(*value, 2) + beside : std::string(kAbsent)) + "</td>";
}

/// "medial, 18 mm".
std::string where_cell(const json& object) {
  const auto arc_mm = value_of(object, "arc_mm");
  return "<td>" + word_of(object, "towards") +
         (arc_mm ? ", " + html_number(*arc_mm, 0) + " mm" : "") + "</td>";
}

/// "A 97 %, B 3 %"; what is less likely than half a percent is left out.
std::string grades_cell(const json& object) {
  const json grades = part_of(object, "grade_probability");
  std::string text;
  for (const auto& [grade, probability] : grades.items()) {
    if (probability.is_number() && probability.get<double>() >= 0.005) {
      text += (text.empty() ? "" : ", ") + html_escaped(grade) + " " +
              html_number(100.0 * probability.get<double>(), 0) + " %";
    }
  }
  return "<td>" + (text.empty() ? std::string(kAbsent) : text) + "</td>";
}

/// The bound, and that it lacks what all strokes share.
std::string bound_cell(const json& object, bool registration_only) {
  return millimetre_cell(object, "clearance_95_mm", registration_only ? kRegistrationOnlyHtml : "");
}

void row_of(const std::string& name, const json& screw, bool registration_only, std::string& html) {
  const json planned = part_of(screw, "planned");
  const json tracked = part_of(screw, "tracked");
  html += "<tr><th scope=row>" + html_escaped(name) + "</th>" +
          millimetre_cell(planned, "clearance_mm") + where_cell(planned) +
          bound_cell(planned, registration_only) + grades_cell(planned) +
          millimetre_cell(tracked, "clearance_mm") + bound_cell(tracked, registration_only) +
          grades_cell(tracked) + millimetre_cell(screw, "clearance_mm") + "<td>" +
          word_of(screw, "grade") + "</td></tr>";
  if (const json in_surgery = part_of(screw, "planned_in_surgery"); !in_surgery.empty()) {
    html += "<tr><td></td><td colspan=9>planned in surgery: " + word_of(in_surgery, "text") +
            "</td></tr>";
  }
  if (planned.contains("accepted_breach")) {
    html += "<tr><td></td><td colspan=9 class=bad>planned to leave the cortex: " +
            word_of(planned, "accepted_breach") + "</td></tr>";
  }
}

}  // namespace

std::string clearance_section(const json& report) {
  std::string rows;
  for (const json& level : report["levels"]) {
    for (const json& screw : level.value("screws", json::array())) {
      if (screw.contains("planned") || screw.contains("clearance_mm") ||
          screw.contains("planned_in_surgery")) {
        row_of(level.value("label", "") + " " + screw.value("side", ""), screw,
               level.value("registration_only", false), rows);
      }
    }
  }
  if (rows.empty()) {
    return {};
  }
  return "<section id=clearance><h2>Clearance to the cortex</h2><table><thead><tr><th></th>"
         "<th>planned <small>mm</small></th><th>where it is least</th>"
         "<th>95 % above <small>mm</small></th><th>grade expected</th>"
         "<th>tracked <small>mm</small></th><th>95 % above <small>mm</small></th>"
         "<th>grade expected</th><th>truth "
         "<small>mm</small></th><th>grade</th></tr></thead><tbody>" +
         rows + "</tbody></table><ul class=notes><li>The least depth of the screw's side and tip " +
         "below the bone's surface, from 6 mm past the entry on; negative is a breach. Grades: " +
         html_escaped(nav::kPedicleScale) +
         ". \u201cTracked\u201d is the planned screw along the tool as measured at depth; what the "
         "instrument does after that (slip, bending, the hand) is in no bound.</li></ul></section>";
}

}  // namespace orthonav::engine
