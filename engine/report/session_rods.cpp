#include "engine/report/session_rods.h"

#include <optional>

#include "base/angle.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"

namespace orthonav::engine {
namespace {

std::string length_text(const std::optional<double>& length_m) {
  return length_m ? html_number(*length_m * 1e3, 1) : kNotRecorded;
}

std::string instructed(const RecordedRod& rod) {
  std::string text;
  for (const RecordedInstruction& bend : rod.instructions) {
    text += (text.empty() ? "" : "; ") + html_number(bend.arc_length_m * 1e3, 1) + ": " +
            html_number(degrees(bend.roll_rad), 0) + ", " + html_number(degrees(bend.set_rad), 1);
  }
  return text.empty() ? "\u2013" : text;
}

std::string touches_text(const RecordedRod& rod) {
  std::string text;
  for (const RecordedHead& head : rod.touched) {
    text += (text.empty() ? "" : ", ") + std::to_string(head.touches) + ": " +
            html_number(head.sd_m * 1e3, 1);
  }
  return text.empty() ? "\u2013" : text;
}

}  // namespace

std::string session_rods(const SessionRecord& session) {
  if (session.rods.empty()) {
    return {};
  }
  HtmlTable table({{"side"},
                   {"heads"},
                   {"touches of each", "SD, mm"},
                   {"template"},
                   {"length", "mm"},
                   {"bends", "mm: \u00b0"},
                   {"cut to", "mm"},
                   {"instructions", "mm: roll \u00b0, set \u00b0"},
                   {"expected within 1.0 mm", "%"}});
  for (const RecordedRod& rod : session.rods) {
    std::string bends;
    for (const RecordedBend& bend : rod.bends) {
      bends += (bends.empty() ? "" : ", ") + html_number(bend.arc_length_m * 1e3, 0) + ": " +
               html_number(degrees(bend.angle_rad), 1);
    }
    table.row(name_of(rod.side));
    table.cell(std::to_string(rod.heads));
    table.cell(touches_text(rod));
    table.cell(rod.done ? "taken" : "not taken");
    table.cell(rod.done ? length_text(rod.length_m) : "\u2013");
    table.cell(bends.empty() ? "\u2013" : bends);
    table.cell(length_text(rod.cut_length_m));
    table.cell(instructed(rod));
    table.cell(rod.expected_within ? html_number(100.0 * *rod.expected_within, 0) : "\u2013");
  }
  return "<section><h2>Rods</h2>" + table.html() + "</section>";
}

}  // namespace orthonav::engine
