#include "engine/session/workflow/commands.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/angle.h"
#include "engine/session/steps/replanning.h"

namespace orthonav::engine::spoken_replan_test {
namespace {

using nav::ScrewDirection;
using nav::ScrewPart;
using ::testing::HasSubstr;
using ::testing::Not;

/// What a phrase asks for, in words, or what is wrong with it, or nothing.
std::string heard(std::string_view phrase) {
  const auto replan = replan_from(phrase);
  if (!replan) {
    return "";
  }
  return *replan ? text_of(**replan) : "error: " + replan->error().message;
}

TEST(SpokenReplan, TakesASizeAsSurgeonsSayIt) {
  const auto said = replan_from("screw six forty five");
  ASSERT_TRUE(said && *said);
  const auto* size = std::get_if<SetScrewSize>(&**said);
  ASSERT_NE(size, nullptr);
  EXPECT_DOUBLE_EQ(*size->diameter_m, 0.006);
  EXPECT_DOUBLE_EQ(*size->length_m, 0.045);
  EXPECT_EQ(heard("screw five fifty"), "size 5.0 \u00d7 50 mm");
  EXPECT_EQ(heard("screw five fifty five"), "size 5.0 \u00d7 55 mm");
  EXPECT_EQ(heard("screw five five fifty"), "size 5.5 \u00d7 50 mm");
  EXPECT_EQ(heard("screw five five fifty five"), "size 5.5 \u00d7 55 mm");
  EXPECT_EQ(heard("screw six point five by forty millimetres"), "size 6.5 \u00d7 40 mm");
  EXPECT_EQ(heard("screw six and a half thirty"), "size 6.5 \u00d7 30 mm");
  EXPECT_EQ(heard("Screw 6.5 x 40 mm"), "size 6.5 \u00d7 40 mm") << "typed";
  EXPECT_EQ(heard("screw six mm forty mm"), "size 6.0 \u00d7 40 mm");
}

TEST(SpokenReplan, TakesOneNumberOfASizeAndTheNextOnes) {
  EXPECT_EQ(heard("diameter seven"), "diameter 7.0 mm");
  EXPECT_EQ(heard("diameter six point five mm"), "diameter 6.5 mm");
  EXPECT_EQ(heard("length forty five"), "length 45.0 mm");
  EXPECT_EQ(heard("longer"), "longer");
  EXPECT_EQ(heard("shorter"), "shorter");
  EXPECT_EQ(heard("thicker"), "thicker");
  EXPECT_EQ(heard("thinner"), "thinner");
}

TEST(SpokenReplan, TakesMovesAndTilts) {
  const auto moved = replan_from("move cranial one");
  ASSERT_TRUE(moved && *moved);
  EXPECT_EQ(**moved, Replan(MoveScrew{ScrewPart::kWhole, ScrewDirection::kCranial, 0.001}));
  EXPECT_EQ(heard("move medial two mm"), "move medial 2.0 mm");
  EXPECT_EQ(heard("entry lateral half"), "entry lateral 0.5 mm");
  EXPECT_EQ(heard("target caudal two and a half millimeters"), "target caudal 2.5 mm");
  const auto tilted = replan_from("tilt cranial two");
  ASSERT_TRUE(tilted && *tilted);
  EXPECT_NEAR(std::get<TiltScrew>(**tilted).by_rad, 2.0 * kRadiansPerDegree, 1e-15);
  EXPECT_EQ(heard("tilt medial 1.5 degrees"), "tilt medial 1.5\u00b0");
  EXPECT_EQ(heard("undo"), "undo");
}

TEST(SpokenReplan, RefusesWhatIsIncompleteOrNotUnderstoodInOneLine) {
  for (const char* phrase : {"screw",
                             "screw six",
                             "screw forty five",
                             "screw six forty five more",
                             "screw cranial one",
                             "screw -6 45",
                             "screw nan 45",
                             "screw 6 1e3",
                             "diameter",
                             "diameter big",
                             "length",
                             "length forty five degrees",
                             "move",
                             "move cranial",
                             "move one",
                             "move up one",
                             "move cranial one degree",
                             "move cranial minus one",
                             "move cranial zero",
                             "move cranial one two",
                             "entry",
                             "target medial",
                             "tilt",
                             "tilt cranial",
                             "tilt cranial two mm",
                             "tilt two",
                             "longer two",
                             "undo that"}) {
    const std::string problem = heard(phrase);
    EXPECT_THAT(problem, HasSubstr("error: ")) << phrase;
    EXPECT_THAT(problem, Not(HasSubstr("\n"))) << phrase;
  }
  EXPECT_EQ(heard("move cranial"), "error: move: say how far, such as \"move cranial one\"");
  EXPECT_EQ(heard("screw six"),
            "error: screw: say diameter and length, such as \"screw six forty five\"");
}

TEST(SpokenReplan, LeavesEverythingElseAlone) {
  for (const char* phrase : {"", " ", "hello", "the screw six forty five", "next", "cranial one"}) {
    EXPECT_FALSE(replan_from(phrase)) << phrase;
  }
  // "move rod" is a separate command, which the session checks first.
  EXPECT_EQ(command_event("move template"), Event::kSayMoveRod);
  EXPECT_EQ(command_event("move rod"), Event::kSayMoveRod) << "its name";
}

TEST(NumberWords, ReadsEveryNumberBelowAHundred) {
  const std::vector<std::string> ones = words_of(
      "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen "
      "fifteen sixteen seventeen eighteen nineteen");
  const std::vector<std::string> tens =
      words_of("twenty thirty forty fifty sixty seventy eighty ninety");
  for (int n = 0; n < 100; ++n) {
    std::string said =
        n < 20 ? ones[static_cast<std::size_t>(n)] : tens[static_cast<std::size_t>(n / 10 - 2)];
    said += n >= 20 && n % 10 != 0 ? " " + ones[static_cast<std::size_t>(n % 10)] : "";
    const auto words = words_of(said);
    NumberWords numbers(words);
    EXPECT_EQ(numbers.take(), static_cast<double>(n)) << said;
    EXPECT_TRUE(numbers.at_end()) << said;
  }
}

TEST(NumberWords, TakesNothingWhereThereIsNoNumber) {
  for (const char* said : {"", "hundred", "point", "-1", "1.2.3", "100", "inf", "."}) {
    const auto words = words_of(said);
    NumberWords numbers(words);
    EXPECT_FALSE(numbers.take()) << said;
    EXPECT_EQ(numbers.at_end(), words.empty()) << said;
  }
}

TEST(ReplanWording, EveryRefusalHasItsReasonInOneLine) {
  using enum ReplanRefusal::Kind;
  for (const auto kind :
       {kDrillSet, kDrilling, kNoScrewLeft, kNothingToUndo, kNoSuchSize, kLastSize, kNoDiameter,
        kNoDirections, kOffTheBone, kEntryTooFar, kTiltTooFar, kBreach}) {
    ReplanRefusal refusal{kind, -0.0013, 0.0, 0.006, 0.032, "medial"};
    std::string text;
    write(PartedText{text}, refusal);
    EXPECT_THAT(text, ::testing::StartsWith("screw not changed: ")) << text;
    EXPECT_GT(text.size(), std::string("screw not changed: ").size() + 8) << text;
    EXPECT_THAT(text, Not(HasSubstr("\n")));
  }
  std::string text;
  write(PartedText{text}, ReplanRefusal{kBreach, -0.0013, 0.0, 0.0, 0.0, "medial"});
  EXPECT_EQ(text,
            "screw not changed: breaks through the cortex: clearance -1.3 mm, limit 0.0 mm "
            "(medial): say accept result to take it");
}

TEST(ReplanWording, SaysHowAScrewDiffersFromItsPlanBeforeSurgery) {
  nav::ScrewDifference d;
  d.diameter_from_m = d.diameter_to_m = 0.006;
  d.length_from_m = d.length_to_m = 0.035;
  EXPECT_EQ(text_of(d), "no difference");
  d.entry_cranial_m = 0.001;
  d.entry_medial_m = -0.002;
  EXPECT_EQ(text_of(d), "entry moved 1.0 mm cranial and 2.0 mm lateral");
  d.entry_inward_m = 0.0004;
  EXPECT_EQ(text_of(d), "entry moved 1.0 mm cranial and 2.0 mm lateral") << "the surface's slope";
  d.entry_inward_m = 0.0021;
  d.entry_medial_m = 0.0;
  d.aim_medial_rad = 2.0 * kRadiansPerDegree;
  d.length_to_m = 0.0425;
  EXPECT_EQ(text_of(d),
            "entry moved 1.0 mm cranial and 2.1 mm deeper, aims 2.0\u00b0 more medial, "
            "6.0 \u00d7 42.5 mm instead of 6.0 \u00d7 35 mm");
}

}  // namespace
}  // namespace orthonav::engine::spoken_replan_test
