#include "engine/session/journal.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal_lines.h"
#include "engine/session/replan_wording.h"
#include "engine/session/wording.h"

namespace orthonav::engine {

namespace {

using Json = JournalLine;

/// Row-major, translation in mm.
Json matrix_mm(std::array<double, 16> m) {
  for (const std::size_t i : {3u, 7u, 11u}) {
    m[i] *= 1e3;
  }
  return m;
}

/// The additional figures of method `best` about a registration. Unbounded values become null.
void put_judgement(Json& line, const nav::Registration& result) {
  line["noise_mm"] = result.noise_m * 1e3;
  line["inlier_share"] = result.inlier_fraction;
  line["effective_points"] = result.effective_points;
  line["coverage_share"] = result.coverage_fraction;
  line["swept_share"] = result.shaft_collision_fraction;
  line["margin"] = result.log_likelihood_ratio;
  line["expected_tre_mm"] = result.predicted_tre_m * 1e3;
  line["tre_95_mm"] = result.tre_95_m * 1e3;
  line["weakest"] = result.weakest ? text_of(*result.weakest) : "";
  line["advice"] = result.stroke_next ? text_of(*result.stroke_next) : "";
  if (!result.fits_better.empty()) {
    line["fits_better"] = result.fits_better;
  }
}

Json plan_of(const std::vector<PlannedLevel>& levels) {
  Json plan = Json::array();
  for (const PlannedLevel& level : levels) {
    plan.push_back(Json{{"label", level.label}, {"screws", Json::array()}});
    for (const nav::Side side : level.screws) {
      plan.back()["screws"].push_back(name_of(side));
    }
    for (const AcceptedBreach& breach : level.breaches) {
      plan.back()["accepted_breaches"].push_back(
          Json{{"side", name_of(breach.side)}, {"reason", breach.reason}});
    }
  }
  return plan;
}

}  // namespace

PlannedLevel planned(const std::string& label, const std::vector<nav::ScrewPlan>& screws) {
  PlannedLevel level{label, {}, {}};
  for (const nav::ScrewPlan& screw : screws) {
    level.screws.push_back(screw.side);
    if (!screw.accepted_breach.empty()) {
      level.breaches.push_back({screw.side, screw.accepted_breach});
    }
  }
  return level;
}

Result<std::unique_ptr<Journal>> Journal::create(const std::string& path,
                                                 const JournalHeader& header) {
  auto log = LineLog::create(path);
  if (!log) {
    return log.error();
  }
  Json line{{"format", "orthonav session"},
            {"format_version", 1},
            {"orthonav", header.version},
            {"device", header.device},
            {"method", header.method},
            {"case", header.case_name},
            {"seed", header.seed},
            {"patient_reference", header.patient_reference},
            {"levels", plan_of(header.levels)}};
  if (header.errors) {
    line["common_errors"] = errors_json(*header.errors);
  }
  add_line(**log, line);
  return std::unique_ptr<Journal>(new Journal(std::move(*log), header.epoch_ticks_100ns));
}

Status Journal::finish(const JournalEnd& end) {
  const Timestamp time = std::max(newest_, end.time.value_or(newest_));
  Json line = journal_line(file_ticks(time), time, "ended");
  if (!end.reason.empty()) {
    line["reason"] = end.reason;
  }
  add_line(*log_, line);
  return log_->finish();
}

void Journal::happened(Timestamp time, Step from, Event event, Cell answer) {
  newest_ = std::max(newest_, time);
  Json line = journal_line(file_ticks(time), time, "event");
  line["step"] = name_of(from);
  line["event"] = name_of(event);
  line["action"] = name_of(answer.action);
  line["next"] = name_of(answer.next);
  add_line(*log_, line, answer.action == Action::kAccept ? kDurable : LineLog::Keep::kWritten);
}

void Journal::asked_from_outside(const Request& request) {
  Json line = journal_line(file_ticks(request.time), request.time, "asked from outside");
  line["from"] = request.from;
  line["asked"] = request.text;
  add_line(*log_, line);
}

void Journal::not_understood(const Phrase& phrase) {
  Json line = journal_line(file_ticks(phrase.time), phrase.time, "not understood");
  line["phrase"] = phrase.text;
  line["confidence"] = phrase.confidence;
  add_line(*log_, line);
}

void Journal::registered(Timestamp time, const LevelState& level,
                         const RegistrationOutcome& outcome) {
  tell_registration(time, level, outcome, false);
}

void Journal::registration_restored(Timestamp time, const LevelState& level) {
  const bool provisional = !level.registration->accepted;
  tell_registration(time, level, {level.registration, std::nullopt, provisional}, true);
}

void Journal::tell_registration(Timestamp time, const LevelState& level,
                                const RegistrationOutcome& outcome, bool restored) {
  Json line = journal_line(file_ticks(time), time, "registration", level);
  line["attempt"] = level.attempts;
  line["accepted"] = outcome.passed();
  if (outcome.provisional) {
    line["provisional"] = true;
  }
  if (restored) {
    line["restored"] = true;
    line["accepted_earlier"] = level.accepted;
  }
  if (!outcome.passed()) {
    line["reason"] = refusal_text(outcome);
  }
  if (const auto& result = outcome.result) {
    line["points"] = result->points;
    line["rmse_mm"] = result->rmse_m * 1e3;
    line["runner_up_rmse_mm"] = result->runner_up_rmse_m * 1e3;
    line["world_from_vertebra_mm"] = matrix_mm(result->world_from_vertebra.row_major());
    if (result->tre_95_m > 0.0) {
      put_judgement(line, *result);
      line["registration_only"] = !(result->common.sd_m() > 0.0);
    }
  }
  if (level.tag_size) {
    std::string warning;
    append_tag_size_off(warning, level.tag_size->tool, level.tag_size->fraction);
    line["warning"] = warning;
  }
  // Infinite, that is unbounded, values become null.
  if (outcome.passed()) {
    line["predicted_tre_mm"] = nav::worst_m(level.predicted) * 1e3;
  }
  add_line(*log_, line, kDurable);
}

void Journal::accepted(Timestamp time, const LevelState& level, std::string_view /*shown*/) {
  Json line = journal_line(file_ticks(time), time, "accepted", level);
  line["check_points"] = level.check_points.size();
  line["world_from_vertebra_mm"] = matrix_mm(level.registration->world_from_vertebra.row_major());
  line["predicted_tre_mm"] = nav::worst_m(level.predicted) * 1e3;
  if (level.registration->tre_95_m > 0.0) {
    line["tre_95_mm"] = level.registration->tre_95_m * 1e3;
  }
  add_line(*log_, line, kDurable);
}

// What was touched: check points, the landmark, screw heads.

void Journal::check_point_recorded(Timestamp time, const LevelState& level) {
  const nav::CheckPoint& point = level.check_points.back();
  JournalLine line = journal_line(file_ticks(time), time, "check point", level);
  line["number"] = level.check_points.size();
  line["in_world_mm"] = millimetres(point.place.v);
  line["distance_mm"] = point.distance_m * 1e3;
  line["within"] = point.within;
  add_line(*log_, line);
}

void Journal::check_point_dropped(Timestamp time, const LevelState& level) {
  JournalLine line = journal_line(file_ticks(time), time, "check point dropped", level);
  line["number"] = level.check_points.size() + 1;
  add_line(*log_, line);
}

void Journal::landmark_touched(Timestamp time, const LevelState& level,
                               const LandmarkTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "landmark", level);
  line["first"] = touch.first;
  if (touch.first) {
    line["in_vertebra_mm"] = millimetres(level.landmark->in_vertebra.v);
  } else {
    line["off_mm"] = touch.off_m * 1e3;
    line["within"] = touch.held();
  }
  line["limit_mm"] = touch.limit_m * 1e3;
  add_line(*log_, line, kDurable);
}

void Journal::tips_compared(Timestamp time, const TipDifference& difference) {
  JournalLine line = journal_line(file_ticks(time), time, "tips");
  line.update({{"apart_mm", difference.apart_m.norm() * 1e3},
               {"limit_mm", difference.limit_m * 1e3},
               {"by_mm", difference.by_m.norm() * 1e3},
               {"corrected", difference.corrected}});
  add_line(*log_, line, kDurable);
}

void Journal::axis_compared(Timestamp time, const AxisDifference& difference) {
  JournalLine line = journal_line(file_ticks(time), time, "axis");
  line.update({{"off_deg", degrees(difference.off_rad)},
               {"sd_deg", degrees(difference.sd_rad)},
               {"by_deg", degrees(difference.by_rad)},
               {"corrected", difference.corrected}});
  add_line(*log_, line, kDurable);
}

void Journal::landmark_dropped(Timestamp time, const LevelState& level) {
  JournalLine line = journal_line(file_ticks(time), time, "landmark dropped", level);
  add_line(*log_, line);
}

void Journal::head_recorded(Timestamp time, nav::Side side, const HeadTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "head");
  line["side"] = name_of(side);
  line["number"] = touch.head + 1;
  line["touches"] = touch.touches;
  line["in_world_mm"] = millimetres(touch.place.v);
  line["sd_mm"] = touch.head_sd_m * 1e3;
  add_line(*log_, line);
}

void Journal::head_dropped(Timestamp time, nav::Side side, const HeadTouch& touch) {
  JournalLine line = journal_line(file_ticks(time), time, "head dropped");
  line["side"] = name_of(side);
  line["number"] = touch.head + 1;
  line["touches"] = touch.touches - 1;
  add_line(*log_, line);
}

// The outcome of a screw: its wire as measured, another entry, and its final state.

namespace {

/// The clearance along the tool at depth, if known.
void put_clearance_at_depth(JournalLine& line, const LevelState& level, std::size_t screw) {
  const auto& clearance = level.screws[screw].clearance_at_depth;
  if (!clearance) {
    return;
  }
  line["clearance_mm"] = clearance->least.clearance_m * 1e3;
  line["grade"] = nav::name_of(nav::grade_of(clearance->least.clearance_m));
  if (clearance->spread) {
    line["clearance_95_mm"] = clearance->spread->lower_95_m * 1e3;
    line["grade_probability"] = grades_json(clearance->spread->grade_probability);
  }
}

/// The outcome of its wire: measured within the limits, kept beyond one, or not measured.
void put_wire_outcome(JournalLine& line, const LevelState& level, std::size_t screw) {
  const WireOutcome& outcome = level.screws[screw].wire;
  if (!outcome.asked) {
    return;
  }
  line["wire"] = !outcome.measured ? "not measured" : outcome.measured->kept ? "kept" : "within";
  line["redone"] = level.screws[screw].redone;
}

}  // namespace

void Journal::wire_measured(Timestamp time, const LevelState& level, std::size_t screw,
                            const PlacedWire& wire) {
  const nav::PlacedAxis& axis = wire.axis;
  const Vec3 direction = axis.line.direction;
  JournalLine line = journal_line(file_ticks(time), time, "wire", level);
  line["side"] = name_of(level.plan.screws[screw].side);
  line["pairs"] = wire.pairs;
  line["angle_deg"] = degrees(axis.angle_rad.value);
  line["angle_sd_deg"] = degrees(axis.angle_rad.sd);
  line["angle_limit_deg"] = degrees(wire.angle_limit_rad);
  line["entry_mm"] = axis.entry_m.value * 1e3;
  line["entry_sd_mm"] = axis.entry_m.sd * 1e3;
  line["entry_limit_mm"] = wire.entry_limit_m * 1e3;
  line["within"] = wire.within();
  line["kept"] = wire.kept;
  line["point_mm"] = millimetres(axis.line.point.v);
  line["direction"] = JournalLine::array({direction.x, direction.y, direction.z});
  line["point_covariance_mm2"] = scaled(axis.point_covariance_m2, 1e6);
  line["direction_covariance_rad2"] = scaled(axis.direction_covariance_rad2, 1.0);
  add_line(*log_, line, kDurable);
}

void Journal::screw_redone(Timestamp time, const LevelState& level, std::size_t screw,
                           const nav::OtherEntry& entry) {
  JournalLine line = journal_line(file_ticks(time), time, "screw redone", level);
  line["side"] = name_of(level.plan.screws[screw].side);
  line["redone"] = level.screws[screw].redone;
  line["entry_mm"] = millimetres(entry.entry.v);
  line["from_hole_mm"] = entry.from_hole_m * 1e3;
  line["clearance_mm"] = entry.clearance.clearance_m * 1e3;
  add_line(*log_, line, kDurable);
}

void Journal::calibration_found(Timestamp time, const CalibrationInUse& found) {
  JournalLine line = journal_line(file_ticks(time), time, "calibration");
  line.update(calibration_json(found));
  add_line(*log_, line);
}

void Journal::screw_done(Timestamp time, const LevelState& level, std::size_t screw,
                         const ToolGuidance* at_depth) {
  JournalLine line = journal_line(file_ticks(time), time, "screw", level);
  line["side"] = name_of(level.plan.screws[screw].side);
  if (at_depth && at_depth->measured) {
    line["pose_time_100ns"] = ticks_100ns(at_depth->pose_time);
    line["angle_deg"] = degrees(at_depth->measured->angle_rad);
    line["tip_to_entry_mm"] = at_depth->measured->tip_to_entry_m * 1e3;
    line["tip_off_axis_mm"] = at_depth->measured->tip_off_axis_m * 1e3;
    line["depth_mm"] = at_depth->measured->depth_m * 1e3;
  }
  put_clearance_at_depth(line, level, screw);
  put_executed(line, level.screws[screw].executed, level.screws[screw].clearance_at_depth);
  put_wire_outcome(line, level, screw);
  add_line(*log_, line, kDurable);
}

// The journal's lines about rods.

namespace {

/// The instructions to bend the rod, or why there are none.
void put_instructions(JournalLine& line, const RodState& rod) {
  if (!rod.no_instructions.empty()) {
    line["no_instructions"] = rod.no_instructions;
  }
  if (!rod.instructions) {
    return;
  }
  line["cut_length_mm"] = rod.instructions->cut_length_m() * 1e3;
  if (rod.seat_by_pointer_m) {
    line["seat_by_pointer_mm"] = *rod.seat_by_pointer_m * 1e3;
  }
  JournalLine instructions = JournalLine::array();
  for (const nav::RodInstruction& bend : rod.instructions->bends) {
    instructions.push_back(JournalLine{{"arc_length_mm", bend.arc.centre_m * 1e3},
                                       {"roll_deg", degrees(bend.arc.roll_rad)},
                                       {"angle_deg", degrees(bend.arc.angle_rad)},
                                       {"set_deg", degrees(bend.set_rad)}});
  }
  line["instructions"] = instructions;
}

/// How sure the touched heads are, and what is expected of the rod.
void put_certainty(JournalLine& line, const RodState& rod) {
  JournalLine touched = JournalLine::array();
  for (std::size_t head = 0; head < rod.touched.heads(); ++head) {
    touched.push_back(JournalLine{{"touches", rod.touched.touches_of(head)},
                                  {"sd_mm", rod.touched.sd_m(head) * 1e3}});
  }
  line["touched"] = touched;
  if (rod.expected) {
    line["expected_within_share"] = rod.expected->within;
  }
}

}  // namespace

void Journal::rod_done(Timestamp time, const RodState& rod) {
  JournalLine line = journal_line(file_ticks(time), time, "rod");
  line["side"] = name_of(rod.side);
  line["heads"] = rod.heads.size();
  if (rod.rod) {
    line["length_mm"] = rod.rod->length_m * 1e3;
    JournalLine bends = JournalLine::array();
    for (const nav::RodBend& bend : rod.rod->bends) {
      bends.push_back(JournalLine{{"arc_length_mm", bend.arc_length_m * 1e3},
                                  {"angle_deg", degrees(bend.angle_rad)}});
    }
    line["bends"] = bends;
  }
  if (rod.took_s) {
    line["time_s"] = *rod.took_s;
  }
  put_instructions(line, rod);
  put_certainty(line, rod);
  add_line(*log_, line, kDurable);
}

namespace {

JournalLine plan_in_mm(const nav::ScrewPlan& screw) {
  JournalLine out{{"entry_mm", millimetres(screw.entry.v)},
                  {"target_mm", millimetres(screw.target.v)},
                  {"diameter_mm", 2.0 * screw.radius_m * 1e3}};
  if (!screw.accepted_breach.empty()) {
    out["accepted_breach"] = screw.accepted_breach;
  }
  return out;
}

}  // namespace

/// The plan made in surgery, and how it differs from the preoperative one.
void Journal::replanned(Timestamp time, const LevelState& level, const Replan& asked,
                        const ScrewReplanned& done) {
  JournalLine line = journal_line(file_ticks(time), time, "replanned", level);
  line["side"] = name_of(done.to.side);
  line["asked"] = text_of(asked);
  line["undone"] = done.undone;
  line["from"] = plan_in_mm(done.from);
  line["to"] = plan_in_mm(done.to);
  if (done.clearance_m) {
    line["clearance_mm"] = *done.clearance_m * 1e3;
  }
  if (!done.as_before_surgery) {
    line["planned_in_surgery"] = difference_line(done.difference);
  }
  add_line(*log_, line, kDurable);
}

JournalLine difference_line(const nav::ScrewDifference& d) {
  return JournalLine{{"entry_cranial_mm", d.entry_cranial_m * 1e3},
                     {"entry_medial_mm", d.entry_medial_m * 1e3},
                     {"entry_inward_mm", d.entry_inward_m * 1e3},
                     {"aim_cranial_deg", degrees(d.aim_cranial_rad)},
                     {"aim_medial_deg", degrees(d.aim_medial_rad)},
                     {"diameter_from_mm", d.diameter_from_m * 1e3},
                     {"diameter_to_mm", d.diameter_to_m * 1e3},
                     {"length_from_mm", d.length_from_m * 1e3},
                     {"length_to_mm", d.length_to_m * 1e3}};
}

}  // namespace orthonav::engine
