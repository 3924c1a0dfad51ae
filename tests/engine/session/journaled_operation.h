#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/session/journal.h"
#include "engine/session/journal_reader.h"
#include "engine/session/session.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::journal_reader_test {

/// A session with its journal, finished or not.
struct Journaled {
  explicit Journaled(const std::vector<std::string>& labels,
                     Verification verification = Verification::kByEye)
      : operation(labels, {}, verification) {
    JournalHeader header{"0.1.0", "fake", "paper", "boxes", 18'446'744'073'709'551'615U, 0, {}};
    for (const LevelState& level : operation.session().levels()) {
      header.patient_reference = true;
      header.levels.push_back(planned(level.plan.label, level.plan.screws));
    }
    journal = Journal::create(path, header).value();
    operation.session().observe(journal.get());
  }

  SessionRecord finished(const std::string& reason = "") {
    EXPECT_TRUE(journal->finish({{}, reason}).ok());
    auto record = read_journal(path);
    EXPECT_TRUE(record.ok()) << record.error().message;
    return record.ok() ? *record : SessionRecord{};
  }

  test::TemporaryFolder folder;
  std::string path = folder.file("session.orthonav");
  test::ScriptedOperation operation;
  std::unique_ptr<Journal> journal;
};

inline void expect_the_same(const RecordedLevel& read, const LevelState& level,
                            const SessionRecord& record) {
  SCOPED_TRACE(level.plan.label);
  EXPECT_EQ(read.label, level.plan.label);
  EXPECT_EQ(read.attempts, level.attempts);
  EXPECT_EQ(read.accepted, level.accepted);
  ASSERT_EQ(read.registration.has_value(), level.registration.has_value());
  if (read.registration) {
    const RecordedRegistration& in_force = record.registrations[*read.registration];
    EXPECT_DOUBLE_EQ(in_force.rmse_m.value_or(-1), level.registration->rmse_m);
    EXPECT_EQ(in_force.points, level.registration->points);
    EXPECT_NEAR(read.digitization_s.value_or(-1), level.digitization_s, 1e-9);
  }
  ASSERT_EQ(read.checks.size(), level.check_points.size());
  for (std::size_t c = 0; c < read.checks.size(); ++c) {
    EXPECT_DOUBLE_EQ(read.checks[c].distance_m, level.check_points[c].distance_m);
    EXPECT_EQ(read.checks[c].within, level.check_points[c].within);
  }
  ASSERT_EQ(read.screws.size(), level.plan.screws.size());
  for (std::size_t s = 0; s < read.screws.size(); ++s) {
    EXPECT_EQ(read.screws[s].side, level.plan.screws[s].side);
    EXPECT_EQ(read.screws[s].done, level.screws[s].done);
  }
}

inline void expect_the_same(const RecordedRod& rod, const RodState& state) {
  ASSERT_EQ(state.side, rod.side);
  EXPECT_EQ(rod.heads, state.heads.size());
  EXPECT_EQ(rod.done, state.done);
  if (!rod.done) {
    return;
  }
  EXPECT_DOUBLE_EQ(rod.length_m.value_or(-1), state.rod->length_m);
  EXPECT_EQ(rod.bends.size(), state.rod->bends.size());
  ASSERT_EQ(rod.cut_length_m.has_value(), state.instructions.has_value());
  EXPECT_EQ(rod.no_instructions, state.no_instructions);
  ASSERT_EQ(rod.touched.size(), state.heads.size());
  for (std::size_t head = 0; head < rod.touched.size(); ++head) {
    EXPECT_EQ(rod.touched[head].touches, state.touched.touches_of(head));
    EXPECT_DOUBLE_EQ(rod.touched[head].sd_m, state.touched.sd_m(head));
  }
  ASSERT_EQ(rod.expected_within.has_value(), state.expected.has_value());
  EXPECT_DOUBLE_EQ(rod.expected_within.value_or(0), state.expected ? state.expected->within : 0);
  EXPECT_NE(rod.cut_length_m.has_value(), !rod.no_instructions.empty());
  if (state.instructions) {
    EXPECT_DOUBLE_EQ(*rod.cut_length_m, state.instructions->cut_length_m());
    EXPECT_EQ(rod.instructions.size(), state.instructions->bends.size());
  }
}

/// Compares every figure that the session itself has about its levels and rods.
inline void expect_the_same(const SessionRecord& record, const Session& session) {
  ASSERT_EQ(record.levels.size(), session.levels().size());
  for (std::size_t i = 0; i < record.levels.size(); ++i) {
    expect_the_same(record.levels[i], session.levels()[i], record);
  }
  for (const RecordedRod& rod : record.rods) {
    expect_the_same(rod, session.rods()[rod.side == Side::kLeft ? 0 : 1]);
  }
}

}  // namespace orthonav::engine::journal_reader_test
