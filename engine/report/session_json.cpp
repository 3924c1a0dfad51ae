#include <nlohmann/json.hpp>
#include <optional>

#include "base/angle.h"
#include "engine/report/replan_figures.h"
#include "engine/report/session_report.h"
#include "engine/session/journal_lines.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

void put_length_mm(Json& object, const char* key, const std::optional<double>& length_m) {
  if (length_m) {
    object[key] = *length_m * 1e3;
  }
}

/// Nothing if no measurement was asked for.
void put_recorded_wire(Json& out, const RecordedScrew& screw) {
  if (!screw.wire_asked && !screw.wire) {
    return;
  }
  if (const auto& wire = screw.wire) {
    out["wire"] = Json{{"angle_deg", degrees(wire->angle_rad)},
                       {"angle_sd_deg", degrees(wire->angle_sd_rad)},
                       {"entry_mm", wire->entry_m * 1e3},
                       {"entry_sd_mm", wire->entry_sd_m * 1e3},
                       {"within", wire->within},
                       {"kept", wire->kept}};
  } else {
    out["wire"] = "not measured";
  }
}

Json recorded_screw_json(const RecordedScrew& screw) {
  Json out{{"side", name_of(screw.side)}, {"done", screw.done}};
  if (screw.at_depth) {
    out["at_depth"] = Json{{"angle_deg", degrees(screw.at_depth->angle_rad)},
                           {"tip_to_entry_mm", screw.at_depth->tip_to_entry_m * 1e3},
                           {"tip_off_axis_mm", screw.at_depth->tip_off_axis_m * 1e3},
                           {"depth_mm", screw.at_depth->depth_m * 1e3}};
    put_length_mm(out["at_depth"], "clearance_mm", screw.at_depth->clearance_m);
    put_length_mm(out["at_depth"], "clearance_95_mm", screw.at_depth->clearance_95_m);
    if (!screw.at_depth->grade.empty()) {
      out["at_depth"]["grade"] = screw.at_depth->grade;
    }
    if (screw.at_depth->grade_probability) {
      out["at_depth"]["grade_probability"] = grades_json(*screw.at_depth->grade_probability);
    }
  }
  if (screw.executed) {
    out["executed"] = executed_json(*screw.executed);
  }
  if (!screw.not_measured.empty()) {
    out["not_measured"] = screw.not_measured;
  }
  put_recorded_wire(out, screw);
  if (screw.redone > 0) {
    out["redone"] = screw.redone;
  }
  put_planned_in_surgery(out, screw.planned_in_surgery);
  return out;
}

Json recorded_landmark_json(const RecordedLandmark& touch) {
  Json out{{"first", touch.first}};
  if (!touch.first) {
    out["off_mm"] = touch.off_m * 1e3;
    out["within"] = touch.within;
  }
  out["limit_mm"] = touch.limit_m * 1e3;
  if (touch.dropped) {
    out["dropped"] = true;
  }
  return out;
}

Json recorded_level_json(const RecordedLevel& level, const SessionRecord& session) {
  Json out{{"label", level.label}, {"accepted", level.accepted}, {"attempts", level.attempts}};
  if (level.registration) {
    const RecordedRegistration& in_force = session.registrations[*level.registration];
    put_length_mm(out, "rmse_mm", in_force.rmse_m);
    put_length_mm(out, "predicted_tre_mm", in_force.predicted_tre_m);
    if (in_force.registration_only) {
      out["registration_only"] = *in_force.registration_only;
    }
    if (in_force.points) {
      out["points"] = *in_force.points;
    }
  }
  if (level.digitization_s) {
    out["digitization_s"] = *level.digitization_s;
  }
  for (const RecordedCheck& check : level.checks) {
    out["check_points_mm"].push_back(check.distance_m * 1e3);
  }
  for (const RecordedLandmark& touch : level.landmark) {
    out["landmark"].push_back(recorded_landmark_json(touch));
  }
  out["screws"] = Json::array();
  for (const RecordedScrew& screw : level.screws) {
    out["screws"].push_back(recorded_screw_json(screw));
  }
  return out;
}

/// As in the journal.
void put_instructions(Json& side, const RecordedRod& rod) {
  if (!rod.no_instructions.empty()) {
    side["no_instructions"] = rod.no_instructions;
  }
  put_length_mm(side, "cut_length_mm", rod.cut_length_m);
  for (const RecordedInstruction& bend : rod.instructions) {
    side["instructions"].push_back(Json{{"arc_length_mm", bend.arc_length_m * 1e3},
                                        {"roll_deg", degrees(bend.roll_rad)},
                                        {"angle_deg", degrees(bend.angle_rad)},
                                        {"set_deg", degrees(bend.set_rad)}});
  }
}

/// As in the journal.
void put_certainty(Json& side, const RecordedRod& rod) {
  for (const RecordedHead& head : rod.touched) {
    side["touched"].push_back(Json{{"touches", head.touches}, {"sd_mm", head.sd_m * 1e3}});
  }
  if (rod.expected_within) {
    side["expected_within_share"] = *rod.expected_within;
  }
}

/// As report.json has it: each rod in `sides`, and the first one that has a template by itself.
Json recorded_rods_json(const std::vector<RecordedRod>& rods) {
  Json out = Json::object();
  Json sides = Json::array();
  for (const RecordedRod& rod : rods) {
    Json side{{"side", name_of(rod.side)}, {"heads", rod.heads}};
    put_length_mm(side, "length_mm", rod.length_m);
    if (out.empty() && rod.length_m) {
      out = side;
    }
    put_instructions(side, rod);
    put_certainty(side, rod);
    sides.push_back(std::move(side));
  }
  if (!sides.empty()) {
    out["sides"] = std::move(sides);
  }
  return out;
}

Json ending_json(const SessionRecord& session) {
  Json out{{"cut", session.cut},
           {"last_line_torn", session.last_line_torn},
           {"lines", session.lines},
           {"plan_recorded", session.has_plan}};
  if (session.begin && session.end) {
    out["begin_s"] = seconds(session.begin->time_since_epoch());
    out["end_s"] = seconds(session.end->time_since_epoch());
  }
  return out;
}

}  // namespace

std::string session_json(const SessionRecord& session) {
  Json out{{"method", session.method}};
  if (session.seed != 0) {
    out["seed"] = session.seed;
  }
  out["case"] = session.case_name;
  if (session.patient_reference) {
    out["patient_reference"] = *session.patient_reference;
  }
  if (session.errors) {
    out["common_errors"] = errors_json(*session.errors);
  }
  out["completed"] = session.completed();
  if (session.cut) {
    out["why_not"] = ending_of(session);
  } else if (!session.reason.empty()) {
    out["why_not"] = session.reason;
  }
  out["session"] = ending_json(session);
  if (session.tips) {
    out["tips"] = Json{{"apart_mm", session.tips->apart_m * 1e3},
                       {"limit_mm", session.tips->limit_m * 1e3},
                       {"by_mm", session.tips->by_m * 1e3},
                       {"corrected", session.tips->corrected}};
  }
  if (session.calibration) {
    out["calibration"] = calibration_json(*session.calibration);
  }
  if (session.axis) {
    out["axis"] = Json{{"off_deg", degrees(session.axis->off_rad)},
                       {"sd_deg", degrees(session.axis->sd_rad)},
                       {"by_deg", degrees(session.axis->by_rad)},
                       {"corrected", session.axis->corrected}};
  }
  out["levels"] = Json::array();
  for (const RecordedLevel& level : session.levels) {
    out["levels"].push_back(recorded_level_json(level, session));
  }
  out["rod"] = recorded_rods_json(session.rods);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orthonav::engine
