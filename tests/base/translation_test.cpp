#include "base/translation.h"

#include <gmock/gmock.h>

#include "base/printed.h"
#include "tests/support/language_in_use.h"

namespace orthonav::translation_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class Translated : public ::testing::Test {
 protected:
  static std::string retold(std::string_view english) {
    std::string out;
    append_retold(out, english);
    return out;
  }

  test::LanguageInUse in_use_{std::vector<Translation::Entry>{
      {"tool lost", "Werkzeug verloren"},
      {"tip moved %.1f mm, limit %.1f mm", "Spitze um %.1f mm verrutscht, Grenze %.1f mm"},
      {"just over", "knapp über"},
      {"just under", "knapp unter"},
      {"heads %zu and %zu are %s apart, limit 5-150 mm", "Köpfe %zu und %zu: %s, Grenze 5-150 mm"},
      {"%s: %s, such as \"%s\"", "%s: %s, etwa \"%s\""},
      {"%s: stands alone", "%s: steht allein"},
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
  EXPECT_EQ(retold("move: stands alone"), "move: stands alone");
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

TEST_F(Translated, RetellsWhatWasPrintedElsewhere) {
  const WearersLanguage language;
  EXPECT_EQ(retold("heads 1 and 12 are 4.9999 mm apart, limit 5-150 mm"),
            "Köpfe 1 und 12: 4.9999 mm, Grenze 5-150 mm");
  EXPECT_EQ(retold("heads 1 and 2 are just under 5 mm apart, limit 5-150 mm"),
            "Köpfe 1 und 2: knapp unter 5 mm, Grenze 5-150 mm");
  EXPECT_EQ(retold("tip moved -0.1 mm, limit 1e+03 mm"),
            "Spitze um -0.1 mm verrutscht, Grenze 1e+03 mm");
  EXPECT_EQ(retold("tip moved just over 3.0 mm, limit inf mm"),
            "Spitze um knapp über 3.0 mm verrutscht, Grenze inf mm");
  EXPECT_EQ(retold("move: say how far, such as \"move cranial one\""),
            "move: sagen, wie weit, etwa \"move cranial one\"");
  EXPECT_EQ(retold("undo: stands alone"), "undo: steht allein");
  EXPECT_EQ(retold("only 5 % lie on it"), "nur 5 % liegen darauf");
}

TEST_F(Translated, PutsWhatItDoesNotKnowInQuotationMarks) {
  const WearersLanguage language;
  EXPECT_EQ(retold("no such format"), "\"no such format\"");
  EXPECT_EQ(retold("tip moved x mm, limit 3.0 mm"), "\"tip moved x mm, limit 3.0 mm\"");
  EXPECT_EQ(retold("tip moved 1.0 mm, limit 3.0 mm and more"),
            "\"tip moved 1.0 mm, limit 3.0 mm and more\"");
  EXPECT_EQ(retold("tip moved"), "\"tip moved\"");
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
