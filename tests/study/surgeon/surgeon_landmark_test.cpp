#include <gmock/gmock.h>

#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {
namespace {

using ::testing::ElementsAre;

struct Performed {
  std::vector<std::string> history;
  std::map<std::string, DigitizedLevel> levels;
  bool gave_up = false;
};

Performed performed(const EngineOptions& options, const ErrorModel& error_model = {}) {
  const TestCase test_case = synthetic_case();
  auto headset = SimHeadset::open(test_case.room, without_pixels(1, error_model));
  EXPECT_TRUE(headset.ok());
  FakeEngine engine(**headset, test_case, options);
  EXPECT_GT(engine.run(), 0);
  return {engine.history(), engine.levels(), (*headset)->truth().surgeon_gave_up};
}

TEST(LandmarkSurgeon, TouchesTheSamePlaceBeforeEveryScrew) {
  EngineOptions options;
  options.landmark = true;
  ErrorModel seated = ErrorModel::perfect();
  seated.landmark_seating_m = 0.0002;
  for (const bool perfect : {true, false}) {
    const Performed done = performed(options, perfect ? ErrorModel::perfect() : seated);
    ASSERT_EQ(done.history.back(), "done");
    for (const auto& [label, level] : done.levels) {
      ASSERT_EQ(level.landmark_in_vertebra.size(), 2U) << label;
      const double apart_m = (level.landmark_in_vertebra[0] - level.landmark_in_vertebra[1]).norm();
      if (perfect) {
        EXPECT_LT(apart_m, 1e-6);
      } else {
        EXPECT_GT(apart_m, 0.00002) << "the tip does not sit alike twice";
        EXPECT_LT(apart_m, 0.0015) << "five SDs of the distance";
      }
    }
  }
}

TEST(LandmarkSurgeon, ChecksOnceAndRejectsTheSecondTime) {
  EngineOptions once;
  once.landmark = true;
  once.landmark_moves = 1;
  const Performed slipped = performed(once);
  ASSERT_EQ(slipped.history.back(), "done");
  const std::vector<std::string> begin(slipped.history.begin(), slipped.history.begin() + 8);
  EXPECT_THAT(begin, ElementsAre("setup", "digitize L4", "verify L4", "landmark L4",
                                 "guide L4 left", "landmark L4", "verify L4", "landmark L4"));
  once.landmark_moves = 2;
  const Performed moved = performed(once);
  ASSERT_GT(moved.history.size(), 9U);
  EXPECT_EQ(moved.history[8], "verify L4");
  EXPECT_EQ(moved.history[9], "digitize L4");
}

}  // namespace
}  // namespace orthonav::sim
