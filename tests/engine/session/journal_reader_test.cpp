#include "engine/session/journal_reader.h"

#include <gmock/gmock.h>

#include "engine/session/journal.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::journal_reader_test {
namespace {

using orthonav::test::content_of;
using orthonav::test::TemporaryFolder;
using orthonav::test::wait_until;
using ::testing::HasSubstr;
using ::testing::Not;

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

  TemporaryFolder folder;
  std::string path = folder.file("session.orthonav");
  test::ScriptedOperation operation;
  std::unique_ptr<Journal> journal;
};

/// Compares every figure that the session itself has about its levels and rods.
void expect_the_same(const SessionRecord& record, const Session& session) {
  ASSERT_EQ(record.levels.size(), session.levels().size());
  for (std::size_t i = 0; i < record.levels.size(); ++i) {
    const RecordedLevel& read = record.levels[i];
    const LevelState& level = session.levels()[i];
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
      EXPECT_EQ(read.screws[s].done, level.screw_done[s]);
    }
  }
  for (const RecordedRod& rod : record.rods) {
    const RodState& state = session.rods()[rod.side == Side::kLeft ? 0 : 1];
    ASSERT_EQ(state.side, rod.side);
    EXPECT_EQ(rod.heads, state.heads.size());
    EXPECT_EQ(rod.done, state.done);
    if (rod.done) {
      EXPECT_DOUBLE_EQ(rod.length_m.value_or(-1), state.rod->length_m);
      EXPECT_EQ(rod.bends.size(), state.rod->bends.size());
      ASSERT_EQ(rod.cut_length_m.has_value(), state.instructions.has_value());
      EXPECT_EQ(rod.no_instructions, state.no_instructions);
      EXPECT_NE(rod.cut_length_m.has_value(), !rod.no_instructions.empty());
      if (state.instructions) {
        EXPECT_DOUBLE_EQ(*rod.cut_length_m, state.instructions->cut_length_m());
        EXPECT_EQ(rod.instructions.size(), state.instructions->bends.size());
      }
    }
  }
}

TEST(JournalReader, TellsTheWholeOperationAsTheSessionHasIt) {
  Journaled j({"L4", "L5"});
  j.operation.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
  j.operation.finishes_every_screw();
  j.operation.touches({0.02, 0.03, 0.00});
  j.operation.touches({0.02, 0.03, 0.04});
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
  EXPECT_EQ(record.rods.size(), 2U);
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
  EXPECT_THAT(course, ::testing::ElementsAre(kDigitize, kVerify, kAccepted, kGuide, kDigitize,
                                             kVerify, kAccepted, kGuide, kRod));
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

TEST(JournalReader, KnowsWhereTheToolWentAndNamesWhatWasNotMeasured) {
  Journaled j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  s.touches_dimple();
  s.says("next");
  for (const double depth_m : {0.0, 0.005, 0.010, 0.010, 0.010}) {
    s.tracker().guide = test::guide_at({0.0153, 0.020 - depth_m, 0.0}, 0.01);
    s.pair();
  }
  s.says("next");
  s.says("next");
  s.tracker().guide.reset();
  s.touches_dimple();
  s.says("next");
  s.says("next");
  s.says("next");
  const LevelState& level = s.session().levels()[0];
  ASSERT_TRUE(level.executed[0]);
  ASSERT_FALSE(level.executed[1]);
  const SessionRecord record = j.finished("");
  const RecordedScrew& left = record.levels.at(0).screws.at(0);
  ASSERT_TRUE(left.executed);
  EXPECT_EQ(left.executed->pairs, level.executed[0]->pairs);
  EXPECT_NEAR((left.executed->axis.point - level.executed[0]->axis.point).norm(), 0.0, 1e-12);
  EXPECT_NEAR(left.executed->axis.direction.dot(level.executed[0]->axis.direction), 1.0, 1e-12);
  EXPECT_NEAR(left.executed->depth_m, 0.010, 1e-3);
  EXPECT_EQ(left.executed->point_covariance_m2.has_value(),
            level.executed[0]->point_covariance_m2.has_value());
  ASSERT_TRUE(left.at_depth);
  EXPECT_EQ(left.at_depth->grade, "A");
  EXPECT_EQ(left.at_depth->grade_probability.has_value(),
            level.clearance_at_depth[0]->spread.has_value());
  const RecordedScrew& right = record.levels[0].screws.at(1);
  EXPECT_FALSE(right.executed);
  EXPECT_THAT(right.not_measured, ::testing::IsSupersetOf({"executed", "clearance"}));
  ASSERT_TRUE(record.calibration);
  EXPECT_TRUE(record.calibration->tags.empty()) << "nothing tells of it here";
  EXPECT_FALSE(record.calibration->cameras);
}

TEST(JournalReader, KnowsWhatTagsAndCamerasInUseHaveTold) {
  Journaled j({"L4"});
  test::ScriptedOperation& s = j.operation;
  s.tracker().size = nav::TagSize{0.004, 0.001, 40, false, false, 0.003};
  s.accepts_first_level();
  s.says("next");
  s.says("next");
  const SessionRecord record = j.finished("");
  ASSERT_TRUE(record.calibration);
  ASSERT_EQ(record.calibration->tags.size(), 2U);
  EXPECT_EQ(record.calibration->tags[1].tool, "guide");
  EXPECT_NEAR(record.calibration->tags[1].measured, 0.004, 1e-12);
  EXPECT_NEAR(record.calibration->tags[1].sd, 0.001, 1e-12);
  EXPECT_NEAR(record.calibration->tags[1].applied, 0.003, 1e-12);
  EXPECT_FALSE(record.calibration->cameras);
}

TEST(JournalReader, KnowsHowEveryWireWasMeasuredKeptOrRedone) {
  using enum ClickerAction;
  Journaled j({"L4"}, Verification::kByTouch);
  test::ScriptedOperation& s = j.operation;
  s.registers_within(0.0003);
  s.accepts_first_by_touch();
  const auto measure = [&s](double beside_m, double angle_rad) {
    s.tracker().guide = test::guide_at(Vec3{0.015 + beside_m, 0.020, 0.0}, angle_rad);
    s.does({kPress});
    s.pair();
    s.does({kRelease, kClick});
  };
  const auto drill = [&s] {
    s.touches_dimple();
    s.says("next");
    s.says("next");
  };
  drill();
  measure(0.0025, 0.0);
  s.says("delete");
  drill();
  measure(0.0, 0.3);
  s.says("accept");
  s.says("next");
  drill();
  s.says("next");
  const SessionRecord record = j.finished("");
  ASSERT_EQ(record.levels.at(0).screws.size(), 2U);
  const RecordedScrew& left = record.levels[0].screws[0];
  EXPECT_TRUE(left.done && left.wire_asked);
  EXPECT_EQ(left.redone, 1);
  ASSERT_TRUE(left.wire);
  const PlacedWire& wire = *s.session().levels()[0].wires[0].measured;
  EXPECT_NEAR(left.wire->angle_rad, wire.axis.angle_rad.value, 1e-9);
  EXPECT_NEAR(left.wire->angle_sd_rad, wire.axis.angle_rad.sd, 1e-9);
  EXPECT_NEAR(left.wire->entry_m, wire.axis.entry_m.value, 1e-9);
  EXPECT_NEAR(left.wire->entry_sd_m, wire.axis.entry_m.sd, 1e-9);
  EXPECT_TRUE(left.wire->kept && !left.wire->within);
  const RecordedScrew& right = record.levels[0].screws[1];
  EXPECT_TRUE(right.done && right.wire_asked);
  EXPECT_FALSE(right.wire) << "not measured";
  EXPECT_EQ(right.redone, 0);
}

TEST(JournalReader, KnowsWhatWasPlannedInSurgery) {
  Journaled j({"L4"});
  j.operation.accepts_first_level();
  j.operation.says("next");
  j.operation.says("move cranial one");
  j.operation.says("shorter");
  j.operation.says("undo");
  j.operation.says("next");
  j.operation.says("move medial two");
  j.operation.says("undo");
  j.operation.says("next");
  const SessionRecord record = j.finished("");
  const auto& screws = record.levels[0].screws;
  ASSERT_EQ(screws.size(), 2u);
  EXPECT_TRUE(screws[0].done) << "what was done later left the plan alone";
  ASSERT_TRUE(screws[0].planned_in_surgery);
  const LevelState& level = j.operation.session().levels()[0];
  const auto difference = nav::difference_of(level.preoperative[0], level.plan.screws[0]);
  EXPECT_NEAR(screws[0].planned_in_surgery->entry_cranial_m, 0.001, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->length_to_m, difference.length_to_m, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->length_from_m, 0.035, 1e-9);
  EXPECT_NEAR(screws[0].planned_in_surgery->diameter_to_m, 0.006, 1e-9);
  EXPECT_FALSE(screws[1].planned_in_surgery) << "as before surgery again";
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

/// The first of the three lines of a short journal.
std::string header() {
  return R"({"format":"orthonav session","format_version":1,"orthonav":"0.1.0","device":"d",)"
         R"("method":"best","case":"c","seed":1})"
         "\n";
}
std::string started() {
  return R"({"time_100ns":1,"time_ns":100000000000,"what":"event","step":"setup",)"
         R"("event":"\"start\"","action":"begin level","next":"digitize"})"
         "\n";
}
std::string registered() {
  return R"({"time_100ns":1,"time_ns":101000000000,"what":"registration","level":"L4","attempt":1,)"
         R"("accepted":true,"points":100,"rmse_mm":1.5,"predicted_tre_mm":null})"
         "\n";
}

TEST(JournalReader, LeavesOutALineThatWasTorn) {
  const std::string whole = header() + started() + registered();
  for (std::size_t length = header().size(); length < whole.size(); ++length) {
    const auto read = read_journal_text(whole.substr(0, length), "cut");
    ASSERT_TRUE(read.ok()) << length << ": " << read.error().message;
    EXPECT_TRUE(read->cut);
    const std::size_t behind_start = header().size() + started().size();
    // A line counts if it is complete, with or without its newline.
    EXPECT_EQ(read->steps.size(), length + 1 >= behind_start ? 1U : 0U) << length;
    EXPECT_EQ(read->registrations.size(), length + 1 == whole.size() ? 1U : 0U) << length;
    const bool between = length == header().size() || length + 1 == behind_start ||
                         length == behind_start || length + 1 == whole.size();
    EXPECT_EQ(read->last_line_torn, !between) << length;
  }
  const auto zeros = read_journal_text(header() + started() + std::string(100, '\0'), "cut");
  ASSERT_TRUE(zeros.ok()) << zeros.error().message;
  EXPECT_TRUE(zeros->last_line_torn);
  EXPECT_EQ(zeros->lines, 2U);
}

TEST(JournalReader, DoesNotInventWhatIsNotThere) {
  const auto read = read_journal_text(header() + started() + registered(), "j");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_FALSE(read->has_plan);
  EXPECT_FALSE(read->registrations[0].predicted_tre_m) << "null: without a bound";
  EXPECT_FALSE(read->registrations[0].tre_95_m);
  EXPECT_FALSE(read->levels[0].digitization_s) << "no press was recorded";
  EXPECT_TRUE(read->levels[0].screws.empty());
}

struct Hostile {
  const char* name;
  std::string content;
  const char* refusal;
};
void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

std::string line_with(const std::string& what) {
  return header() + R"({"time_ns":100000000000,"what":)" + what + "}\n" + started();
}

class HostileJournal : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileJournal, IsRefusedInOneLineThatNamesFileAndLine) {
  const auto read = read_journal_text(GetParam().content, "bad");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr(GetParam().refusal));
  EXPECT_THAT(read.error().message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    Every, HostileJournal,
    ::testing::Values(
        Hostile{"Empty", "", "bad: is empty"}, Hostile{"Zeros", std::string(9, '\0'), "is empty"},
        Hostile{"Binary", "\x89PNG\r\n\x1a\n", "bad:1: is not JSON"},
        Hostile{"TornHeader", header().substr(0, 40), "bad:1: is not JSON"},
        Hostile{"AnotherFormat", "{\"format\":\"x\"}\n",
                "bad:1: format is no \"orthonav session\""},
        Hostile{"ALaterVersion", R"({"format":"orthonav session","format_version":2})",
                "bad:1: format_version is 2, known is 1"},
        Hostile{"NoJson", line_with("\"ended\"").insert(header().size(), "x"),
                "bad:2: is not JSON"},
        Hostile{"AList", header() + "[]\n" + started(), "bad:2: must hold a JSON object"},
        Hostile{"TwoHeaders", header() + header(), "bad:2: time_ns is missing"},
        Hostile{"UnknownWord", line_with("\"dance\""), "bad:2: what \"dance\" is unknown"},
        Hostile{"NoWord", line_with("7"), "bad:2: what must be text, is number"},
        Hostile{
            "UnknownStep",
            line_with(R"("event","step":"fly","event":"press","action":"ignore","next":"done")"),
            "bad:2: step \"fly\" is unknown"},
        Hostile{"WrongType", line_with(R"("registration","level":"L4","attempt":"two")"),
                "bad:2: attempt must be a number, is string"},
        Hostile{"Infinite", line_with(R"("registration","level":"L4","attempt":1,"rmse_mm":1e999)"),
                "bad:2: holds a number that is too large"},
        Hostile{"NotANumber", line_with(R"("registration","level":"L4","attempt":1,"rmse_mm":NaN)"),
                "bad:2: is not JSON"},
        Hostile{"NegativeCount", line_with(R"("rod","side":"left","heads":-1)"),
                "bad:2: heads is negative"},
        Hostile{"NoSide", line_with(R"("head","side":"up")"), "bad:2: side is \"up\""},
        Hostile{"NothingToAccept", line_with(R"("accepted","level":"L4")"),
                "bad:2: level has no registration that could be accepted"},
        Hostile{"NothingToDrop", line_with(R"("check point dropped","level":"L4")"),
                "bad:2: level has no check point"},
        Hostile{"LongLine", header() + std::string(2'000'000, ' ') + "{}\n" + started(),
                "bad:2: 2000002 bytes long, limit 1048576"},
        Hostile{"TimeGoesBack",
                header() + started() + "{\"time_ns\":39000000000,\"what\":\"ended\"}\n",
                "bad:3: time_ns goes back by 61.0 s, limit 60 s"},
        Hostile{"NoTime", header() + "{\"time_ns\":1e300,\"what\":\"ended\"}\n",
                "bad:2: time_ns is no time"},
        Hostile{"AfterTheEnd", line_with("\"ended\""), "bad:3: stands after the end"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(JournalReader, TakesNoMoreLevelsThanASpineCanHave) {
  std::string many = header();
  for (int i = 0; i < 101; ++i) {
    many += R"({"time_ns":1,"what":"screw","side":"left","level":")" + std::to_string(i) + "\"}\n";
  }
  const auto read = read_journal_text(many, "bad");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("bad:102: level is the 101st, limit 100"));
}

}  // namespace
}  // namespace orthonav::engine::journal_reader_test
