#include "study/study_comparison.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/comparison_page.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

/// An operation on L5 with these angles left and right; below zero: that screw was not placed.
nlohmann::json operation_with(std::uint64_t seed, double left_deg, double right_deg,
                              bool completed = true) {
  nlohmann::json screws = nlohmann::json::array();
  const auto add = [&screws](const char* side, double angle_deg) {
    nlohmann::json screw = {{"side", side}};
    if (angle_deg >= 0.0) {
      screw["angle_error_deg"] = angle_deg;
    }
    screws.push_back(screw);
  };
  add("left", left_deg);
  add("right", right_deg);
  return {{"case", "phantom"},
          {"seed", seed},
          {"completed", completed},
          {"levels", {{{"label", "L5"}, {"tre_mm", 2.0 * left_deg}, {"screws", screws}}}}};
}

std::string study_with(const std::string& method, const std::vector<nlohmann::json>& runs) {
  return nlohmann::json{{"method", method}, {"runs", runs}}.dump();
}

Result<StudyComparison> compared_by(const std::string& first, const std::string& second) {
  return compare_studies({first, second}, {"a.json", "b.json"});
}

const ComparedQuantity& angle_in(const StudyComparison& comparison) {
  return comparison.quantities.front();
}

TEST(StudyComparison, PairsScrewsAndCountsOperations) {
  // In another order, and the first operation's right screw is missing in the second study.
  const auto found =
      compared_by(study_with("best", {operation_with(1, 1.0, 9.0), operation_with(2, 2.0, 4.0),
                                      operation_with(3, 3.0, 3.0, false)}),
                  study_with("paper", {operation_with(3, 4.0, 5.0), operation_with(2, 4.0, 4.0),
                                       operation_with(1, 2.0, -1.0), operation_with(7, 1.0, 1.0)}));
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_EQ(found->operations, 3u);
  EXPECT_EQ(found->only_first, 0u);
  EXPECT_EQ(found->only_second, 1u);
  EXPECT_EQ(found->completed_first, 2u);
  EXPECT_EQ(found->completed_second, 3u);
  ASSERT_THAT(found->quantities, SizeIs(2)) << "angle and TRE; the others have no value";
  const ComparedQuantity& angle = angle_in(*found);
  EXPECT_EQ(angle.pairs, 5u);
  ASSERT_THAT(angle.operations, SizeIs(3));
  // Differences of the operations: 1 - 2, 3 - 4, 3 - 4.5; the unpaired 9.0 counts nowhere.
  EXPECT_DOUBLE_EQ(angle.operations[0].first, 1.0);
  EXPECT_DOUBLE_EQ(angle.operations[2].second, 4.5);
  EXPECT_DOUBLE_EQ(angle.first_mean, 7.0 / 3.0);
  EXPECT_DOUBLE_EQ(angle.second_mean, 3.5);
  EXPECT_NEAR(angle.difference.mean, -3.5 / 3.0, 1e-12);
  // SD of (-1, -1, -1.5) is 0.2887, Student's t of two degrees of freedom 4.3027.
  EXPECT_NEAR(angle.difference.high - angle.difference.mean, 4.3027 * 0.288675 / std::sqrt(3.0),
              1e-4);
}

TEST(StudyComparison, TurnsItsSignWithItsStudies) {
  const std::string one = study_with("best", {operation_with(1, 1.0, 2.0)});
  const std::string other = study_with("paper", {operation_with(1, 4.0, 6.0)});
  EXPECT_DOUBLE_EQ(angle_in(*compared_by(one, other)).difference.mean, -3.5);
  EXPECT_DOUBLE_EQ(angle_in(*compared_by(other, one)).difference.mean, 3.5);
}

TEST(StudyComparison, NamesStudiesOfOneMethodByTheirFiles) {
  const std::string one = study_with("best", {operation_with(1, 1.0, 2.0)});
  EXPECT_EQ(compared_by(one, one)->first, "a.json");
  EXPECT_EQ(compared_by(one, study_with("paper", {operation_with(1, 1.0, 2.0)}))->first, "best");
}

TEST(StudyComparison, RefusesStudiesThatHaveNothingInCommon) {
  const std::string one = study_with("best", {operation_with(1, 1.0, 2.0)});
  EXPECT_EQ(compared_by(one, study_with("paper", {operation_with(2, 1.0, 2.0)})).error().message,
            "a.json, b.json: no operation in common (the same case and seed)");
  EXPECT_THAT(compared_by(one, "[]").error().message, HasSubstr("b.json: is not a study"));
  EXPECT_THAT(compared_by(study_with("best", {{{"case", "a"}}}), one).error().message,
              HasSubstr("a.json: a run lacks"));
}

TEST(StudyComparison, TellsAllInItsTableAndItsJson) {
  const auto found =
      compared_by(study_with("best", {operation_with(1, 1.0, 1.0), operation_with(2, 2.0, 2.0),
                                      operation_with(3, 3.0, 3.0)}),
                  study_with("paper", {operation_with(1, 2.0, 2.0), operation_with(2, 3.0, 3.0),
                                       operation_with(3, 4.0, 4.0)}));
  ASSERT_TRUE(found.ok()) << found.error().message;
  const std::string table = comparison_table(*found);
  EXPECT_THAT(table, HasSubstr("3 operations in both studies"));
  EXPECT_THAT(table, HasSubstr("| | `best` | `paper` | `best` less `paper` | 95 % interval |"));
  EXPECT_THAT(table, HasSubstr("| Trajectory error, ° | 2.00 | 3.00 | -1.00 | -1.00 to -1.00 | 0.5 "
                               "| 1.000 | 3 | 6 screws |"));
  const nlohmann::ordered_json json = comparison_json(*found);
  EXPECT_EQ(json["completed_second"], 3);
  EXPECT_EQ(json["quantities"][0]["difference"], -1.0);
  EXPECT_EQ(json["quantities"][0]["operations"][1]["seed"], 2);
  EXPECT_EQ(json["quantities"][0]["operations"][1]["second"], 3.0);
}

TEST(StudyComparison, SaysWhereOperationsAreTooFewForAnInterval) {
  const auto found = compared_by(study_with("best", {operation_with(1, 1.0, 1.0)}),
                                 study_with("paper", {operation_with(1, 2.0, 2.0)}));
  EXPECT_THAT(comparison_table(*found), HasSubstr("| -1.00 | too few | 0.5 | 1.000 | 1 |"));
  EXPECT_TRUE(comparison_json(*found)["quantities"][0].dump().find("\"low_95\":null") !=
              std::string::npos);
  EXPECT_THAT(comparison_html(*found), HasSubstr("too few operations"));
}

TEST(ComparisonPage, HoldsEveryDotAndNoForeignMarkup) {
  const auto found = compared_by(study_with("<best>", {operation_with(1, 1.0, 1.0)}),
                                 study_with("</script>", {operation_with(1, 2.5, 2.5)}));
  ASSERT_TRUE(found.ok()) << found.error().message;
  const std::string page = comparison_html(*found);
  EXPECT_THAT(page, HasSubstr("\"values\":[-1.5]"));
  EXPECT_THAT(page, HasSubstr("&lt;best&gt; less &lt;/script&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("less </script>")));
}

}  // namespace
}  // namespace orthonav::engine
