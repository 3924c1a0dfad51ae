#include "base/translation.h"

#include <gmock/gmock.h>

#include "base/printed.h"
#include "base/reason.h"
#include "tests/support/language_in_use.h"

namespace orthonav::translation_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class Translated : public ::testing::Test {
 protected:
  test::LanguageInUse in_use_{std::vector<Translation::Entry>{
      {"tool lost", "Werkzeug verloren"},
      {"tip moved %.1f mm, limit %.1f mm", "Spitze um %.1f mm verrutscht, Grenze %.1f mm"},
      {"just over", "knapp über"},
      {"just under", "knapp unter"},
      {"heads %zu and %zu are %s apart, limit 5-150 mm", "Köpfe %zu und %zu: %s, Grenze 5-150 mm"},
      {"%s: %s, such as \"%s\"", "%s: %s, etwa \"%s\""},
      {"say how far", "sagen, wie weit"},
      {"only %.0f %% lie on it", "nur %.0f %% liegen darauf"}}};
};

TEST_F(Translated, IsForTheWearerAlone) {
  EXPECT_STREQ(translated("tool lost"), "tool lost");
  {
    const WearersLanguage language;
    EXPECT_STREQ(translated("tool lost"), "Werkzeug verloren");
    EXPECT_EQ(translated(std::string_view("\"accept\"")), "\"accept\"") << "not in the table";
    {
      const WearersLanguage again;
      EXPECT_STREQ(translated("tool lost"), "Werkzeug verloren");
    }
    EXPECT_STREQ(translated("tool lost"), "Werkzeug verloren");
  }
  EXPECT_STREQ(translated("tool lost"), "tool lost");
  {
    const WearersLanguage language;
    const InEnglish for_a_file;
    EXPECT_STREQ(translated("tool lost"), "tool lost");
  }
}

TEST_F(Translated, KeepsNumbersApartFromTheirLimits) {
  constexpr const char* kMoved = "tip moved %.1f mm, limit %.1f mm";
  EXPECT_EQ(beside_limit(kMoved, 3.00000001, 3.0), "tip moved just over 3.0 mm, limit 3.0 mm");
  const WearersLanguage language;
  EXPECT_EQ(beside_limit(translated(kMoved), 3.04, 3.0),
            "Spitze um 3.04 mm verrutscht, Grenze 3.00 mm");
  EXPECT_EQ(beside_limit(translated(kMoved), 3.00000001, 3.0),
            "Spitze um knapp über 3.0 mm verrutscht, Grenze 3.0 mm");
}

TEST_F(Translated, ErrorsOfAReasonAreTold) {
  const auto expect_told = [](Reason reason, const char* english, const char* german) {
    const Error error = refused(std::move(reason));
    EXPECT_EQ(error.message, english);
    std::string out = "; ";
    append_error(out, error);
    EXPECT_EQ(out, std::string("; ") + german);
  };
  const WearersLanguage language;
  const std::size_t one = 1;
  const std::size_t twelve = 12;
  constexpr const char* kApart = "heads %zu and %zu are %s apart, limit 5-150 mm";
  expect_told({kApart, {one, twelve, NearLimit{4.9999, 5.0, "%.4g mm;%.4g"}}},
              "heads 1 and 12 are 4.9999 mm apart, limit 5-150 mm",
              "Köpfe 1 und 12: 4.9999 mm, Grenze 5-150 mm");
  expect_told({kApart, {one, one + 1, NearLimit{5.0 - 1e-9, 5.0, "%.4g mm;%.4g"}}},
              "heads 1 and 2 are just under 5 mm apart, limit 5-150 mm",
              "Köpfe 1 und 2: knapp unter 5 mm, Grenze 5-150 mm");
  constexpr const char* kMoved = "tip moved %.1f mm, limit %.1f mm";
  expect_told({kMoved, {-0.1, 1e3}}, "tip moved -0.1 mm, limit 1000.0 mm",
              "Spitze um -0.1 mm verrutscht, Grenze 1000.0 mm");
  expect_told({kMoved, {3.0 + 1e-9, 3.0}, true}, "tip moved just over 3.0 mm, limit 3.0 mm",
              "Spitze um knapp über 3.0 mm verrutscht, Grenze 3.0 mm");
  expect_told({"%s: %s, such as \"%s\"",
               {std::string("tool lost"), "say how far", std::string("move cranial one")}},
              "tool lost: say how far, such as \"move cranial one\"",
              "tool lost: sagen, wie weit, etwa \"move cranial one\"");
  expect_told({"only %.0f %% lie on it", {5.0}}, "only 5 % lie on it", "nur 5 % liegen darauf");
  expect_told({"no such format", {}}, "no such format", "no such format");
}

TEST_F(Translated, ErrorsWithoutAReasonAreInQuotationMarks) {
  std::string out;
  append_error(out, Error{"tool lost"});
  EXPECT_EQ(out, "tool lost") << "nobody reads another language here";
  out.clear();
  const WearersLanguage language;
  append_error(out, Error{"tool lost"});
  EXPECT_EQ(out, "\"tool lost\"");
}

TEST(Conversions, AreThoseThatPrintSomething) {
  EXPECT_THAT(conversions_of("tip %.1f mm of %zu, 5 %% %s"), ElementsAre("%.1f", "%zu", "%s"));
  EXPECT_THAT(conversions_of("%-8.2f%02d"), ElementsAre("%-8.2f", "%02d"));
  EXPECT_THAT(conversions_of("nothing at 5 %%"), IsEmpty());
  EXPECT_THAT(conversions_of("ends with %"), ElementsAre("%"));
  EXPECT_THAT(conversions_of("5 % of"), ElementsAre("% o"));
}

}  // namespace
}  // namespace orthonav::translation_test
