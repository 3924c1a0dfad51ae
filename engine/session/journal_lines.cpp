#include "engine/session/journal_lines.h"

#include <nlohmann/json.hpp>

namespace orthonav::engine {

JournalLine millimetres(Vec3 v_m) {
  return JournalLine::array({v_m.x * 1e3, v_m.y * 1e3, v_m.z * 1e3});
}

JournalLine scaled(const std::array<double, 9>& covariance, double factor) {
  JournalLine out = JournalLine::array();
  for (const double value : covariance) {
    out.push_back(value * factor);
  }
  return out;
}

JournalLine executed_json(const nav::ExecutedTrajectory& executed) {
  const Vec3 direction = executed.axis.direction;
  JournalLine out{{"pairs", executed.pairs},
                  {"entry_mm", millimetres(executed.axis.point.v)},
                  {"direction", JournalLine::array({direction.x, direction.y, direction.z})},
                  {"depth_mm", executed.depth_m * 1e3}};
  if (executed.point_covariance_m2) {
    out["entry_covariance_mm2"] = scaled(*executed.point_covariance_m2, 1e6);
    out["direction_covariance_rad2"] = scaled(*executed.direction_covariance_rad2, 1.0);
  }
  return out;
}

void put_executed(JournalLine& line, const std::optional<nav::ExecutedTrajectory>& executed,
                  const std::optional<nav::ScrewClearance>& at_depth) {
  if (executed) {
    line["executed"] = executed_json(*executed);
  } else {
    line["not_measured"].push_back("executed");
  }
  if (!at_depth) {
    line["not_measured"].push_back("clearance");
  } else if (!at_depth->spread) {
    line["not_measured"].push_back("grade_probability");
  }
}

JournalLine grades_json(const std::array<double, nav::kPedicleGrades>& probability) {
  JournalLine out = JournalLine::object();
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    out[nav::name_of(static_cast<nav::PedicleGrade>(g))] = probability[g];
  }
  return out;
}

JournalLine journal_line(std::int64_t file_ticks, Timestamp time, const char* what) {
  return JournalLine{{"time_100ns", file_ticks},
                     {"time_ns", std::int64_t{time.time_since_epoch().count()}},
                     {"what", what}};
}

JournalLine journal_line(std::int64_t file_ticks, Timestamp time, const char* what,
                         const LevelState& level) {
  JournalLine line = journal_line(file_ticks, time, what);
  line["level"] = level.plan.label;
  return line;
}

void add_line(LineLog& log, const JournalLine& line, LineLog::Keep keep) {
  log.add(line.dump(-1, ' ', false, JournalLine::error_handler_t::replace), keep);
}

}  // namespace orthonav::engine
