#include <gmock/gmock.h>

#include "base/angle.h"
#include "tests/engine/session/journaled_operation.h"
#include "tests/support/rod_on_table.h"

namespace orthonav::engine::journal_reader_test {
namespace {

constexpr double kAsWritten_rad = 1e-12;

/// An operation up to its measured rod, with a journal.
struct JournaledRod : Journaled {
  JournaledRod() : Journaled({"L4", "L5"}) { test::touches_heads_of_a_rod(operation); }
  void measures_next_bend(double too_far_rad = 0.0) {
    operation.says("next");
    if (rod.bends.empty()) {
      operation.says("next");  // the straight rod is not stroked
    }
    rod.is_bent_and_measured(operation, too_far_rad);
  }
  [[nodiscard]] const RodState& state() { return operation.session().rods()[0]; }
  test::RodOnTable rod;
};

TEST(JournalOfARod, HasItsBendsAsMeasured) {
  JournaledRod j;
  j.measures_next_bend(0.04);
  j.measures_next_bend();
  ASSERT_EQ(j.state().measured.size(), 2U);
  j.operation.says("done");
  const SessionRecord record = j.finished();
  ASSERT_EQ(record.rods.size(), 1U);
  const RecordedRod& read = record.rods[0];
  EXPECT_TRUE(read.done);
  ASSERT_EQ(read.measured.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const nav::MeasuredBend& found = j.state().measured[k].found;
    EXPECT_EQ(read.measured[k].bend, k + 1);
    EXPECT_NEAR(read.measured[k].angle_rad, found.arc.angle_rad, kAsWritten_rad);
    EXPECT_NEAR(read.measured[k].angle_se_rad, found.angle_se_rad, kAsWritten_rad);
    EXPECT_NEAR(read.measured[k].roll_rad, found.arc.roll_rad, kAsWritten_rad);
    EXPECT_NEAR(read.measured[k].roll_se_rad, found.roll_se_rad, kAsWritten_rad);
    EXPECT_NEAR(read.measured[k].rms_m, found.rms_m, 1e-12);
    EXPECT_NEAR(read.instructions[k].angle_rad, found.arc.angle_rad, kAsWritten_rad)
        << "the instructions after them";
  }
  EXPECT_EQ(read.given_up, 0U);
}

TEST(JournalOfARod, ThatIsNotDoneHasWhatWasMeasuredSoFar) {
  JournaledRod j;
  j.measures_next_bend();
  j.measures_next_bend();
  j.operation.says("delete");
  const SessionRecord record = j.finished("cable");
  ASSERT_EQ(record.rods.size(), 1U);
  EXPECT_FALSE(record.rods[0].done);
  EXPECT_EQ(record.rods[0].measured.size(), 1U) << "one was taken back";
}

TEST(JournalOfARod, CountsThoseThatWereGivenUp) {
  JournaledRod j;
  j.measures_next_bend();
  j.measures_next_bend(30.0 * kRadiansPerDegree);
  j.operation.says("done");
  const SessionRecord record = j.finished();
  EXPECT_EQ(record.rods[0].given_up, 1U);
  EXPECT_TRUE(record.rods[0].measured.empty());
  JournaledRod kept;
  kept.measures_next_bend();
  kept.measures_next_bend(30.0 * kRadiansPerDegree);
  kept.operation.says("delete");
  EXPECT_EQ(kept.finished("cable").rods[0].given_up, 0U);
}

TEST(JournalOfARod, ForgetsMeasuredBendsWithTheMap) {
  JournaledRod j;
  j.measures_next_bend();
  ++j.operation.map_epoch;
  j.operation.pair();
  EXPECT_TRUE(j.finished("cable").rods[0].measured.empty());
}

}  // namespace
}  // namespace orthonav::engine::journal_reader_test
