#include "engine/session/journal_reader.h"

#include <gmock/gmock.h>

#include "tests/engine/session/journaled_operation.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::journal_reader_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::wait_until;

TEST(JournalReader, TellsTheWholeOperationAsTheSessionHasIt) {
  Journaled j({"L4", "L5"});
  j.operation.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
  j.operation.finishes_every_screw();
  j.operation.touches({0.02, 0.03, 0.00});
  j.operation.touches({0.02, 0.03, 0.04});
  // The second head twice more, of which one touch is taken back: still two heads.
  j.operation.touches({0.0204, 0.03, 0.04});
  j.operation.touches({0.0201, 0.03, 0.04});
  j.operation.says("delete");
  j.operation.says("mumble");
  j.operation.says("done");
  j.operation.touches({-0.02, 0.03, 0.00});
  const SessionRecord record = j.finished("cable");
  EXPECT_FALSE(record.cut);
  EXPECT_FALSE(record.completed());
  EXPECT_EQ(record.reason, "cable");
  EXPECT_TRUE(record.has_plan);
  EXPECT_EQ(record.seed, 18'446'744'073'709'551'615U);
  EXPECT_EQ(record.device, "fake");
  EXPECT_EQ(record.patient_reference, true);
  expect_the_same(record, j.operation.session());
  ASSERT_EQ(record.rods.size(), 2U);
  EXPECT_EQ(record.rods[0].heads, 2U);
  EXPECT_EQ(record.rods[0].touched.at(1).touches, 2U);
  EXPECT_EQ(record.registrations.size(), 2U);
  const auto& pose = record.levels[0].screws[0].at_depth;
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->angle_rad, 0.1, 1e-9);
  EXPECT_FALSE(record.levels[0].screws[0].wire_asked) << "by eye nobody is";
  std::vector<Step> course;
  for (const RecordedStep& step : record.steps) {
    course.push_back(step.step);
  }
  using enum Step;
  EXPECT_THAT(course,
              ::testing::ElementsAre(kDigitize, kRegistering, kVerify, kAccepted, kGuide, kDigitize,
                                     kRegistering, kVerify, kAccepted, kGuide, kRod));
}

TEST(JournalReader, KnowsWhatWasAcceptedAfterTouching) {
  Journaled j({"L4"}, Verification::kByTouch);
  std::array<double, 36> covariance{};
  for (const std::size_t k : {0U, 7U, 14U}) {
    covariance[k] = 0.25e-6;
  }
  j.operation.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  j.operation.registers_first_level();
  for (const Vec3 place : {Vec3{-0.015, 0.02, -0.01}, {0.015, 0.02, -0.01}, {0.0, 0.02, 0.012}}) {
    j.operation.touches(place);
  }
  j.operation.says("accept");
  const LevelState& level = j.operation.session().levels()[0];
  ASSERT_TRUE(level.accepted);
  const SessionRecord record = j.finished("");
  expect_the_same(record, j.operation.session());
  const RecordedRegistration& read = record.registrations.at(0);
  EXPECT_NEAR(read.predicted_tre_m.value_or(-1), nav::worst_m(level.predicted), 1e-12);
  EXPECT_NE(level.registration->uncertainty->covariance(), covariance) << "it holds the touches";
}

TEST(JournalReader, KnowsEveryTouchOfTheLandmarkAndWhatItTookBack) {
  Journaled j({"L4"}, Verification::kByTouch);
  j.operation.accepts_first_by_touch();
  j.operation.touches_dimple();
  j.operation.says("next");
  j.operation.says("next");
  j.operation.says("next");
  j.operation.touches_dimple(Vec3{0.0006, 0, 0});
  j.operation.says("delete");
  j.operation.touches_dimple(Vec3{0, 0, 0.0031});
  ASSERT_EQ(j.operation.pair().step, Step::kVerify);
  const SessionRecord record = j.finished("");
  expect_the_same(record, j.operation.session());
  EXPECT_FALSE(record.levels[0].accepted);
  EXPECT_TRUE(record.levels[0].registration) << "it is judged anew";
  EXPECT_TRUE(record.levels[0].checks.empty());
  const std::vector<RecordedLandmark>& touches = record.levels[0].landmark;
  ASSERT_EQ(touches.size(), 3U);
  EXPECT_TRUE(touches[0].first);
  EXPECT_NEAR(touches[1].off_m, 0.0006, 1e-9);
  EXPECT_TRUE(touches[1].within && touches[1].dropped);
  EXPECT_NEAR(touches[2].off_m, 0.0031, 1e-9);
  EXPECT_FALSE(touches[2].within || touches[2].dropped);
  EXPECT_NEAR(touches[2].limit_m, LandmarkRules{}.most_m, 1e-9);
}

TEST(JournalReader, FollowsRejectionsCheckPointsAndAMovedMap) {
  Journaled j({"L4", "L5"}, Verification::kByTouch);
  j.operation.registers_first_level();
  j.operation.touches({0.0, 0.0213, 0.0});
  j.operation.touches({0.02, 0.0251, 0.0});
  j.operation.says("delete");
  const auto so_far = [&j] {
    auto read = read_journal(j.path + ".part");
    EXPECT_TRUE(read.ok()) << read.error().message;
    return read.ok() ? *read : SessionRecord{};
  };
  // The journal is written by a thread of its own.
  const auto is_written = [&j](const char* what) {
    return wait_until([&] { return content_of(j.path + ".part").find(what) != std::string::npos; });
  };
  EXPECT_TRUE(is_written("check point dropped"));
  expect_the_same(so_far(), j.operation.session());
  EXPECT_TRUE(so_far().cut) << "as long as it is being written";
  EXPECT_EQ(so_far().levels[0].checks.size(), 1U);
  j.operation.says("reject");
  EXPECT_TRUE(wait_until([&] { return !so_far().levels[0].registration; }));
  expect_the_same(so_far(), j.operation.session());
  ++j.operation.map_epoch;
  j.operation.pairs(2);
  expect_the_same(j.finished("end"), j.operation.session());
}

}  // namespace
}  // namespace orthonav::engine::journal_reader_test
