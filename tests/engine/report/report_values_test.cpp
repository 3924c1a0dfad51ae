#include "engine/report/report_values.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/report/script_json.h"

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReportValues, TakesNumbersAndNothingElse) {
  const nlohmann::json object = {{"a", 1.5}, {"b", "2"}, {"c", nullptr}, {"d", 3}};
  EXPECT_EQ(value_of(object, "a"), 1.5);
  EXPECT_EQ(value_of(object, "d"), 3.0);
  EXPECT_FALSE(value_of(object, "b").has_value());
  EXPECT_FALSE(value_of(object, "c").has_value());
  EXPECT_FALSE(value_of(object, "e").has_value());
  EXPECT_FALSE(value_of(nlohmann::json(4.0), "a").has_value());
}

TEST(ReportValues, AreOfLevelsOrOfScrews) {
  const nlohmann::json report = nlohmann::json::parse(R"({"levels": [
      {"rmse_mm": 1, "screws": [{"angle_error_deg": 2}, {}, {"angle_error_deg": 3}]},
      {"rmse_mm": "?", "screws": 7}, 5, {"screws": [{"angle_error_deg": 4, "rmse_mm": 9}]}]})");
  EXPECT_THAT(values_of(report, "angle_error_deg", true), ElementsAre(2.0, 3.0, 4.0));
  EXPECT_THAT(values_of(report, "rmse_mm", false), ElementsAre(1.0));
  EXPECT_THAT(values_of(nlohmann::json::object(), "rmse_mm", false), IsEmpty());
  EXPECT_THAT(values_of(nlohmann::json("no report"), "rmse_mm", false), IsEmpty());
}

TEST(ScriptJson, NeitherEndsItsElementNorKeepsItFromEnding) {
  EXPECT_EQ(script_json({{"name", "</script>"}}), R"({"name":"\u003c/script>"})");
  EXPECT_EQ(script_json({{"name", "<!--<script>"}}), R"({"name":"\u003c!--\u003cscript>"})");
}

}  // namespace
}  // namespace orthonav::engine
