#include "study/clearance_statistics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace orthonav::engine::clearance_statistics_test {
namespace {

TEST(ClearanceQuality, CountsBoundsThatHeldAndGradesAgainstTheTruth) {
  const auto runs = nlohmann::ordered_json::parse(R"([{"levels": [{"screws": [
    {"clearance_mm": 1.0, "planned": {"clearance_95_mm": 0.5},
     "tracked": {"clearance_95_mm": 1.1, "grade_probability": {"A": 0.9, "B": 0.1}}},
    {"clearance_mm": -2.5, "planned": {"clearance_95_mm": -3.0},
     "tracked": {"clearance_95_mm": -2.6, "grade_probability": {"A": 0.3, "B": 0.7}}},
    {"clearance_mm": 1.0, "planned": {"clearance_mm": 2.0}},
    {"planned": {"clearance_95_mm": 0.5}}]}, {"label": "L5"}]}])");
  ClearanceQuality quality;
  for (const auto& run : runs) {
    add_run(run, quality);
  }
  EXPECT_EQ(quality.planned.screws, 2);
  EXPECT_EQ(quality.planned.held, 2);
  EXPECT_EQ(quality.tracked.screws, 2);
  EXPECT_EQ(quality.tracked.held, 1);
  EXPECT_DOUBLE_EQ(quality.tracked.fraction(), 0.5);
  EXPECT_EQ(quality.grades[0][0], 1);
  EXPECT_EQ(quality.grades[1][2], 1) << "expected B, in truth C";
  const auto json = clearance_json(quality);
  EXPECT_EQ(json["true_grades_by_likeliest"]["B"][2], 1);
  EXPECT_EQ(ClearanceQuality{}.tracked.fraction(), 0.0);
}

}  // namespace
}  // namespace orthonav::engine::clearance_statistics_test
