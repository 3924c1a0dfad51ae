#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tools/operation_estimate.h"
#include "tools/progress_bar.h"

namespace orthonav::tools {
namespace {

/// Two levels of two screws.
struct Operation {
  std::vector<engine::LevelState> levels = std::vector<engine::LevelState>(2);

  Operation() {
    for (engine::LevelState& level : levels) {
      level.screw_done.assign(2, false);
    }
  }
  [[nodiscard]] engine::Guidance at(Step step, const std::string& level = "L4") const {
    engine::Guidance guidance;
    guidance.step = step;
    guidance.status.at = {step, level, std::nullopt};
    guidance.levels = levels;
    return guidance;
  }
};

Timestamp at(int s) { return Timestamp(std::chrono::seconds(s)); }

TEST(OperationEstimate, GrowsWhileAStepLastsAndStaysBelowItsPart) {
  OperationEstimate estimate;
  const Operation operation;
  const engine::Guidance digitizing = operation.at(Step::kDigitize);
  double before = estimate.fraction(at(100), digitizing);
  EXPECT_EQ(before, 0.0);
  for (int s = 110; s < 3000; s += 10) {
    const double now = estimate.fraction(at(s), digitizing);
    EXPECT_GE(now, before);
    before = now;
  }
  EXPECT_GT(before, 0.2);
  EXPECT_LT(before, 0.4) << "one of two levels, its screws ahead";
}

TEST(OperationEstimate, NeverFallsWhenALevelIsStrokedAgain) {
  OperationEstimate estimate;
  Operation operation;
  operation.levels[0].registration.emplace();
  const double registered = estimate.fraction(at(200), operation.at(Step::kVerify));
  EXPECT_GT(registered, 0.2);
  const Operation again;
  EXPECT_EQ(estimate.fraction(at(201), again.at(Step::kDigitize)), registered);
}

TEST(OperationEstimate, IsWholeOnlyWhenTheOperationIsDone) {
  OperationEstimate estimate;
  Operation operation;
  for (engine::LevelState& level : operation.levels) {
    level.registration.emplace();
    level.accepted = true;
    level.screw_done.assign(2, true);
  }
  (void)estimate.fraction(at(0), operation.at(Step::kRod, ""));
  EXPECT_LT(estimate.fraction(at(100'000), operation.at(Step::kRod, "")), 1.0);
  EXPECT_EQ(estimate.fraction(at(100'001), operation.at(Step::kDone, "")), 1.0);
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
