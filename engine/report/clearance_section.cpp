#include "engine/report/clearance_section.h"

#include <nlohmann/json.hpp>

#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {
namespace {

using nlohmann::json;

std::string word_of(const json& object, const char* key) {
  const std::string text = text_in(object, key);
  return text.empty() ? kNoValue : html_escaped(text);
}

/// `beside`: the text after the number, if any.
void millimetre_cell(HtmlTable& table, const json& object, const char* key,
                     const char* beside = "") {
  const auto value = value_of(object, key);
  table.cell(value ? html_number(*value, 2) + beside : std::string(kNoValue),
             value && *value < 0.0 ? "bad" : "");
}

/// "medial, 18 mm".
std::string where_text(const json& object) {
  const auto arc_mm = value_of(object, "arc_mm");
  return word_of(object, "towards") + (arc_mm ? ", " + html_number(*arc_mm, 0) + " mm" : "");
}

std::string grades_text(const json& object) {
  const std::string text = likely_grades(object_in(object, "grade_probability"));
  return text.empty() ? kNoValue : text;
}

/// The bound, with a remark that it lacks the errors that all strokes share.
void bound_cell(HtmlTable& table, const json& object, bool registration_only) {
  millimetre_cell(table, object, "clearance_95_mm", registration_only ? kRegistrationOnlyHtml : "");
}

void put_row(HtmlTable& table, const std::string& name, const json& screw, bool registration_only) {
  const json& planned = object_in(screw, "planned");
  const json& tracked = object_in(screw, "tracked");
  table.row(html_escaped(name));
  millimetre_cell(table, planned, "clearance_mm");
  table.cell(where_text(planned));
  bound_cell(table, planned, registration_only);
  table.cell(grades_text(planned));
  millimetre_cell(table, tracked, "clearance_mm");
  bound_cell(table, tracked, registration_only);
  table.cell(grades_text(tracked));
  millimetre_cell(table, screw, "clearance_mm");
  table.cell(word_of(screw, "grade"));
  if (planned.contains("accepted_breach")) {
    table.below("planned to leave the cortex: " + word_of(planned, "accepted_breach"), "bad");
  }
}

}  // namespace

std::string clearance_section(const json& report) {
  HtmlTable table({{"screw"},
                   {"planned", "mm"},
                   {"where it is least"},
                   {"planned, 95 % above", "mm"},
                   {"grade expected as planned"},
                   {"tracked", "mm"},
                   {"tracked, 95 % above", "mm"},
                   {"grade expected as tracked"},
                   {"truth", "mm"},
                   {"true grade"}});
  for_each_screw(report, [&](const json& level, const std::string& name, const json& screw) {
    if (screw.contains("planned") || screw.contains("clearance_mm")) {
      put_row(table, name, screw, is_true(level, "registration_only"));
    }
  });
  if (table.empty()) {
    return {};
  }
  return "<section id=clearance><h2>Clearance to the cortex</h2>" + table.html() +
         "<ul class=notes><li>The least depth of the screw's side and tip " +
         "below the bone's surface, from 6 mm past the entry on; negative is a breach. Grades: " +
         html_escaped(nav::kPedicleScale) +
         ". \u201cTracked\u201d is the planned screw along the tool as measured at depth; its "
         "bound counts how far a drill goes astray from the tool (slip, bending, the hand), the "
         "planned one does not.</li></ul></section>";
}

}  // namespace orthonav::engine
