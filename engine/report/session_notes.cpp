#include "engine/report/session_notes.h"

#include "base/angle.h"
#include "engine/report/html_text.h"

namespace orthonav::engine {

std::string wire_text(const RecordedScrew& screw) {
  std::string text = kNoValue;
  if (const auto& wire = screw.wire) {
    text = html_number(degrees(wire->angle_rad), 1) + " \u00b1 " +
           html_number(degrees(wire->angle_sd_rad), 1) + "\u00b0, " +
           html_number(wire->entry_m * 1e3, 1) + " \u00b1 " +
           html_number(wire->entry_sd_m * 1e3, 1) + " mm";
    if (!wire->within) {
      text = "<span class=bad>" + text + "</span>" + (wire->kept ? ", kept" : "");
    }
  } else if (screw.wire_asked) {
    text = "not measured";
  }
  if (screw.redone > 0) {
    text += "; redone" + (screw.redone > 1 ? " " + std::to_string(screw.redone) + " times" : "");
  }
  return text;
}

std::string guide_notes(const SessionRecord& session) {
  std::string html = "<ul class=notes><li>";
  if (!session.tips) {
    html += "The tips of pointer and guide were not compared.</li>";
  } else {
    html += "In one dimple the tips of pointer and guide were " +
            html_number(session.tips->apart_m * 1e3, 2) + " mm apart" +
            (session.tips->corrected ? "; the guide\u2019s was corrected by " +
                                           html_number(session.tips->by_m * 1e3, 2) + " mm"
                                     : "") +
            ".</li>";
  }
  if (session.axis) {
    html += "<li>On the last wire over which its sleeve was turned, the guide\u2019s axis was " +
            html_number(degrees(session.axis->off_rad), 2) + "\u00b0 off" +
            (session.axis->corrected
                 ? "; corrected by " + html_number(degrees(session.axis->by_rad), 2) + "\u00b0"
                 : "") +
            ".</li>";
  }
  return html + "</ul>";
}

}  // namespace orthonav::engine
