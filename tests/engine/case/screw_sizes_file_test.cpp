#include "engine/case/screw_sizes_file.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::screw_sizes_file_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

Result<ScrewSizes> read(const std::string& screws) {
  const test::TemporaryFolder folder;
  return load_screw_sizes(folder.with("sizes.json", R"({"screws": )" + screws + "}"));
}

/// The line that it is refused with, from the name of the file on.
std::string refusal(const std::string& screws) {
  const auto sizes = read(screws);
  const std::string line = sizes ? "accepted" : sizes.error().message;
  return line.substr(std::min(line.find("sizes.json"), line.size()));
}

TEST(ScrewSizesFile, ReadsMillimetresInAnyOrder) {
  const auto sizes = read(R"([{"diameter_mm": 6.5, "lengths_mm": [45, 35, 40]},
                              {"diameter_mm": 5.5, "lengths_mm": [30], "head_to_seat_mm": 7.5}])");
  ASSERT_TRUE(sizes) << sizes.error().message;
  ASSERT_EQ(sizes->by_diameter.size(), 2u);
  EXPECT_DOUBLE_EQ(sizes->by_diameter[0].diameter_m, 0.0055);
  EXPECT_EQ(sizes->head_to_seat_m(0.0055), 0.0075);
  EXPECT_EQ(sizes->head_to_seat_m(0.0065), std::nullopt) << "not stated";
  EXPECT_EQ(sizes->head_to_seat_m(0.0085), std::nullopt) << "not in the list";
  EXPECT_THAT(sizes->by_diameter[1].lengths_m, ElementsAre(0.035, 0.040, 0.045));
}

TEST(ScrewSizesFile, RefusesWhatIsNotAListOfScrewsInOneLine) {
  for (const char* bad :
       {"[]",
        "{}",
        "7",
        R"([{"diameter": 6.5, "lengths_mm": [40]}])",
        R"([{"diameter_mm": 6.5, "lengths": [40]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": []}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": 40}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40, "x"]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [[40]]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [1e999]}])",
        R"([{"diameter_mm": NaN, "lengths_mm": [40]}])",
        R"([{"diameter_mm": null, "lengths_mm": [40]}])",
        R"([{"diameter_mm": -6.5, "lengths_mm": [40]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [-40]}])",
        R"([{"diameter_mm": 0.0065, "lengths_mm": [0.04]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40, 40]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40, 40.2]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40]}, {"diameter_mm": 6.5, "lengths_mm": [45]}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40], "head_to_seat_mm": -16}])",
        R"([{"diameter_mm": 6.5, "lengths_mm": [40], "head_to_seat_mm": "x"}])"}) {
    EXPECT_THAT(refusal(bad), AllOf(StartsWith("sizes.json: "), Not(HasSubstr("\n")))) << bad;
  }
  EXPECT_THAT(refusal(R"([{"diameter": 6.5, "lengths_mm": [40]}])"),
              HasSubstr("screws[0].diameter_mm is missing"));
  EXPECT_THAT(refusal(R"([{"diameter_mm": 6.5, "lengths_mm": [40, 40]}])"),
              HasSubstr("lengths_mm holds 40 twice"));
  EXPECT_THAT(load_screw_sizes("/nowhere/sizes.json").error().message,
              HasSubstr("cannot be opened"));
}

TEST(ScrewSizesFile, PlannedScrewsThatAreNotListedAreNamed) {
  Case spine = phantom({"L4"});
  spine.levels[0].screws[0].radius_m = 0.00325;
  spine.levels[0].screws[1].radius_m = 0.0;
  const Operation operation = plan_operation(spine, {"L4"}).value();
  const auto listed = read(R"([{"diameter_mm": 6.5, "lengths_mm": [45]}])").value();
  EXPECT_THAT(sizes_not_listed(operation, listed), IsEmpty());
  const auto shorter = read(R"([{"diameter_mm": 6.5, "lengths_mm": [44]}])").value();
  EXPECT_THAT(sizes_not_listed(operation, shorter),
              ElementsAre(HasSubstr(": 6.5 x 45.0 mm is not in the list of screws"),
                          HasSubstr(": length 45.0 mm is not in the list of screws")));
}

}  // namespace
}  // namespace orthonav::engine::screw_sizes_file_test
