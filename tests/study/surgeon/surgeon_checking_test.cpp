#include <gmock/gmock.h>

#include <algorithm>

#include "hal/sim/room/bone_surface.h"
#include "hal/sim/surgeon/stroke_plan.h"
#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {
namespace {

using ::testing::ElementsAre;

TEST(CheckingSurgeon, TouchesSpreadPlacesOfTheBoneUntilNoMoreAreAskedFor) {
  const TestCase test_case = synthetic_case();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    auto headset = SimHeadset::open(test_case.room, without_pixels(seed, ErrorModel::perfect()));
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    EngineOptions options;
    options.check_points = 4;
    FakeEngine engine(**headset, test_case, options);
    EXPECT_GT(engine.run(), 0);
    ASSERT_EQ(engine.history().back(), "done");
    for (const RoomLevel& level : test_case.room.levels) {
      const auto& touched = engine.levels().at(level.label).checks_in_vertebra;
      ASSERT_EQ(touched.size(), 4U) << level.label << ": as many as asked for and no more";
      for (std::size_t i = 0; i < touched.size(); ++i) {
        EXPECT_LT((BoneSurface(level).closest(touched[i]).point - touched[i]).norm(), 0.0003);
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_GT((touched[i] - touched[j]).norm(), 0.016);
        }
      }
    }
  }
}

TEST(CheckingSurgeon, ChoosesThreePlacesAndThenTouchesWhereTheDisplayShowsOne) {
  const TestCase test_case = synthetic_case();
  const RoomLevel& level = test_case.room.levels.front();
  const Stroke stroke = plan_strokes(level).front().strokes.front();
  const Vec3 shown = stroke.at(0.3 * stroke.length_m()).point;
  for (const double perception_m : {0.0, 0.003}) {
    ErrorModel error_model = ErrorModel::perfect();
    error_model.overlay_perception_m = perception_m;
    auto headset = SimHeadset::open(test_case.room, without_pixels(1, error_model));
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    EngineOptions options;
    options.check_points = 9;
    options.place_to_touch = shown;
    FakeEngine engine(**headset, test_case, options);
    EXPECT_GT(engine.run(), 0);
    const auto& touched = engine.levels().at(level.label).checks_in_vertebra;
    ASSERT_EQ(touched.size(), 9U);
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < touched.size(); ++i) {
      const double off_m = (touched[i] - shown).norm();
      EXPECT_LT((BoneSurface(level).closest(touched[i]).point - touched[i]).norm(), 0.0003);
      if (i < 3) {
        EXPECT_GT((touched[i] - touched[(i + 1) % 3]).norm(), 0.016) << "their own choice";
      } else {
        farthest_m = std::max(farthest_m, off_m);
      }
    }
    if (perception_m == 0.0) {
      EXPECT_LT(farthest_m, 0.001);
    } else {
      EXPECT_GT(farthest_m, 0.001) << "as well as they see where it is";
      EXPECT_LT(farthest_m, 0.015);
    }
  }
}

TEST(CheckingSurgeon, TouchesAgainWhatWasNotRecordedWhileVerifying) {
  const TestCase test_case = synthetic_case();
  auto headset = SimHeadset::open(test_case.room, without_pixels(1));
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EngineOptions options;
  options.check_points = 3;
  options.lost_touches = 2;
  FakeEngine engine(**headset, test_case, options);
  EXPECT_GT(engine.run(), 0);
  EXPECT_EQ(engine.history().back(), "done");
  EXPECT_EQ(engine.levels().at("L4").checks_in_vertebra.size(), 3U);
}

TEST(CheckingSurgeon, RejectsWhenToldThatATouchedPlaceIsTooFarOff) {
  const TestCase test_case = synthetic_case();
  auto headset = SimHeadset::open(test_case.room, without_pixels(1));
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  EngineOptions options;
  options.check_points = 3;
  options.off = true;
  FakeEngine engine(**headset, test_case, options);
  EXPECT_GT(engine.run(), 0);
  EXPECT_THAT(engine.history(),
              ElementsAre("setup", "digitize L4", "verify L4", "digitize L4", "verify L4",
                          "digitize L4", "verify L4", "digitize L4"));
  EXPECT_TRUE((*headset)->truth().surgeon_gave_up);
}

TEST(CheckingSurgeon, TouchesNothingWhereTheLineAsksForNothing) {
  const TestCase test_case = synthetic_case();
  auto headset = SimHeadset::open(test_case.room, without_pixels(1));
  ASSERT_TRUE(headset.ok()) << headset.error().message;
  FakeEngine engine(**headset, test_case);
  EXPECT_GT(engine.run(), 0);
  const auto accept =
      std::find_if(engine.phrases().begin(), engine.phrases().end(),
                   [](const Phrase& phrase) { return phrase.text == "accept result"; });
  ASSERT_NE(accept, engine.phrases().end());
  // The double click that asked for the registration is the last that was clicked.
  const auto after = std::find_if(engine.clicks().begin(), engine.clicks().end(),
                                  [&](const ClickerEvent& c) { return c.time > accept->time; });
  ASSERT_NE(after, engine.clicks().begin());
  EXPECT_EQ((after - 1)->action, ClickerAction::kDoubleClick);
}

TEST(CheckingSurgeon, CheckingDrawsFromARandomStreamOfItsOwn) {
  // How surely a word is understood is drawn from the hand's stream: the first "next" comes after
  // every touch and is understood as well as without any.
  const TestCase test_case = synthetic_case();
  std::vector<std::vector<Phrase>> spoken;
  for (const int check_points : {0, 3}) {
    auto headset = SimHeadset::open(test_case.room, without_pixels(1));
    ASSERT_TRUE(headset.ok()) << headset.error().message;
    EngineOptions options;
    options.check_points = check_points;
    FakeEngine engine(**headset, test_case, options);
    EXPECT_GT(engine.run(), 0);
    spoken.push_back(engine.phrases());
  }
  std::size_t i = 0;
  do {
    ASSERT_LT(i, std::min(spoken[0].size(), spoken[1].size()));
    EXPECT_EQ(spoken[0][i].text, spoken[1][i].text) << i;
    EXPECT_EQ(spoken[0][i].confidence, spoken[1][i].confidence) << spoken[0][i].text;
  } while (spoken[0][i++].text != "go to next");
  EXPECT_GT(spoken[1][i - 1].time, spoken[0][i - 1].time) << "the touches took their time";
}

}  // namespace
}  // namespace orthonav::sim
