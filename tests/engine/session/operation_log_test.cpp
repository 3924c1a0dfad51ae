#include "engine/session/log/operation_log.h"

#include <gmock/gmock.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/session/text/wording.h"
#include "tests/support/allocation_count.h"
#include "tests/support/is_ok.h"
#include "tests/support/logged_operation.h"
#include "tests/support/memory_env.h"
#include "tests/support/said.h"
#include "tests/support/scripted_surgeon.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::operation_log_test {
namespace {

using test::is_ok;
using test::kLogFolder;
using test::kLogPath;
using test::log_of;
using test::MemoryEnv;
using test::ScriptedOperation;
using test::ScriptedSurgeon;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<Record> records_in(MemoryEnv& env) { return read_log(env, kLogPath)->records; }

LoggedOperation recorded_in(MemoryEnv& env) {
  return LoggedOperation::from(records_in(env), kLogPath).value();
}

nlohmann::json last_of(MemoryEnv& env, OperationRecord type) {
  nlohmann::json found;
  for (const Record& record : records_in(env)) {
    if (record.type == static_cast<std::uint16_t>(type)) {
      found = nlohmann::json::parse(record.payload);
    }
  }
  return found;
}

ScriptedOperation by_touch() { return ScriptedOperation({"L4"}, {}, Verification::kByTouch); }

TEST(OperationLog, TellsAWholeOperation) {
  MemoryEnv env;
  ScriptedOperation s({"L4", "L5"}, {}, Verification::kByTouch);
  s.registers_within(0.0003);
  auto log = log_of(s, env);
  ScriptedSurgeon(s).finish();
  ASSERT_EQ(s.session().current_step(), Step::kDone);
  ASSERT_TRUE(is_ok(log->finish(true, "")));
  const LoggedOperation told = recorded_in(env);
  EXPECT_TRUE(told.done);
  ASSERT_EQ(told.state.levels.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const LevelState& level = s.session().levels()[i];
    const LevelState& recorded = told.state.levels[i];
    EXPECT_EQ(recorded.plan.label, level.plan.label);
    EXPECT_EQ(recorded.attempts, 1);
    EXPECT_TRUE(recorded.accepted);
    EXPECT_EQ(recorded.registration->world_from_vertebra, level.registration->world_from_vertebra);
    EXPECT_EQ(recorded.landmark->in_vertebra, level.landmark->in_vertebra);
    EXPECT_EQ(told.strokes[i].size(), 2u);
    ASSERT_TRUE(recorded.newest) << "its points are those of the strokes";
    EXPECT_EQ(recorded.newest->points, level.newest->points);
    ASSERT_EQ(recorded.check_points.size(), level.check_points.size());
    for (std::size_t point = 0; point < level.check_points.size(); ++point) {
      EXPECT_EQ(recorded.check_points[point].place, level.check_points[point].place);
    }
    ASSERT_EQ(recorded.screws.size(), level.plan.screws.size());
    for (std::size_t screw = 0; screw < recorded.screws.size(); ++screw) {
      const ScrewState& is = recorded.screws[screw];
      const ScrewState& was = level.screws[screw];
      EXPECT_TRUE(is.done);
      ASSERT_EQ(is.executed.has_value(), was.executed.has_value());
      ASSERT_TRUE(is.executed);
      EXPECT_EQ(is.executed->axis.point, was.executed->axis.point);
      EXPECT_EQ(is.executed->pairs, was.executed->pairs);
      ASSERT_TRUE(is.wire.measured);
      EXPECT_EQ(is.wire.measured->axis.angle_rad.value, was.wire.measured->axis.angle_rad.value);
    }
  }
  EXPECT_TRUE(told.state.rods[0].done && told.state.rods[1].done);
}

/// The records of a sort, in order.
std::vector<nlohmann::json> all_of(MemoryEnv& env, OperationRecord type) {
  std::vector<nlohmann::json> found;
  for (const Record& record : records_in(env)) {
    if (record.type == static_cast<std::uint16_t>(type)) {
      found.push_back(nlohmann::json::parse(record.payload));
    }
  }
  return found;
}

TEST(OperationLog, TellsEveryChangeOfAScrewAndItsUndoing) {
  MemoryEnv env;
  ScriptedOperation s({"L4"});
  auto log = log_of(s, env);
  s.accepts_first_level();
  s.says("next");
  s.says("move cranial one");
  s.says("move cranial");
  s.says("move cranial ten");
  s.says("tilt lateral two");
  s.says("undo");
  const auto plans = all_of(env, OperationRecord::kPlan);
  ASSERT_EQ(plans.size(), 3u) << "neither what was not understood nor what was refused";
  EXPECT_EQ(plans[0]["label"], "L4");
  EXPECT_EQ(plans[0]["why"], "move cranial 1.0 mm");
  EXPECT_EQ(plans[0]["screws"][0]["side"], "left");
  EXPECT_NEAR(plans[0]["screws"][0]["earlier"][0]["entry_m"][2].get<double>(), 0.0, 1e-12);
  EXPECT_NEAR(plans[0]["screws"][0]["entry_m"][2].get<double>(), 0.001, 1e-12);
  EXPECT_NEAR(plans[0]["screws"][0]["target_m"][2].get<double>(), 0.001, 1e-12);
  EXPECT_EQ(plans[1]["screws"][0]["earlier"].size(), 2u);
  EXPECT_EQ(plans[2]["why"], "undo");
  EXPECT_EQ(plans[2]["screws"], plans[0]["screws"]);
}

TEST(OperationLog, TellsWhoAskedFromOutsideBeforeWhatCameOfItAndWhatWasNotUnderstood) {
  MemoryEnv env;
  ScriptedOperation s({"L4"});
  auto log = log_of(s, env);
  s.asks({"start", "10.0.0.7", {}, {}});
  s.says("mumble");
  const std::vector<Record> records = records_in(env);
  ASSERT_EQ(records.size(), 4u);
  const auto asked = nlohmann::json::parse(records[1].payload);
  EXPECT_EQ(name_of(static_cast<OperationRecord>(records[1].type)), "asked from outside");
  EXPECT_EQ(asked["from"], "10.0.0.7");
  EXPECT_EQ(asked["asked"], "start");
  EXPECT_EQ(last_of(env, OperationRecord::kEvent)["event"], "\"start\"");
  EXPECT_EQ(last_of(env, OperationRecord::kNotUnderstood)["phrase"], "mumble");
}

TEST(OperationLog, TellsWhenAndWhyTheOperationEnded) {
  MemoryEnv env;
  ScriptedOperation s({"L5"});
  auto log = log_of(s, env);
  s.says("start");
  ASSERT_TRUE(is_ok(log->finish(false, "cable", Timestamp(std::chrono::seconds(900)))));
  const LoggedOperation told = recorded_in(env);
  EXPECT_TRUE(told.ended);
  EXPECT_EQ(told.reason, "cable");
  EXPECT_EQ(told.last_time, Timestamp(std::chrono::seconds(900))) << "of the last pair";
}

TEST(OperationLog, GivesNoNumbersOfARegistrationThatThereIsNot) {
  MemoryEnv env;
  ScriptedOperation s({"L5"});
  auto log = log_of(s, env);
  s.unusable = "0 points, at least 100 needed";
  s.says("start");
  s.does({ClickerAction::kDoubleClick});
  s.unusable.reset();
  s.does({ClickerAction::kDoubleClick});
  const LoggedOperation told = recorded_in(env);
  ASSERT_EQ(told.registrations.size(), 2u);
  EXPECT_EQ(told.registrations[0].reason, "0 points, at least 100 needed");
  EXPECT_FALSE(told.registrations[0].passed || told.registrations[0].result);
  EXPECT_TRUE(told.registrations[1].passed && told.registrations[1].result);
}

TEST(OperationLog, TellsWhatIsSaidOfARegistrationAndThePlacesTouchedToCheckIt) {
  MemoryEnv env;
  ScriptedOperation s({"L5"}, {}, Verification::kByTouch);
  auto log = log_of(s, env);
  s.tracker().size = nav::TagSize{-0.032, 0.001, 12, true, true};
  s.registration.log_likelihood_ratio = std::numeric_limits<double>::infinity();
  s.registration.tre_95_m = 0.0014;
  s.registration.weakest = {nav::UncertainMotion::Kind::kFlexion, 0.0012};
  s.registration.stroke_next = {nav::BonePlace::Part::kLamina, Side::kLeft,
                                nav::BonePlace::Height::kUpper};
  s.registration.fits_better = "L4";
  s.registers_first_level();
  s.touches({0.0, 0.0213, 0.0});
  s.touches({0.02, 0.0251, 0.0});
  s.says("delete");
  const nlohmann::json registration = last_of(env, OperationRecord::kRegistration);
  EXPECT_FALSE(registration["registration"].contains("log_likelihood_ratio")) << "no rival at all";
  EXPECT_EQ(registration["weakest"], "flexion/extension (1.2 mm at the screws)");
  EXPECT_EQ(registration["advice"], "digitize the left upper lamina");
  EXPECT_EQ(registration["fits_better"], "L4");
  const LoggedOperation told = recorded_in(env);
  EXPECT_DOUBLE_EQ(told.registrations.at(0).result->tre_95_m, 0.0014);
  EXPECT_TRUE(std::isinf(told.registrations[0].result->log_likelihood_ratio));
  ASSERT_TRUE(told.registrations[0].tag_size);
  EXPECT_EQ(told.registrations[0].tag_size->tool, "pointer");
  EXPECT_DOUBLE_EQ(told.registrations[0].tag_size->fraction, -0.032);
  const auto checks = all_of(env, OperationRecord::kCheckPoint);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_NEAR(checks[0]["distance_m"].get<double>(), 0.0013, 1e-9);
  EXPECT_EQ(checks[0]["within"], true);
  EXPECT_EQ(checks[1]["within"], false);
  EXPECT_NEAR(checks[1]["in_world_m"][1].get<double>(), 0.0251, 1e-9);
  EXPECT_EQ(all_of(env, OperationRecord::kCheckPointDropped).size(), 1u);
}

TEST(OperationLog, HoldsEveryNumberToTheBit) {
  nav::Registration r;
  r.world_from_vertebra = {rotation_from_vector({0.1, 1.0 / 3.0, -0.7}), {1e-300, -0.0, 1.0 / 7.0}};
  r.rmse_m = 0.1 + 0.2;
  r.predicted_tre_m = std::numeric_limits<double>::infinity();
  std::array<double, 36> covariance{};
  for (std::size_t i = 0; i < 36; ++i) {
    covariance[i] = std::sin(static_cast<double>(i)) * 1e-7;
  }
  r.uncertainty = nav::PoseUncertainty({1.0 / 9.0, 2, 3}, covariance);
  r.heights = {{{{0.1, 0.2, 0.3}}, 1e-5 / 3.0}};
  const auto document = JsonDocument::parse(json_of(r).dump(), "r").value();
  const nav::Registration read = registration_from(document.root());
  ASSERT_TRUE(is_ok(document.status()));
  EXPECT_EQ(read.world_from_vertebra, r.world_from_vertebra);
  EXPECT_TRUE(std::signbit(read.world_from_vertebra.translation().y));
  EXPECT_EQ(read.rmse_m, r.rmse_m);
  EXPECT_EQ(read.predicted_tre_m, r.predicted_tre_m);
  EXPECT_EQ(read.uncertainty->covariance(), covariance);
  EXPECT_EQ(read.uncertainty->centre_m(), r.uncertainty->centre_m());
  EXPECT_EQ(read.heights[0].height_m, r.heights[0].height_m);
}

TEST(OperationLog, SaysSavedOnlyOnceItIs) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  auto log = log_of(s, env);
  s.tracker().pointer = test::pointer_at({0, 0.02, 0});
  EXPECT_EQ(s.says("start").status.saved, Saved::kNothingNew);
  s.strokes(5);
  const std::size_t before = env.calls().size();
  EXPECT_EQ(s.says("save").status.saved, Saved::kSaved);
  ASSERT_EQ(env.calls().size(), before + 4) << "one write and one sync of event and region";
  EXPECT_EQ(env.calls().back().what, test::EnvCall::What::kSync);
  EXPECT_EQ(s.pairs(90).status.saved, Saved::kNothingNew) << "two seconds later";
}

/// A disk whose syncs block while `held` is locked.
class HeldEnv : public MemoryEnv {
 public:
  Result<std::unique_ptr<AppendFile>> open_append(const std::string& path) override {
    auto file = MemoryEnv::open_append(path);
    return std::unique_ptr<AppendFile>(std::make_unique<HeldFile>(std::move(*file), held));
  }
  Mutex held;

 private:
  class HeldFile : public AppendFile {
   public:
    HeldFile(std::unique_ptr<AppendFile> file, Mutex& held) : file_(std::move(file)), held_(held) {}
    Status append(std::string_view bytes) override { return file_->append(bytes); }
    Status sync() override {
      const MutexLock lock(held_);
      return file_->sync();
    }

   private:
    std::unique_ptr<AppendFile> file_;
    Mutex& held_;
  };
};

TEST(OperationLog, WaitsForNoDiskAndSaysNothingMeanwhile) {
  HeldEnv env;
  ScriptedOperation s = by_touch();
  auto log = OperationLog::begin(env, kLogFolder, test::identity_of(s), s.session().levels(),
                                 RecordWriter::Waits::kNot, RecordLog::Earlier::kKept)
                 .value();
  s.session().observe(log.get());
  s.session().show_saving(log.get());
  s.tracker().pointer = test::pointer_at({0, 0.02, 0});
  s.says("start");
  s.strokes(5);
  {
    const MutexLock lock(env.held);
    EXPECT_EQ(s.says("save").status.saved, Saved::kNothingNew);
    EXPECT_EQ(s.pairs(10).status.saved, Saved::kNothingNew);
  }
  EXPECT_TRUE(test::wait_until(
      [&] { return log->saved(s.now(), std::chrono::seconds(2)) == Saved::kSaved; }));
  EXPECT_EQ(s.pair().status.saved, Saved::kSaved);
}

TEST(OperationLog, SaysNotSavedFromThenOnAndTheOperationGoesOn) {
  for (const int problem : {ENOSPC, EIO, EROFS}) {
    for (const std::size_t call : {0u, 1u, 8u, 21u}) {
      MemoryEnv env;
      ScriptedOperation s = by_touch();
      auto log = log_of(s, env);
      env.fail_at(env.calls().size() + call, problem, false);
      ScriptedSurgeon surgeon(s);
      while (log->saved(s.now(), std::chrono::seconds(2)) != Saved::kNotSaved) {
        ASSERT_TRUE(surgeon.act());
      }
      const auto saved = records_in(env).size();
      EXPECT_THAT(detail_text(s.pair().status), EndsWith("NOT SAVED"));
      surgeon.finish();
      EXPECT_EQ(s.session().current_step(), Step::kDone);
      EXPECT_THAT(detail_text(s.pair().status), EndsWith("NOT SAVED"));
      EXPECT_EQ(records_in(env).size(), saved) << "nothing after the first failure";
      const Status end = log->finish(true, "");
      ASSERT_FALSE(end.ok());
      EXPECT_THAT(end.error().message, HasSubstr("out/operation.resume: cannot be written"));
    }
  }
  RecordProperty("faults", 3 * 4);
}

TEST(OperationLog, HoldsWhatWasShownWhenARegistrationWasAccepted) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  auto log = log_of(s, env);
  s.registers_first_level();
  s.checks_by_touch();
  s.accepts();
  const nlohmann::json accepted = last_of(env, OperationRecord::kAccepted);
  EXPECT_THAT(accepted["shown"].get<std::string>(), HasSubstr("verify L4 | "));
  EXPECT_THAT(accepted["shown"].get<std::string>(), HasSubstr("passed: say accept result"));
  EXPECT_EQ(accepted["check_points"], 3);
}

TEST(OperationLog, HoldsAnOverrideWithItsReason) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  s.registers_within(0.0003);
  auto log = log_of(s, env);
  s.accepts_first_by_touch();
  s.touches_landmark();
  s.says("next");
  s.says("next");
  s.tracker().guide = test::guide_at({0.015 + 0.004, 0.024, 0.0}, 0.0);
  s.does({ClickerAction::kPress});
  s.pair();
  s.does({ClickerAction::kRelease, ClickerAction::kClick});
  EXPECT_FALSE(last_of(env, OperationRecord::kWire)["within"]);
  s.says("accept");
  const nlohmann::json kept = last_of(env, OperationRecord::kWire);
  EXPECT_TRUE(kept["wire"]["kept"]);
  EXPECT_GT(kept["wire"]["entry_m"][0], kept["wire"]["entry_limit_m"]);
}

TEST(OperationLog, HoldsABreachOfTheCortexWithItsReason) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  s.registers_within(0.0004);
  auto log = log_of(s, env);
  s.accepts_first_by_touch();
  s.says("move lateral nine");
  EXPECT_EQ(last_of(env, OperationRecord::kPlan)["screws"][0]["accepted_breach"], "")
      << "still in the bone";
  s.says("tilt lateral nine");
  s.pair();
  EXPECT_EQ(all_of(env, OperationRecord::kPlan).size(), 1u) << "asked, not taken yet";
  s.says("accept");
  const nlohmann::json plan = last_of(env, OperationRecord::kPlan);
  EXPECT_EQ(plan["label"], "L4");
  EXPECT_EQ(plan["why"], "tilt lateral 9.0\u00b0");
  EXPECT_EQ(plan["screws"][0]["accepted_breach"], "accepted in surgery");
  EXPECT_EQ(plan["screws"][0]["earlier"].size(), 2u);
  EXPECT_EQ(plan["screws"][1]["accepted_breach"], "") << "of that screw alone";
  const nav::ScrewPlan& screw = s.session().levels()[0].plan.screws[0];
  const LoggedOperation told = recorded_in(env);
  const nav::ScrewPlan& again = told.state.levels[0].plan.screws[0];
  EXPECT_EQ(again.accepted_breach, "accepted in surgery");
  EXPECT_EQ(again.target, screw.target);
}

TEST(OperationLog, IsOneProcessAlone) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  auto log = log_of(s, env);
  const auto second = OperationLog::find(env, kLogFolder);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.error().message, "out: is in use by another operation");
}

TEST(OperationLog, GoesAgainWhereNothingHappened) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  log_of(s, env).reset();
  EXPECT_TRUE(env.files().empty());
}

TEST(OperationLog, AllocatesNothingInAStepWhereNothingHappens) {
  MemoryEnv env;
  ScriptedOperation s = by_touch();
  auto log = log_of(s, env);
  s.registers_first_level();
  s.pairs(100);
  const std::size_t before = test::allocation_count();
  s.pairs(100);
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace orthonav::engine::operation_log_test
