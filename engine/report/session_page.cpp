#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/angle.h"
#include "embedded/report_css.h"
#include "engine/report/html_text.h"
#include "engine/report/session_notes.h"
#include "engine/report/session_report.h"
#include "engine/report/tracked_section.h"
#include "engine/session/replan_wording.h"

namespace orthonav::engine {
namespace {

constexpr const char* kNotRecorded = "<small>not recorded</small>";

/// "02:45.57" of the headset's clock.
std::string clock_text(Timestamp time) {
  const double all_s = std::max(0.0, seconds(time.time_since_epoch()));
  const double minutes = std::floor(all_s / 60.0);
  return formatted("%02.0f:%05.2f", minutes, all_s - 60.0 * minutes);
}

std::string recorded(const std::optional<double>& value, double scale, int decimals) {
  return value ? html_number(*value * scale, decimals) : kNotRecorded;
}

std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

std::string table_head(const std::string& title, const char* columns) {
  return "<section><h2>" + title + "</h2><table><thead><tr>" + columns + "</tr></thead><tbody>";
}

constexpr const char* kTableEnd = "</tbody></table></section>";

void put_nothing(const std::string& title, std::string& html) {
  html += "<section><h2>" + title + "</h2><p>None recorded.</p></section>";
}

void put_ending(const SessionRecord& session, std::string& html) {
  const bool good = session.completed();
  html += "<section class=ending><h2 class=" + std::string(good ? "good" : "bad") + ">" +
          (session.cut ? "This session was cut off"
                       : (good ? "The operation is done" : "Operation incomplete")) +
          "</h2><p>" + html_escaped(ending_of(session)) + "</p></section>";
}

std::string verdict(const RecordedLevel& level) {
  if (level.attempts == 0) {
    return "not reached";
  }
  return level.accepted ? "<span class=good>accepted</span>"
                        : "<span class=bad>not accepted</span>";
}

std::string screws_done(const RecordedLevel& level, bool has_plan) {
  int done = 0;
  for (const RecordedScrew& screw : level.screws) {
    done += screw.done ? 1 : 0;
  }
  const std::string of = has_plan ? " of " + std::to_string(level.screws.size()) : "";
  return std::to_string(done) + of;
}

/// "recorded, 0.4, <span class=bad>2.3</span>": each touch against the first.
std::string touches_of_landmark(const RecordedLevel& level) {
  std::string text;
  for (const RecordedLandmark& touch : level.landmark) {
    const std::string off = touch.first ? "recorded" : html_number(touch.off_m * 1e3, 1);
    text += (text.empty() ? "" : ", ") +
            (touch.within ? off : "<span class=bad>" + off + "</span>") +
            (touch.dropped ? " (taken back)" : "");
  }
  return text.empty() ? "\u2013" : text;
}

/// An error or a bound in mm, and beside it that it lacks what all strokes share.
std::string bound_text(const std::optional<double>& value_m, bool registration_only) {
  return recorded(value_m, 1e3, 2) + (value_m && registration_only ? kRegistrationOnlyHtml : "");
}

/// Whether a bound on a screw's place lacks it.
bool registration_only(const SessionRecord& session, const RecordedLevel& level) {
  return level.registration &&
         session.registrations[*level.registration].registration_only.value_or(false);
}

void put_levels(const SessionRecord& session, std::string& html) {
  if (session.levels.empty()) {
    return put_nothing("Levels", html);
  }
  html += table_head("Levels",
                     "<th>level</th><th>registration</th><th>attempts</th><th>RMSE "
                     "<small>mm</small></th><th>predicted TRE <small>mm</small></th><th>points</th>"
                     "<th>time <small>s</small></th><th>check points <small>mm</small></th>"
                     "<th>dimple <small>mm off</small></th><th>screws done</th>");
  for (const RecordedLevel& level : session.levels) {
    html += "<tr>" + cell(html_escaped(level.label)) + cell(verdict(level)) +
            cell(std::to_string(level.attempts));
    if (level.registration) {
      const RecordedRegistration& in_force = session.registrations[*level.registration];
      html +=
          cell(recorded(in_force.rmse_m, 1e3, 2)) +
          cell(bound_text(in_force.predicted_tre_m, in_force.registration_only.value_or(false))) +
          cell(in_force.points ? std::to_string(*in_force.points) : kNotRecorded) +
          cell(recorded(level.digitization_s, 1.0, 1));
    } else {
      html += "<td>\u2013</td><td>\u2013</td><td>\u2013</td><td>\u2013</td>";
    }
    std::string checks;
    for (const RecordedCheck& check : level.checks) {
      checks += (checks.empty() ? "" : ", ") + html_number(check.distance_m * 1e3, 1);
    }
    html += cell(checks.empty() ? "\u2013" : checks) + cell(touches_of_landmark(level)) +
            cell(screws_done(level, session.has_plan)) + "</tr>";
  }
  html += kTableEnd;
  if (!session.has_plan) {
    html +=
        "<ul class=notes><li>The plan was not recorded: levels that were not reached are "
        "missing here.</li></ul>";
  }
}

void put_screws(const SessionRecord& session, std::string& html) {
  const bool any = std::any_of(session.levels.begin(), session.levels.end(),
                               [](const RecordedLevel& level) { return !level.screws.empty(); });
  if (!any) {
    return put_nothing("Screws", html);
  }
  html += table_head(
      "Screws, as measured at depth",
      "<th>screw</th><th>done at</th><th>angle to the plan <small>\u00b0</small></th>"
      "<th>tip off the axis <small>mm</small></th><th>tip to entry "
      "<small>mm</small></th><th>depth <small>mm</small></th><th>clearance "
      "<small>mm</small></th><th>95 % above <small>mm</small></th><th>wire as placed</th>");
  for (const RecordedLevel& level : session.levels) {
    for (const RecordedScrew& screw : level.screws) {
      html += "<tr>" + cell(html_escaped(level.label) + " " + name_of(screw.side)) +
              cell(screw.time ? clock_text(*screw.time) : "not done");
      if (const auto& pose = screw.at_depth) {
        html += cell(html_number(degrees(pose->angle_rad), 2)) +
                cell(html_number(pose->tip_off_axis_m * 1e3, 2)) +
                cell(html_number(pose->tip_to_entry_m * 1e3, 2)) +
                cell(html_number(pose->depth_m * 1e3, 2)) +
                cell(recorded(pose->clearance_m, 1e3, 2)) +
                cell(bound_text(pose->clearance_95_m, registration_only(session, level))) +
                cell(wire_text(screw)) + "</tr>";
      } else {
        const std::string none = cell(screw.done ? kNotRecorded : "\u2013");
        html += none + none + none + none + none + none + cell(wire_text(screw)) + "</tr>";
      }
      if (screw.planned_in_surgery) {
        html += "<tr><td></td><td colspan=8>planned in surgery: " +
                html_escaped(text_of(*screw.planned_in_surgery)) + "</td></tr>";
      }
    }
  }
  html += kTableEnd;
}

std::string instructed(const RecordedRod& rod) {
  std::string text;
  for (const RecordedInstruction& bend : rod.instructions) {
    text += (text.empty() ? "" : "; ") + html_number(bend.arc_length_m * 1e3, 1) + ": " +
            html_number(degrees(bend.roll_rad), 0) + ", " + html_number(degrees(bend.set_rad), 1);
  }
  return text.empty() ? "\u2013" : text;
}

void put_rods(const SessionRecord& session, std::string& html) {
  if (session.rods.empty()) {
    return;
  }
  html += table_head("Rods",
                     "<th>side</th><th>heads</th><th>template</th><th>length <small>mm</small></th>"
                     "<th>bends <small>mm: \u00b0</small></th><th>cut to <small>mm</small></th>"
                     "<th>instructions <small>mm: roll \u00b0, set \u00b0</small></th>");
  for (const RecordedRod& rod : session.rods) {
    std::string bends;
    for (const RecordedBend& bend : rod.bends) {
      bends += (bends.empty() ? "" : ", ") + html_number(bend.arc_length_m * 1e3, 0) + ": " +
               html_number(degrees(bend.angle_rad), 1);
    }
    html += "<tr>" + cell(name_of(rod.side)) + cell(std::to_string(rod.heads)) +
            cell(rod.done ? "taken" : "not taken") +
            cell(rod.done ? recorded(rod.length_m, 1e3, 1) : "\u2013") +
            cell(bends.empty() ? "\u2013" : bends) + cell(recorded(rod.cut_length_m, 1e3, 1)) +
            cell(instructed(rod)) + "</tr>";
  }
  html += kTableEnd;
}

void put_registrations(const SessionRecord& session, std::string& html) {
  if (session.registrations.empty()) {
    return put_nothing("Registrations", html);
  }
  html += table_head("Registrations",
                     "<th>time</th><th>level</th><th>attempt</th><th>numeric checks</th>"
                     "<th>RMSE <small>mm</small></th><th>next best <small>mm</small></th>"
                     "<th>95 % of errors below <small>mm</small></th><th>points</th>");
  for (const RecordedRegistration& each : session.registrations) {
    html += "<tr>" + cell(clock_text(each.time)) + cell(html_escaped(each.level)) +
            cell(std::to_string(each.attempt)) +
            cell(each.passed ? "<span class=good>passed</span>"
                             : "<span class=bad>refused</span> " + html_escaped(each.reason)) +
            cell(recorded(each.rmse_m, 1e3, 2)) + cell(recorded(each.runner_up_rmse_m, 1e3, 2)) +
            cell(bound_text(each.tre_95_m, each.registration_only.value_or(false))) +
            cell(each.points ? std::to_string(*each.points) : kNotRecorded) + "</tr>";
    if (!each.warning.empty()) {
      html += "<tr><td></td><td colspan=7 class=bad>" + html_escaped(each.warning) + "</td></tr>";
    }
  }
  html += kTableEnd;
}

void put_steps(const SessionRecord& session, std::string& html) {
  html += table_head("Course", "<th>time</th><th>step</th>");
  for (const RecordedStep& step : session.steps) {
    html += "<tr>" + cell(clock_text(step.time)) + cell(std::string(name_of(step.step))) + "</tr>";
  }
  html += kTableEnd;
}

}  // namespace

std::string ending_of(const SessionRecord& session) {
  std::string out = session.cut ? "The journal has no end" : "The journal is whole";
  if (session.begin && session.end) {
    out += (session.cut ? ": its last line is of " : ": it ends at ") + clock_text(*session.end) +
           formatted(" on the headset's clock, %.1f s after the first",
                     seconds(*session.end - *session.begin));
  } else {
    out += " and no line after its first";
  }
  if (session.last_line_torn) {
    out += "; one more line was torn and is not used";
  }
  if (session.cut) {
    return out + ". What came after it is not recorded.";
  }
  return out + (session.reason.empty() ? "." : "; " + session.reason + ".");
}

std::string session_page(const SessionRecord& session, const std::string& source) {
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: session</title>"
      "<meta name=viewport content=\"width=device-width\"><style>";
  html += embedded::report_css();
  html +=
      "</style></head><body><header><h1>orthonav <span>report of a journal</span></h1><p>Case <b>" +
      html_escaped(session.case_name) + "</b>, method <b>" + html_escaped(session.method) +
      "</b>, headset <b>" + html_escaped(session.device) + "</b>, journal <b>" +
      html_escaped(source) + "</b>, relative to <b>" +
      (session.patient_reference
           ? (*session.patient_reference ? "the patient reference" : "the headset\u2019s map")
           : "a frame that is not recorded") +
      "</b></p></header><main>";
  put_ending(session, html);
  put_levels(session, html);
  put_screws(session, html);
  html += tracked_section(nlohmann::json::parse(session_json(session)));
  put_rods(session, html);
  put_registrations(session, html);
  put_steps(session, html);
  html += guide_notes(session);
  return html +
         "<ul class=notes><li>From the journal alone: digitized points, images, frame times and "
         "errors against the truth are not recorded in it.</li><li>Times are of the headset's "
         "clock, minutes and seconds.</li><li>Written by orthonav " +
         html_escaped(session.orthonav) +
         ". Not a medical device.</li></ul></main></body></html>\n";
}

}  // namespace orthonav::engine
