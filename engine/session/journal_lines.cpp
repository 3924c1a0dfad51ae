#include "engine/session/journal_lines.h"

#include <nlohmann/json.hpp>

namespace orthonav::engine {

JournalLine millimetres(Vec3 v_m) {
  return JournalLine::array({v_m.x * 1e3, v_m.y * 1e3, v_m.z * 1e3});
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
