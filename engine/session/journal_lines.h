#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/time.h"
#include "engine/io/line_log.h"
#include "engine/session/guidance.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

// The lines of a journal, for the files that write them.

/// A line about no level; its keys keep their order.
using JournalLine = nlohmann::ordered_json;

[[nodiscard]] JournalLine journal_line(std::int64_t file_ticks, Timestamp time, const char* what);
/// A line about a level.
[[nodiscard]] JournalLine journal_line(std::int64_t file_ticks, Timestamp time, const char* what,
                                       const LevelState& level);
[[nodiscard]] JournalLine millimetres(Vec3 v_m);
/// Where a tool went, in the vertebra's frame, with its covariances where they are known.
[[nodiscard]] JournalLine executed_json(const nav::ExecutedTrajectory& executed);
/// A 3x3 matrix by rows, times `factor`.
[[nodiscard]] JournalLine scaled(const std::array<double, 9>& covariance, double factor);
/// Adds `executed` of a screw that is done, and names what was not measured of it or of its
/// clearance.
void put_executed(JournalLine& line, const std::optional<nav::ExecutedTrajectory>& executed,
                  const std::optional<nav::ScrewClearance>& at_depth);
/// The probability of each grade, A to E.
[[nodiscard]] JournalLine grades_json(const std::array<double, nav::kPedicleGrades>& probability);
/// In mm and degrees.
[[nodiscard]] JournalLine difference_line(const nav::ScrewDifference& difference);

/// For what must survive a loss of power: the basis of guidance, and what was done to the patient.
inline constexpr auto kDurable = LineLog::Keep::kDurable;

/// Labels come from files, so bytes that are not UTF-8 must not end the journal.
void add_line(LineLog& log, const JournalLine& line, LineLog::Keep keep = LineLog::Keep::kWritten);

}  // namespace orthonav::engine
