#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/session/journal.h"
#include "engine/session/journal_lines.h"

namespace orthonav::engine {

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

}  // namespace orthonav::engine
