#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/angle.h"
#include "embedded/report_css.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/report_values.h"
#include "engine/report/session_notes.h"
#include "engine/report/session_report.h"
#include "engine/report/session_rods.h"
#include "engine/report/tracked_section.h"
#include "engine/report/verdict.h"
#include "engine/session/replan_wording.h"

namespace orthonav::engine {
namespace {

/// "02:45.57" of the headset's clock.
std::string clock_text(Timestamp time) {
  const double all_s = std::max(0.0, seconds(time.time_since_epoch()));
  const double minutes = std::floor(all_s / 60.0);
  return formatted("%02.0f:%05.2f", minutes, all_s - 60.0 * minutes);
}

std::string recorded(const std::optional<double>& value, double scale, int decimals) {
  return value ? html_number(*value * scale, decimals) : kNotRecorded;
}

/// `remark` is HTML below the table.
void put_table(const std::string& title, const HtmlTable& table, std::string& html,
               const std::string& remark = "") {
  html += "<section><h2>" + title + "</h2>" + table.html() + remark + "</section>";
}

void put_nothing(const std::string& title, std::string& html) {
  html += "<section><h2>" + title + "</h2><p>None recorded.</p></section>";
}

void put_ending(const SessionRecord& session, const Verdict& verdict, std::string& html) {
  html += "<section id=verdict class=" + std::string(style_of(verdict)) + "><h2>" +
          (session.cut ? "This session was cut off"
                       : (session.completed() ? "Operation completed" : "Operation incomplete")) +
          ": " + html_escaped(verdict.counts) + "</h2><p>" + html_escaped(ending_of(session)) +
          "</p>" + warnings_list(verdict) + "</section>";
}

std::string verdict(const RecordedLevel& level) {
  if (level.attempts == 0) {
    return "not registered";
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
  return text.empty() ? kNoValue : text;
}

/// An error or a bound in mm, with a remark if it lacks the errors that all strokes share.
std::string bound_text(const std::optional<double>& value_m, bool registration_only) {
  return recorded(value_m, 1e3, 2) + (value_m && registration_only ? kRegistrationOnlyHtml : "");
}

/// Whether a bound on a screw's place lacks those errors.
bool registration_only(const SessionRecord& session, const RecordedLevel& level) {
  return level.registration &&
         session.registrations[*level.registration].registration_only.value_or(false);
}

void put_registration_in_force(HtmlTable& table, const SessionRecord& session,
                               const RecordedLevel& level) {
  if (!level.registration) {
    for (int i = 0; i < 4; ++i) {
      table.cell("\u2013");
    }
    return;
  }
  const RecordedRegistration& in_force = session.registrations[*level.registration];
  table.cell(recorded(in_force.rmse_m, 1e3, 2));
  table.cell(bound_text(in_force.predicted_tre_m, in_force.registration_only.value_or(false)));
  table.cell(in_force.points ? std::to_string(*in_force.points) : kNotRecorded);
  table.cell(recorded(level.digitization_s, 1.0, 1));
}

void put_levels(const SessionRecord& session, std::string& html) {
  if (session.levels.empty()) {
    return put_nothing("Levels", html);
  }
  HtmlTable table({{"level"},
                   {"registration"},
                   {"attempts"},
                   {"RMSE", "mm"},
                   {"predicted TRE", "mm"},
                   {"points"},
                   {"time", "s"},
                   {"check points", "mm"},
                   {"dimple", "mm off"},
                   {"screws done"}});
  for (const RecordedLevel& level : session.levels) {
    table.row(html_escaped(level.label));
    table.cell(verdict(level));
    table.cell(std::to_string(level.attempts));
    put_registration_in_force(table, session, level);
    std::string checks;
    for (const RecordedCheck& check : level.checks) {
      checks += (checks.empty() ? "" : ", ") + html_number(check.distance_m * 1e3, 1);
    }
    table.cell(checks.empty() ? "\u2013" : checks);
    table.cell(touches_of_landmark(level));
    table.cell(screws_done(level, session.has_plan));
  }
  put_table("Levels", table, html,
            session.has_plan ? ""
                             : "<ul class=notes><li>The plan was not recorded: levels that were "
                               "not reached are missing here.</li></ul>");
}

void put_pose_at_depth(HtmlTable& table, const SessionRecord& session, const RecordedLevel& level,
                       const RecordedScrew& screw) {
  if (!screw.at_depth) {
    for (int i = 0; i < 6; ++i) {
      table.cell(screw.done ? kNotRecorded : "\u2013");
    }
    return;
  }
  const RecordedPose& pose = *screw.at_depth;
  table.cell(html_number(degrees(pose.angle_rad), 2));
  table.cell(html_number(pose.tip_off_axis_m * 1e3, 2));
  table.cell(html_number(pose.tip_to_entry_m * 1e3, 2));
  table.cell(html_number(pose.depth_m * 1e3, 2));
  table.cell(recorded(pose.clearance_m, 1e3, 2));
  table.cell(bound_text(pose.clearance_95_m, registration_only(session, level)));
}

void put_screws(const SessionRecord& session, std::string& html) {
  HtmlTable table({{"screw"},
                   {"done at"},
                   {"angle to the plan", "\u00b0"},
                   {"tip off the axis", "mm"},
                   {"tip to entry", "mm"},
                   {"depth", "mm"},
                   {"clearance", "mm"},
                   {"95 % above", "mm"},
                   {"wire as placed"}});
  for (const RecordedLevel& level : session.levels) {
    for (const RecordedScrew& screw : level.screws) {
      table.row(html_escaped(level.label) + " " + name_of(screw.side));
      table.cell(screw.time ? clock_text(*screw.time) : "not done");
      put_pose_at_depth(table, session, level, screw);
      table.cell(wire_text(screw));
      if (screw.planned_in_surgery) {
        table.below("planned in surgery: " + html_escaped(text_of(*screw.planned_in_surgery)));
      }
    }
  }
  return table.empty() ? put_nothing("Screws", html)
                       : put_table("Screws, as measured at depth", table, html);
}

void put_registrations(const SessionRecord& session, std::string& html) {
  if (session.registrations.empty()) {
    return put_nothing("Registrations", html);
  }
  HtmlTable table({{"time"},
                   {"level"},
                   {"attempt"},
                   {"numeric checks", "", true},
                   {"RMSE", "mm"},
                   {"next best", "mm"},
                   {"95 % of errors below", "mm"},
                   {"points"}});
  for (const RecordedRegistration& each : session.registrations) {
    table.row(clock_text(each.time));
    table.cell(html_escaped(each.level));
    table.cell(std::to_string(each.attempt));
    table.cell(each.passed ? "<span class=good>passed</span>"
                           : "<span class=bad>refused</span> " + html_escaped(each.reason));
    table.cell(recorded(each.rmse_m, 1e3, 2));
    table.cell(recorded(each.runner_up_rmse_m, 1e3, 2));
    table.cell(bound_text(each.tre_95_m, each.registration_only.value_or(false)));
    table.cell(each.points ? std::to_string(*each.points) : kNotRecorded);
    if (!each.warning.empty()) {
      table.below(html_escaped(each.warning), "bad");
    }
  }
  put_table("Registrations", table, html);
}

void put_steps(const SessionRecord& session, std::string& html) {
  HtmlTable table({{"time"}, {"step", "", true}});
  for (const RecordedStep& step : session.steps) {
    table.row(clock_text(step.time));
    table.cell(std::string(name_of(step.step)));
  }
  html += "<section><h2>Course</h2>" + table.html("narrow") + "</section>";
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
      "<meta name=viewport content=\"width=device-width, initial-scale=1\"><style>";
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
  const nlohmann::json figures = nlohmann::json::parse(session_json(session));
  put_ending(session, verdict_of(figures), html);
  const bool rods_alone = is_of_rods_alone(figures);
  if (!rods_alone) {
    put_screws(session, html);
    put_levels(session, html);
  }
  html += session_rods(session);
  if (!rods_alone) {
    put_registrations(session, html);
  }
  html += tracked_section(figures);
  put_steps(session, html);
  html += rods_alone ? "" : guide_notes(session);
  return html +
         "<ul class=notes><li>From the journal alone: the date, digitized points, images, frame "
         "times and errors against the truth are not recorded in it.</li><li>Times are of the "
         "headset's "
         "clock, minutes and seconds.</li><li>Written by orthonav " +
         html_escaped(session.orthonav) +
         ". Not a medical device.</li></ul></main></body></html>\n";
}

}  // namespace orthonav::engine
