#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tools/orthonav/operation/operation_estimate.h"
#include "tools/orthonav/shared/progress_bar.h"

namespace orthonav::tools {
namespace {

/// Two levels of two screws.
struct Operation {
  std::vector<engine::LevelState> levels = std::vector<engine::LevelState>(2);

  Operation() {
    for (engine::LevelState& level : levels) {
      level.screws.resize(2);
    }
  }
  [[nodiscard]] engine::Guidance at(engine::Step step, const std::string& level = "L4") const {
    engine::Guidance guidance;
    guidance.step = step;
    guidance.status.at = {step, level, std::nullopt};
    guidance.levels = levels;
    return guidance;
  }
};

Timestamp at(int s) { return Timestamp(std::chrono::seconds(s)); }

TEST(OperationEstimate, GrowsWhileAStepLastsTowardsThePartsThatAreLeft) {
  OperationEstimate estimate;
  const Operation operation;
  const engine::Guidance digitizing = operation.at(engine::Step::kDigitize);
  double before = estimate.fraction(at(100), digitizing);
  EXPECT_EQ(before, 0.0);
  for (int s = 110; s < 400; s += 10) {
    const double now = estimate.fraction(at(s), digitizing);
    EXPECT_GT(now, before);
    before = now;
  }
  EXPECT_GT(before, 0.2);
  EXPECT_LT(before, 0.5) << "five minutes for the first of two levels";
}

TEST(OperationEstimate, NeverFallsWhenALevelIsStrokedAgain) {
  OperationEstimate estimate;
  Operation operation;
  (void)estimate.fraction(at(0), operation.at(engine::Step::kDigitize));
  operation.levels[0].registration.emplace();
  const double registered = estimate.fraction(at(200), operation.at(engine::Step::kVerify));
  EXPECT_GT(registered, 0.2);
  const Operation again;
  EXPECT_EQ(estimate.fraction(at(201), again.at(engine::Step::kDigitize)), registered);
}

TEST(OperationEstimate, IsWholeOnlyWhenTheOperationIsDone) {
  OperationEstimate estimate;
  Operation operation;
  for (engine::LevelState& level : operation.levels) {
    level.registration.emplace();
    level.accepted = true;
    level.screws = {{.done = true}, {.done = true}};
  }
  (void)estimate.fraction(at(0), operation.at(engine::Step::kRod, ""));
  EXPECT_LT(estimate.fraction(at(100'000), operation.at(engine::Step::kRod, "")), 1.0);
  EXPECT_EQ(estimate.fraction(at(100'001), operation.at(engine::Step::kDone, "")), 1.0);
}

TEST(ProgressBar, SaysWhatIsLeftOnceThatIsKnown) {
  EXPECT_EQ(progress_text(0.02, 0.0, "digitize L4", 5.0), "digitize L4, 5 s");
  EXPECT_EQ(progress_text(0.25, 0.0, "verify L4", 40.0), "verify L4, 40 s, about 2 min left");
  EXPECT_EQ(progress_text(0.6, 0.5, "60 of 100", 10.0), "60 of 100, 10 s, about 40 s left")
      << "half was there before";
  EXPECT_EQ(progress_text(1.0, 0.0, "done", 100.0), "done, 2 min");
}

TEST(ProgressBar, IsNotSilentWhileNobodyCalls) {
  testing::internal::CaptureStderr();
  {
    ProgressBar bar(std::chrono::milliseconds(20));
    bar.draw(0.5, "register L4");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AllOf(testing::StartsWith(" 50 %  register L4, 0 s, about 0 s left\n"),
                             testing::ContainsRegex("left\n.*left\n")));
}

TEST(ProgressBar, FillsTheTerminalsWidthAndNoMore) {
  EXPECT_EQ(bar_text(0.5, "guide L4 left", 40), "[########........]  50 %  guide L4 left");
  for (const std::size_t columns : {20U, 30U, 40U, 80U, 200U}) {
    EXPECT_LT(bar_text(0.5, "guide L4 left, about 40 s left", columns).size(), columns);
  }
  EXPECT_EQ(bar_text(0.5, "guide L4 left", 20), " 50 %  guide L4 lef") << "no room for a bar";
}

}  // namespace
}  // namespace orthonav::tools
