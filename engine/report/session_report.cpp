#include "engine/report/session_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/angle.h"
#include "engine/report/html_table.h"
#include "engine/report/html_text.h"
#include "engine/report/operation_result.h"
#include "engine/report/page_style.h"
#include "engine/report/report_values.h"
#include "engine/report/tracked_section.h"
#include "engine/report/verdict.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

bool completed(const LoggedOperation& session) { return session.ended && session.done; }

/// Once registrations with all their figures were asked for; method `paper` has no bounds.
bool has_bounds(const nav::Registration& registration) { return registration.tre_95_m > 0.0; }

/// "02:45.57" of the headset's clock.
std::string clock_text(Timestamp time) {
  const double all_s = std::max(0.0, seconds(time.time_since_epoch()));
  const double minutes = std::floor(all_s / 60.0);
  return formatted("%02.0f:%05.2f", minutes, all_s - 60.0 * minutes);
}

// The figures.

Json touch_json(const LoggedTouch& logged) {
  const LandmarkTouch& touch = logged.touch;
  Json out{{"first", touch.first}};
  if (!touch.first) {
    out["off_mm"] = touch.off_m * 1e3;
    out["within"] = touch.held();
  }
  out["limit_mm"] = touch.limit_m * 1e3;
  if (logged.dropped) {
    out["dropped"] = true;
  }
  return out;
}

void put_levels(Json& levels, const LoggedOperation& session) {
  for (std::size_t i = 0; i < session.state.levels.size(); ++i) {
    for (const LoggedTouch& touch : session.landmark_touches[i]) {
      levels[i]["landmark"].push_back(touch_json(touch));
    }
    const std::vector<ScrewState>& screws = session.state.levels[i].screws;
    for (std::size_t s = 0; s < screws.size(); ++s) {
      if (const auto& at_depth = screws[s].at_depth) {
        levels[i]["screws"][s]["at_depth"] = {{"angle_deg", degrees(at_depth->angle_rad)},
                                              {"tip_to_entry_mm", at_depth->tip_to_entry_m * 1e3},
                                              {"tip_off_axis_mm", at_depth->tip_off_axis_m * 1e3},
                                              {"depth_mm", at_depth->depth_m * 1e3}};
      }
    }
  }
}

/// How surely each head was touched, and what was expected of the rod.
void put_certainty(Json& side, const RodState& rod) {
  for (std::size_t head = 0; head < rod.touched.heads(); ++head) {
    side["touched"].push_back(
        {{"touches", rod.touched.touches_of(head)}, {"sd_mm", rod.touched.sd_m(head) * 1e3}});
  }
  if (rod.expected) {
    side["expected_within_share"] = rod.expected->within;
  }
}

Json ending_json(const LoggedOperation& session) {
  Json out{{"cut", !session.ended},
           {"records", session.records},
           {"dropped_bytes", session.dropped_bytes},
           {"resumed", session.resumed}};
  if (session.first_time) {
    out["begin_s"] = seconds(session.first_time->time_since_epoch());
    out["end_s"] = seconds(session.last_time->time_since_epoch());
  }
  return out;
}

Json figures_of(const LoggedOperation& session) {
  OperationResult result = result_of(session.state, {});
  const OperationIdentity& identity = session.identity;
  result.method = identity.method;
  result.seed = identity.seed != 0 ? std::optional(identity.seed) : std::nullopt;
  result.case_name = identity.case_name;
  result.patient_reference = identity.patient_reference;
  result.errors = identity.errors;
  result.calibration = session.calibration;
  result.completed = completed(session);
  if (!result.completed) {
    result.why_not = session.ended ? session.reason : ending_of(session);
  }
  Json out = report_of(result);
  out.erase("frames");  // of them the log knows nothing
  out["session"] = ending_json(session);
  if (const auto& tips = session.tips) {
    out["tips"] = {{"apart_mm", tips->apart_m.norm() * 1e3},
                   {"limit_mm", tips->limit_m * 1e3},
                   {"by_mm", tips->by_m.norm() * 1e3},
                   {"corrected", tips->corrected}};
  }
  if (const auto& axis = session.axis) {
    out["axis"] = {{"off_deg", degrees(axis->off_rad)},
                   {"sd_deg", degrees(axis->sd_rad)},
                   {"by_deg", degrees(axis->by_rad)},
                   {"corrected", axis->corrected}};
  }
  put_levels(out["levels"], session);
  for (Json& side : out["rod"].contains("sides") ? out["rod"]["sides"] : Json::array()) {
    for (const RodState& rod : session.state.rods) {
      if (side["side"] == name_of(rod.side)) {
        put_certainty(side, rod);
      }
    }
  }
  return out;
}

// The page.

void put_table(const std::string& title, const HtmlTable& table, std::string& html) {
  html += "<section><h2>" + title + "</h2>" + table.html() + "</section>";
}

void put_nothing(const std::string& title, std::string& html) {
  html += "<section><h2>" + title + "</h2><p>None recorded.</p></section>";
}

void put_ending(const LoggedOperation& session, const Verdict& verdict, std::string& html) {
  html += "<section id=verdict class=" + std::string(style_of(verdict)) + "><h2>" +
          (!session.ended ? "This session was cut off"
                          : (session.done ? "Operation completed" : "Operation incomplete")) +
          ": " + html_escaped(verdict.counts) + "</h2><p>" + html_escaped(ending_of(session)) +
          "</p>" + warnings_list(verdict) + "</section>";
}

std::string verdict(const LevelState& level) {
  if (level.attempts == 0) {
    return "not registered";
  }
  return level.accepted ? "<span class=good>accepted</span>"
                        : "<span class=bad>not accepted</span>";
}

/// "recorded, 0.4, <span class=bad>2.3</span>": each touch against the first.
std::string touches_of_landmark(const std::vector<LoggedTouch>& touches) {
  std::string text;
  for (const auto& [touch, dropped] : touches) {
    const std::string off = touch.first ? "recorded" : html_number(touch.off_m * 1e3, 1);
    text += (text.empty() ? "" : ", ") +
            (touch.first || touch.held() ? off : "<span class=bad>" + off + "</span>") +
            (dropped ? " (taken back)" : "");
  }
  return text.empty() ? kNoValue : text;
}

/// An error or a bound in mm, with a remark if it lacks the errors that all strokes share.
std::string bound_text(double value_m, bool registration_only) {
  return html_number(value_m * 1e3, 2) + (registration_only ? kRegistrationOnlyHtml : "");
}

void put_levels(const LoggedOperation& session, std::string& html) {
  if (session.state.levels.empty()) {
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
                   {"landmark", "mm off"},
                   {"screws done"}});
  for (std::size_t i = 0; i < session.state.levels.size(); ++i) {
    const LevelState& level = session.state.levels[i];
    table.row(html_escaped(level.plan.label));
    table.cell(verdict(level));
    table.cell(std::to_string(level.attempts));
    if (const auto& in_force = level.registration) {
      table.cell(html_number(in_force->rmse_m * 1e3, 2));
      table.cell(bound_text(nav::worst_m(level.predicted), level.registration_only()));
      table.cell(std::to_string(in_force->points));
      table.cell(html_number(level.digitization_s, 1));
    } else {
      for (int column = 0; column < 4; ++column) {
        table.cell(kNoValue);
      }
    }
    std::string checks;
    for (const nav::CheckPoint& check : level.check_points) {
      checks += (checks.empty() ? "" : ", ") + html_number(check.distance_m * 1e3, 1);
    }
    table.cell(checks.empty() ? kNoValue : checks);
    table.cell(touches_of_landmark(session.landmark_touches[i]));
    table.cell(std::to_string(std::ranges::count(level.screws, true, &ScrewState::done)) + " of " +
               std::to_string(level.screws.size()));
  }
  put_table("Levels", table, html);
}

void put_pose_at_depth(HtmlTable& table, const LevelState& level, const ScrewState& screw) {
  const auto& pose = screw.at_depth;
  const auto& clearance = screw.clearance_at_depth;
  const char* const none = screw.done ? "not measured" : kNoValue;
  if (pose) {
    table.cell(html_number(degrees(pose->angle_rad), 2));
    table.cell(html_number(pose->tip_off_axis_m * 1e3, 2));
    table.cell(html_number(pose->tip_to_entry_m * 1e3, 2));
    table.cell(html_number(pose->depth_m * 1e3, 2));
  } else {
    for (int column = 0; column < 4; ++column) {
      table.cell(none);
    }
  }
  table.cell(clearance ? html_number(clearance->least.clearance_m * 1e3, 2) : none);
  table.cell(clearance && clearance->spread
                 ? bound_text(clearance->spread->lower_95_m, level.registration_only())
                 : none);
}

/// "0.8 ± 0.4°, 0.6 ± 0.3 mm, kept; redone": the measurement of the placed wire.
std::string wire_text(const ScrewState& screw) {
  std::string text = kNoValue;
  if (const auto& wire = screw.wire.measured) {
    text = html_number(degrees(wire->axis.angle_rad.value), 1) + " \u00b1 " +
           html_number(degrees(wire->axis.angle_rad.sd), 1) + "\u00b0, " +
           html_number(wire->axis.entry_m.value * 1e3, 1) + " \u00b1 " +
           html_number(wire->axis.entry_m.sd * 1e3, 1) + " mm";
    if (!wire->within()) {
      text = "<span class=bad>" + text + "</span>" + (wire->kept ? ", kept" : "");
    }
  } else if (screw.wire.asked) {
    text = "not measured";
  }
  if (screw.redone > 0) {
    text += "; redone" + (screw.redone > 1 ? " " + std::to_string(screw.redone) + " times" : "");
  }
  return text;
}

void put_screws(const LoggedOperation& session, std::string& html) {
  HtmlTable table({{"screw"},
                   {"done at"},
                   {"angle to the plan", "\u00b0"},
                   {"tip off the axis", "mm"},
                   {"tip to entry", "mm"},
                   {"depth", "mm"},
                   {"clearance", "mm"},
                   {"95 % above", "mm"},
                   {"trajectory as placed"}});
  for (const LevelState& level : session.state.levels) {
    for (std::size_t i = 0; i < level.screws.size(); ++i) {
      const ScrewState& screw = level.screws[i];
      const nav::ScrewPlan& plan = level.plan.screws[i];
      table.row(html_escaped(level.plan.label) + " " + name_of(plan.side));
      table.cell(screw.done ? clock_text(*screw.done_at) : "not done");
      put_pose_at_depth(table, level, screw);
      table.cell(wire_text(screw));
      if (screw.replanned()) {
        table.below("planned in surgery: " +
                    html_escaped(text_of(nav::difference_of(screw.preoperative, plan))));
      }
    }
  }
  return table.empty() ? put_nothing("Screws", html)
                       : put_table("Screws, as measured at depth", table, html);
}

void put_rods(const LoggedOperation& session, std::string& html) {
  HtmlTable table({{"side"},
                   {"heads"},
                   {"touches of each", "SD, mm"},
                   {"template"},
                   {"length", "mm"},
                   {"bends", "mm: \u00b0"},
                   {"cut to", "mm"},
                   {"instructions", "mm: roll \u00b0, set \u00b0"},
                   {"expected within 1.0 mm", "%"}});
  const auto add = [](std::string& list, const char* separator, const std::string& one) {
    list += (list.empty() ? "" : separator) + one;
  };
  const auto cell = [&table](const std::string& text) {
    table.cell(text.empty() ? kNoValue : text);
  };
  for (const RodState& rod : session.state.rods) {
    if (!rod.done && rod.heads.empty()) {
      continue;
    }
    std::string touches;
    for (std::size_t head = 0; head < rod.touched.heads(); ++head) {
      add(touches, ", ",
          std::to_string(rod.touched.touches_of(head)) + ": " +
              html_number(rod.touched.sd_m(head) * 1e3, 1));
    }
    std::string bends;
    for (const nav::RodBend& bend : rod.rod ? rod.rod->bends : std::vector<nav::RodBend>()) {
      add(bends, ", ",
          html_number(bend.arc_length_m * 1e3, 0) + ": " + html_number(degrees(bend.angle_rad), 1));
    }
    std::string instructions;
    for (const nav::RodInstruction& bend :
         rod.instructions ? rod.instructions->bends : std::vector<nav::RodInstruction>()) {
      add(instructions, "; ",
          html_number(bend.arc.centre_m * 1e3, 1) + ": " +
              html_number(degrees(bend.arc.roll_rad), 0) + ", " +
              html_number(degrees(bend.set_rad), 1));
    }
    table.row(name_of(rod.side));
    table.cell(std::to_string(rod.heads.size()));
    cell(touches);
    table.cell(rod.done ? "taken" : "not taken");
    cell(rod.rod ? html_number(rod.rod->length_m * 1e3, 1) : "");
    cell(bends);
    cell(rod.instructions ? html_number(rod.instructions->cut_length_m() * 1e3, 1) : "");
    cell(instructions);
    cell(rod.expected ? html_number(100.0 * rod.expected->within, 0) : "");
  }
  if (!table.empty()) {
    put_table("Rods", table, html);
  }
}

void put_registrations(const LoggedOperation& session, std::string& html) {
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
  for (const LoggedRegistration& each : session.registrations) {
    table.row(clock_text(each.time));
    table.cell(html_escaped(session.state.levels[each.level].plan.label));
    table.cell(std::to_string(each.attempt));
    table.cell(each.passed ? "<span class=good>passed</span>"
                           : "<span class=bad>refused</span> " + html_escaped(each.reason));
    if (const auto& result = each.result) {
      table.cell(html_number(result->rmse_m * 1e3, 2));
      table.cell(html_number(result->runner_up_rmse_m * 1e3, 2));
      table.cell(has_bounds(*result) ? bound_text(result->tre_95_m, !(result->common.sd_m() > 0.0))
                                     : kNoValue);
      table.cell(std::to_string(result->points));
    } else {
      for (int column = 0; column < 4; ++column) {
        table.cell(kNoValue);
      }
    }
    if (each.tag_size) {
      std::string warning;
      append_tag_size_off(warning, each.tag_size->tool, each.tag_size->fraction);
      table.below(html_escaped(warning), "bad");
    }
  }
  put_table("Registrations", table, html);
}

void put_steps(const LoggedOperation& session, std::string& html) {
  HtmlTable table({{"time"}, {"step", "", true}});
  for (const auto& [time, step] : session.steps) {
    table.row(clock_text(time));
    table.cell(std::string(name_of(step)));
  }
  html += "<section><h2>Course</h2>" + table.html("narrow") + "</section>";
}

/// What was measured of the guide: its tip at the same landmark as the pointer's, its axis in
/// place.
void put_guide_notes(const LoggedOperation& session, std::string& html) {
  html += "<ul class=notes><li>";
  if (!session.tips) {
    html += "The tips of pointer and guide were not compared.</li>";
  } else {
    html += "At one landmark the tips of pointer and guide were " +
            html_number(session.tips->apart_m.norm() * 1e3, 2) + " mm apart" +
            (session.tips->corrected ? "; the guide\u2019s was corrected by " +
                                           html_number(session.tips->by_m.norm() * 1e3, 2) + " mm"
                                     : "") +
            ".</li>";
  }
  if (session.axis) {
    html += "<li>When its sleeve was last turned in place, the guide\u2019s axis was " +
            html_number(degrees(session.axis->off_rad), 2) + "\u00b0 off" +
            (session.axis->corrected
                 ? "; corrected by " + html_number(degrees(session.axis->by_rad), 2) + "\u00b0"
                 : "") +
            ".</li>";
  }
  html += "</ul>";
}

}  // namespace

std::string ending_of(const LoggedOperation& session) {
  const bool cut = !session.ended;
  std::string out = cut ? "The log has no end" : "The log is whole";
  if (session.first_time) {
    out += (cut ? ": its last record is of " : ": it ends at ") + clock_text(*session.last_time) +
           formatted(" on the headset's clock, %.1f s after the first",
                     seconds(*session.last_time - *session.first_time));
  } else {
    out += " and no record after its first";
  }
  if (session.dropped_bytes > 0) {
    out += "; one more record was torn and is not used";
  }
  if (cut) {
    return out + ". What came after it is not recorded.";
  }
  return out + (session.done || session.reason.empty() ? "." : "; " + session.reason + ".");
}

std::string session_json(const LoggedOperation& session) {
  return figures_of(session).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string session_page(const LoggedOperation& session, const std::string& source) {
  const OperationIdentity& identity = session.identity;
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: session</title>"
      "<meta name=viewport content=\"width=device-width, initial-scale=1\"><style>";
  html += page_style();
  html += "</style></head><body><header><h1>orthonav <span>report of a log</span></h1><p>Case <b>" +
          html_escaped(identity.case_name) + "</b>, method <b>" + html_escaped(identity.method) +
          "</b>, headset <b>" + html_escaped(identity.device) + "</b>, begun <b>" +
          html_escaped(identity.begun) + "</b>, log <b>" + html_escaped(source) +
          "</b>, relative to <b>" +
          (identity.patient_reference ? "the patient reference" : "the headset\u2019s map") +
          "</b></p></header><main>";
  const nlohmann::json figures = nlohmann::json::parse(session_json(session));
  put_ending(session, verdict_of(figures), html);
  const bool rods_alone = is_of_rods_alone(figures);
  if (!rods_alone) {
    put_screws(session, html);
    put_levels(session, html);
  }
  put_rods(session, html);
  if (!rods_alone) {
    put_registrations(session, html);
  }
  html += tracked_section(figures);
  put_steps(session, html);
  if (!rods_alone) {
    put_guide_notes(session, html);
  }
  return html +
         "<ul class=notes><li>From the log alone: images, frame times and errors against the truth "
         "are not recorded in it.</li><li>Times are of the headset's clock, minutes and "
         "seconds.</li><li>Written by orthonav " +
         html_escaped(identity.orthonav) +
         ". Not a medical device.</li></ul></main></body></html>\n";
}

}  // namespace orthonav::engine
