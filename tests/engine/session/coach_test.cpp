#include "engine/session/coach.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <tuple>

#include "base/random.h"
#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "engine/session/text/wording.h"
#include "tests/engine/session/promising_registration.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine::coach_test {
namespace {

using ::testing::HasSubstr;

/// A registrar that answers only when allowed to, and counts its calls.
struct Gate {
  std::mutex mutex;
  std::condition_variable opened;
  bool open = true;
  std::atomic<int> at_the_gate = 0;
  std::atomic<int> asked = 0;
  std::atomic<std::size_t> points = 0;

  Registrar registrar() {
    return [this](const RegistrationRequest& request) -> Result<nav::Registration> {
      ++at_the_gate;
      std::unique_lock lock(mutex);
      opened.wait(lock, [this] { return open; });
      ++asked;
      points = request.points_in_world.size();
      nav::Registration r = promising();
      // Falls as samples arrive.
      r.predicted_tre_m = 0.1 / static_cast<double>(request.points_in_world.size());
      return r;
    };
  }
  void set_open(bool value) {
    const std::lock_guard lock(mutex);
    open = value;
    opened.notify_all();
  }
};

class CoachTest : public ::testing::Test {
 protected:
  CoachTest() : coach(gate.registrar()) {}
  void stroke(std::size_t samples) {
    for (std::size_t i = 0; i < samples; ++i) {
      regions.back().samples.push_back({Point<World>{{0.001, 0.0, 0.0}}, {}});
    }
  }
  void pairs(int n) {
    for (int i = 0; i < n; ++i) {
      coach.step(operation.levels[0], regions);
    }
  }
  Operation operation = test::operation_of({"L4"});
  std::vector<nav::Region> regions = std::vector<nav::Region>(1);
  Gate gate;
  Coach coach;
};

TEST_F(CoachTest, SaysNothingBeforeThereAreEnoughSamples) {
  stroke(Coach::kFewestSamples - 1);
  pairs(100);
  EXPECT_EQ(gate.asked, 0);
  EXPECT_FALSE(coach.newest().has_value());
}

TEST_F(CoachTest, AnswersExactlySoManyPairsLaterHoweverFastTheTrialIs) {
  stroke(200);
  pairs(1 + Coach::kPairsToAnswer - 1);
  EXPECT_FALSE(coach.newest().has_value()) << "even though it is long done";
  pairs(1);
  ASSERT_TRUE(coach.newest().has_value());
  EXPECT_DOUBLE_EQ(coach.newest()->expected_m, 0.1 / 200.0);
}

TEST_F(CoachTest, DoesNotHoldUpThePairsBetween) {
  gate.set_open(false);
  stroke(200);
  pairs(Coach::kPairsToAnswer);  // would hang here if a pair waited for the trial
  EXPECT_FALSE(coach.newest().has_value());
  gate.set_open(true);
  pairs(1);
  EXPECT_TRUE(coach.newest().has_value());
}

TEST_F(CoachTest, TriesTheSamplesAsTheyWereWhenItStarted) {
  stroke(200);
  pairs(1);
  stroke(30);
  pairs(Coach::kPairsToAnswer);
  EXPECT_EQ(gate.points, 200u);
}

TEST_F(CoachTest, TriesAgainAfterSoManyNewSamplesAndNotBefore) {
  stroke(200);
  pairs(1 + Coach::kPairsToAnswer);
  stroke(Coach::kNewSamples - 1);
  pairs(40);
  EXPECT_EQ(gate.asked, 1);
  stroke(1);
  pairs(1 + Coach::kPairsToAnswer);
  EXPECT_EQ(gate.asked, 2);
  EXPECT_LT(coach.newest()->expected_m, 0.1 / 200.0);
}

TEST_F(CoachTest, TriesAgainWhenStrokesAreDeleted) {
  stroke(200);
  pairs(1 + Coach::kPairsToAnswer);
  regions[0].samples.resize(150);
  pairs(1 + Coach::kPairsToAnswer);
  EXPECT_DOUBLE_EQ(coach.newest()->expected_m, 0.1 / 150.0);
  regions[0].samples.clear();
  pairs(1);
  EXPECT_FALSE(coach.newest().has_value()) << "told of strokes that are gone";
}

TEST_F(CoachTest, ForgetsATrialUnderWay) {
  stroke(200);
  pairs(3);
  coach.forget();
  regions[0].samples.clear();
  pairs(2 * Coach::kPairsToAnswer);
  EXPECT_FALSE(coach.newest().has_value());
}

TEST_F(CoachTest, EndsWithATrialUnderWay) {
  gate.set_open(false);
  auto other = std::make_unique<Coach>(gate.registrar());
  stroke(200);
  other->step(operation.levels[0], regions);
  ASSERT_TRUE(test::wait_until([&] { return gate.at_the_gate == 1; }));
  gate.set_open(true);
  other.reset();
  EXPECT_EQ(gate.asked, 1);
}

/// Opens the gate once the session waits for the coach.
class OpensWhenAwaited : public WorkWatch {
 public:
  explicit OpensWhenAwaited(Gate& gate) : gate_(gate) {}
  void begins(Part part) override {
    told.push_back(part);
    gate_.set_open(true);
  }
  void ends(Part part) override { told.push_back(part); }
  void begins_beside(Part) override { ++trials; }
  void ends_beside(Part) override { --trials; }
  std::vector<Part> told;
  int trials = 0;  ///< under way

 private:
  Gate& gate_;
};

TEST_F(CoachTest, TellsOfItsTrialsAndThatItIsAwaited) {
  OpensWhenAwaited watch(gate);
  coach.watch(&watch);
  gate.set_open(false);
  stroke(200);
  pairs(Coach::kPairsToAnswer);
  EXPECT_TRUE(watch.told.empty()) << "nobody waits for it yet";
  EXPECT_EQ(watch.trials, 1);
  pairs(1);  // would hang here if the watch were not notified
  EXPECT_EQ(watch.told, std::vector<Part>(2, Part::kCoach));
  EXPECT_EQ(watch.trials, 0);
  EXPECT_TRUE(coach.newest().has_value());
}

TEST_F(CoachTest, WhereTimeRunsNoPairWaitsForATrial) {
  coach.look(false);
  gate.set_open(false);
  stroke(200);
  pairs(4 * Coach::kPairsToAnswer);  // would hang here if one waited
  EXPECT_FALSE(coach.newest().has_value());
  gate.set_open(true);
  ASSERT_TRUE(test::wait_until([&] {
    pairs(1);
    return coach.newest().has_value();
  }));
  EXPECT_DOUBLE_EQ(coach.newest()->expected_m, 0.1 / 200.0);
}

TEST_F(CoachTest, WhereTimeRunsAForgottenTrialIsNotWaitedForEither) {
  coach.look(false);
  gate.set_open(false);
  stroke(200);
  pairs(1);
  ASSERT_TRUE(test::wait_until([&] { return gate.at_the_gate == 1; }));
  coach.forget();  // would hang here
  stroke(100);
  pairs(4 * Coach::kPairsToAnswer);
  EXPECT_EQ(gate.at_the_gate, 1) << "the next begins once it has ended";
  gate.set_open(true);
  ASSERT_TRUE(test::wait_until([&] {
    pairs(1);
    return coach.newest().has_value();
  }));
  EXPECT_DOUBLE_EQ(coach.newest()->expected_m, 0.1 / 300.0) << "of the next, not the forgotten one";
}

TEST_F(CoachTest, ATrialThatDiesDoesSoWhereItIsAwaited) {
  Coach other(
      [](const RegistrationRequest&) -> Result<nav::Registration> { throw std::bad_alloc(); });
  stroke(200);
  for (int i = 0; i < Coach::kPairsToAnswer; ++i) {
    other.step(operation.levels[0], regions);
  }
  EXPECT_THROW(other.step(operation.levels[0], regions), std::bad_alloc);
}

/// The reachable side of the phantom's L4 from left to right, with noise of 0.3 mm.
std::vector<nav::Sample> sweep_of(const nav::VertebraModel& model, std::size_t count) {
  std::vector<Vec3> places = model.reachable().vertices_m;
  std::sort(places.begin(), places.end(),
            [](Vec3 a, Vec3 b) { return std::tuple(a.x, a.y, a.z) > std::tuple(b.x, b.y, b.z); });
  const Transform<World, Vertebra> pose{rotation_from_vector({0.4, -1.2, 0.3}), {0.3, -0.9, 0.5}};
  Random random(7);
  std::vector<nav::Sample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 noise{random.normal(), random.normal(), random.normal()};
    samples.push_back(
        {pose * Point<Vertebra>{places[i * places.size() / count] + 0.0003 * noise}, {}});
  }
  return samples;
}

TEST(CoachByBest, ExpectsLessAsSamplesComeInAndTheSameEveryTime) {
  const Operation operation = plan_operation(phantom({"L4"}), {"L4"}).value();
  const OperatedLevel& level = operation.levels[0];
  const std::vector<nav::Sample> sweep = sweep_of(*level.model, 500);
  std::vector<std::vector<double>> expected_m;
  std::vector<std::string> last;
  for (int run = 0; run < 2; ++run) {
    Coach coach(registrar_named("best").value());
    std::vector<nav::Region> regions(1);
    expected_m.emplace_back();
    for (const nav::Sample& sample : sweep) {
      regions[0].samples.push_back(sample);
      coach.step(level, regions);
      expected_m.back().push_back(coach.newest() ? coach.newest()->expected_m : -1.0);
    }
    ASSERT_TRUE(coach.newest().has_value());
    last.push_back(text_of(*coach.newest()));
  }
  EXPECT_EQ(expected_m[0], expected_m[1]) << "at the same pairs too";
  EXPECT_EQ(last[0], last[1]);
  const double early_m = expected_m[0][Coach::kFewestSamples + Coach::kPairsToAnswer];
  EXPECT_GT(early_m, 0.0);
  EXPECT_LT(expected_m[0].back(), 0.7 * early_m);
  EXPECT_THAT(last[0], HasSubstr("enough: double click"));
}

}  // namespace
}  // namespace orthonav::engine::coach_test
