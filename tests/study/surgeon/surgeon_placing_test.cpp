#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {
namespace {

/// The tolerance for a sleeve without play on a wire: only rounding and the simulation's step.
constexpr double kExact_m = 1e-6;
/// Tremor slides it along its own axis, a fraction of a degree off the wire's.
constexpr double kSliding_m = 3e-5;
constexpr double kExact_rad = 1e-5;

std::size_t count_of(const std::vector<Phrase>& phrases, const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      phrases.begin(), phrases.end(), [&](const Phrase& phrase) { return phrase.text == text; }));
}

/// An operation whose wires are measured.
struct Operated {
  explicit Operated(const EngineOptions& options, const ErrorModel& model = ErrorModel::perfect(),
                    std::uint64_t seed = 1)
      : headset(SimHeadset::open(test_case.room, without_pixels(seed, model)).value()),
        engine(*headset, test_case, options) {
    EXPECT_GT(engine.run(), 0);
  }
  TestCase test_case = synthetic_case();
  std::unique_ptr<SimHeadset> headset;
  FakeEngine engine;
};

EngineOptions looking() {
  EngineOptions options;
  options.wire = true;
  return options;
}

/// The angles between the sleeves and the wires that they were set over, and how far the wires'
/// lines pass the sleeves' tips.
std::vector<std::pair<double, double>> against_wires(const Operated& operated) {
  std::vector<std::pair<double, double>> found;
  for (const auto& [label, level] : operated.engine.levels()) {
    std::size_t next = 0;
    for (const DrivenWire& wire : operated.headset->truth().wires) {
      if (wire.level != label) {
        continue;
      }
      const auto& [tip, direction] = level.sleeves_in_vertebra.at(next++);
      found.emplace_back(angle_between_rad(direction, wire.direction),
                         (tip - wire.entry.v).cross(wire.direction).norm());
    }
  }
  return found;
}

TEST(PlacingSurgeon, SetsTheSleeveOverEveryWireAndClicks) {
  const Operated operated(looking());
  ASSERT_EQ(operated.engine.history().back(), "done");
  const auto found = against_wires(operated);
  ASSERT_EQ(found.size(), operated.test_case.screws.size());
  for (const auto& [angle_rad, off_m] : found) {
    EXPECT_LT(angle_rad, kExact_rad);
    EXPECT_LT(off_m, kExact_m);
  }
  EXPECT_EQ(count_of(operated.engine.phrases(), "delete last"), 0U);
}

TEST(PlacingSurgeon, TheSleeveHasItsPlayAndTheHandNoTremorInIt) {
  ErrorModel model = ErrorModel::perfect();
  model.sleeve_play_rad = 0.0044;
  model.tremor_rad = 0.01;
  model.tremor_m = 0.001;
  double squares = 0.0;
  int count = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    for (const auto& [angle_rad, off_m] : against_wires(Operated(looking(), model, seed))) {
      squares += angle_rad * angle_rad;
      ++count;
      EXPECT_LT(off_m, kSliding_m);
    }
  }
  ASSERT_EQ(count, 16);
  // Rayleigh: the mean of squares is twice the variance; of 32 normal draws the SD is known to 13
  // %.
  EXPECT_NEAR(std::sqrt(squares / (2.0 * count)) / model.sleeve_play_rad, 1.0, 0.5);
}

TEST(PlacingSurgeon, RedoesOnceWhatLiesBeyondALimitAndTheNewWireTakesItsPlace) {
  EngineOptions options = looking();
  options.wires_off = 1;
  const Operated operated(options);
  ASSERT_EQ(operated.engine.history().back(), "done");
  EXPECT_EQ(count_of(operated.engine.phrases(), "delete last"), 1U);
  const Truth& truth = operated.headset->truth();
  EXPECT_EQ(truth.wires.size(), operated.test_case.screws.size()) << "one of each screw";
  EXPECT_EQ(truth.heads.size(), operated.test_case.screws.size());
  const auto guided = std::count(operated.engine.history().begin(), operated.engine.history().end(),
                                 "guide L4 left") +
                      std::count(operated.engine.history().begin(), operated.engine.history().end(),
                                 "guide L5 left");
  EXPECT_EQ(guided, 3) << "one of them again";
}

TEST(PlacingSurgeon, KeepsTheSecondWireOfAScrewWhateverItIs) {
  EngineOptions options = looking();
  options.wires_off = 2;
  const Operated operated(options);
  ASSERT_EQ(operated.engine.history().back(), "done");
  EXPECT_EQ(count_of(operated.engine.phrases(), "delete last"), 1U);
  EXPECT_FALSE(operated.headset->truth().surgeon_gave_up);
}

TEST(PlacingSurgeon, KeepsWhatCannotBeRedone) {
  EngineOptions options = looking();
  options.wires_off = 1;
  options.no_other_entry = true;
  const Operated operated(options);
  ASSERT_EQ(operated.engine.history().back(), "done");
  EXPECT_EQ(count_of(operated.engine.phrases(), "delete last"), 1U);
  EXPECT_EQ(operated.headset->truth().wires.size(), operated.test_case.screws.size());
}

}  // namespace
}  // namespace orthonav::sim
