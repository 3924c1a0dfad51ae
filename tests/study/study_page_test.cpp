#include "study/study_page.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/browser.h"

namespace orthonav::engine {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two screws, of which one missed the bone, and an operation that came to nothing.
std::string small_study(const std::string& case_name) {
  const nlohmann::json screws = {
      {{"side", "left"}, {"angle_error_deg", 1.25}, {"entry_error_mm", 2.0}},
      {{"side", "right"}, {"angle_error_deg", 6.5}}};
  const nlohmann::json runs = {{{"case", case_name},
                                {"seed", 3},
                                {"completed", true},
                                {"levels", {{{"label", "L5"}, {"screws", screws}}}}},
                               {{"case", case_name},
                                {"seed", 4},
                                {"completed", false},
                                {"why_not", "ended at setup"},
                                {"levels", nlohmann::json::array()}}};
  return nlohmann::json{{"method", "paper"}, {"operations", 2}, {"completed", 1}, {"runs", runs}}
      .dump();
}

TEST(StudyPage, ShowsTheWorstScrewsFirstAndTheirCommand) {
  const std::string page = study_html(small_study("phantom"));
  const auto worst = page.find("phantom, L5 right");
  ASSERT_NE(worst, std::string::npos);
  EXPECT_LT(worst, page.find("phantom, L5 left"));
  EXPECT_THAT(page,
              HasSubstr("<td data-label=\"angle [°]\">6.50</td><td data-label=\"entry [mm]\">–</td>"
                        "<td class=\"text again\" data-label=\"to repeat it\"><code><span>orthonav "
                        "preview</span> "
                        "<span>--replay 3</span> <span>--method paper</span></code>"));
}

TEST(StudyPage, ShowsWhatWasNotCompletedAndWhy) {
  EXPECT_THAT(
      study_html(small_study("phantom")),
      HasSubstr("<td data-label=\"seed\">4</td><td class=text data-label=\"why\">ended at "
                "setup</td><td class=\"text again\" data-label=\"to repeat it\"><code><span>"
                "orthonav preview</span> <span>--replay 4</span>"));
}

TEST(StudyPage, RepeatsAnOperationByTheCommandOfItsStudy) {
  const std::string page =
      study_html(small_study("spine"), [](const std::string& name, std::uint64_t seed) {
        return "again '" + name + "' & " + std::to_string(seed);
      });
  EXPECT_THAT(page, HasSubstr("<code><span>again 'spine' &amp; 3</span></code>"));
  EXPECT_THAT(page, Not(HasSubstr("orthonav preview")));
}

TEST(StudyPage, GivesNoIntervalOfTooFewOperations) {
  EXPECT_THAT(study_html(small_study("phantom")), HasSubstr("too few operations"));
  nlohmann::json study = nlohmann::json::parse(small_study("phantom"));
  const nlohmann::json run = study["runs"][0];
  study["runs"] = {run, run, run};
  for (const int i : {0, 1, 2}) {
    auto& screws = study["runs"][static_cast<std::size_t>(i)]["levels"][0]["screws"];
    screws.erase(1);
    screws[0]["angle_error_deg"] = 1.0 + i;
    screws[0].erase("entry_error_mm");
  }
  // Mean 2, standard error 1/sqrt(3), two degrees of freedom: 2 ± 4.303 / sqrt(3).
  const std::string page = study_html(study.dump());
  EXPECT_THAT(page, HasSubstr("−0.48 to 4.48"));
  EXPECT_THAT(page, Not(HasSubstr("too few operations")));
}

TEST(StudyPage, DrawsEveryValueItHas) {
  const std::string page = study_html(small_study("phantom"));
  EXPECT_THAT(page, HasSubstr("\"values\":[1.25,6.5]"));
  EXPECT_THAT(page, HasSubstr("\"values\":[2.0]"));
}

TEST(StudyPage, TakesNoNameForMarkup) {
  EXPECT_THAT(study_html(small_study("<b>")), Not(HasSubstr("<b>, L5")));
  EXPECT_THAT(study_html("[]"), HasSubstr("This is not a study."));
}

TEST(StudyPage, FitsAPhone) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  EXPECT_EQ(test::too_wide_for_a_phone(study_html(small_study("a case of a rather long name"))),
            "");
  EXPECT_THAT(
      test::too_wide_for_a_phone("<body><table class=wide><td style='min-width:600px'>wide</body>"),
      HasSubstr("wide"))
      << "a table that does not fit is seen";
}

}  // namespace
}  // namespace orthonav::engine
