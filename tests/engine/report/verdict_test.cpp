#include "engine/report/verdict.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/report/screws_section.h"

namespace orthonav::engine::verdict_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A screw that went well: 1.5°, 1.0 mm, 2.9 mm of bone around it.
json good_screw(const char* side) {
  return json::parse(R"({"done":true,"angle_error_deg":1.5,"entry_error_mm":1.0,"clearance_mm":2.9,
    "grade":"A","planned":{"diameter_mm":6.5,"length_mm":40.0,"clearance_mm":3.9,"grade":"A"},
    "tracked":{"clearance_mm":2.0,"clearance_95_mm":0.4,"grade":"A"},
    "executed":{"depth_mm":11.2},
    "wire":{"angle_deg":1.2,"angle_sd_deg":0.5,"entry_mm":0.9,"entry_sd_mm":0.6,"within":true,
            "kept":false},"side":")" +
                     std::string(side) + "\"}");
}

json report_of(json left, json right) {
  return {{"completed", true},
          {"seed", 1},
          {"levels", {{{"label", "L5"}, {"screws", {std::move(left), std::move(right)}}}}}};
}

TEST(Verdict, SaysInOneLineHowItEndedAndAgainstWhat) {
  const Verdict verdict = verdict_of(report_of(good_screw("left"), good_screw("right")));
  EXPECT_EQ(verdict.kind, Verdict::Kind::kDone);
  EXPECT_EQ(verdict.line,
            "Operation completed: 2 of 2 screws placed; 2 of 2 within 2 mm and 5° of the plan, "
            "against the simulation’s truth.");
  EXPECT_THAT(verdict.warnings, IsEmpty());
}

TEST(Verdict, CountsAScrewOnTargetUpToTheLimitsAndNoFarther) {
  for (const auto& [key, limit] : {std::pair("angle_error_deg", 5.0), {"entry_error_mm", 2.0}}) {
    json screw = good_screw("left");
    screw[key] = limit - 1e-9;
    EXPECT_TRUE(is_on_target(screw)) << key;
    screw[key] = limit + 1e-9;
    EXPECT_FALSE(is_on_target(screw)) << key;
    screw.erase(key);
    EXPECT_FALSE(is_on_target(screw)) << key << ": what is not known is not good";
  }
}

TEST(Verdict, TellsAnErrorFromTheLimitThatItRoundsTo) {
  json left = good_screw("left");
  left["entry_error_mm"] = 2.01;
  const json report = report_of(left, good_screw("right"));
  EXPECT_THAT(verdict_of(report).warnings, ElementsAre(HasSubstr("1.5° and 2.01 mm from")));
  EXPECT_THAT(screws_section(report), HasSubstr(">2.01</td>"));
}

TEST(Verdict, PutsTheGravestWarningFirst) {
  json left = good_screw("left");
  left["wire"]["within"] = false;
  left["wire"]["kept"] = true;
  left["wire"]["angle_deg"] = 3.62;
  left["tracked"]["clearance_95_mm"] = -0.26;
  left["planned"]["accepted_breach"] = "narrow pedicle";
  json right = good_screw("right");
  right["entry_error_mm"] = 2.44;
  right["clearance_mm"] = -0.31;
  right["grade"] = "B";
  const Verdict verdict = verdict_of(report_of(left, right));
  EXPECT_EQ(verdict.kind, Verdict::Kind::kDoneWithWarnings);
  EXPECT_EQ(verdict.line,
            "Operation completed with 4 warnings: 2 of 2 screws placed; 1 of 2 within 2 mm and 5° "
            "of the plan, against the simulation’s truth.");
  EXPECT_THAT(
      verdict.warnings,
      ElementsAre(
          "L5 right: breached the cortex by 0.3 mm (grade B); 1.5° and 2.4 mm from the "
          "plan, against the simulation’s truth",
          "L5 left: the trajectory was measured 3.6° and 0.9 mm from the plan, beyond a limit, "
          "and kept",
          "L5 left: as tracked, a breach of the cortex cannot be ruled out (95 % bound "
          "−0.3 mm)",
          "L5 left: planned to leave the cortex: narrow pedicle"));
}

TEST(Verdict, SaysOnceWhatItSaysOfSeveralScrews) {
  json left = good_screw("left");
  json right = good_screw("right");
  left["tracked"]["clearance_95_mm"] = -0.26;
  right["tracked"]["clearance_95_mm"] = -1.0;
  EXPECT_THAT(verdict_of(report_of(left, right)).warnings,
              ElementsAre("L5 left, L5 right: as tracked, a breach of the cortex cannot be ruled "
                          "out (95 % bound −0.3, −1.0 mm)"));
}

TEST(Verdict, ClaimsNothingWithoutATruth) {
  json left = good_screw("left");
  json right = good_screw("right");
  for (json* screw : {&left, &right}) {
    for (const char* key : {"angle_error_deg", "entry_error_mm", "clearance_mm", "grade"}) {
      screw->erase(key);
    }
  }
  right["wire"] = "not measured";
  const Verdict verdict = verdict_of(report_of(left, right));
  EXPECT_EQ(verdict.line,
            "Operation completed with 1 warning: 2 of 2 screws placed; their true distance from "
            "the plan is unknown; 1 of 1 measured within the limits.");
  EXPECT_THAT(verdict.warnings, ElementsAre("L5 right: the trajectory was not measured"));
  EXPECT_THAT(verdict.line, Not(HasSubstr("truth")));
  const std::string table = screws_section(report_of(left, right));
  EXPECT_THAT(table, AllOf(HasSubstr("Errors against the truth are unknown here."),
                           HasSubstr(">2.0 A <small>as tracked</small></td>")));
}

TEST(Verdict, SaysWhyAnOperationIsIncompleteAndCountsWhatWasPlaced) {
  json report = report_of(good_screw("left"), {{"side", "right"}, {"done", false}});
  report["completed"] = false;
  report["why_not"] = "ended at guide of L5";
  const Verdict verdict = verdict_of(report);
  EXPECT_EQ(verdict.kind, Verdict::Kind::kIncomplete);
  EXPECT_EQ(verdict.line,
            "Operation incomplete (ended at guide of L5): 1 of 2 screws placed; 1 of 1 within 2 mm "
            "and 5° of the plan, against the simulation’s truth.");
  report["levels"][0]["screws"][0] = {{"side", "left"}, {"done", false}};
  EXPECT_EQ(verdict_of(report).line,
            "Operation incomplete (ended at guide of L5): 0 of 2 screws placed.");
}

TEST(Verdict, SaysOfHowManyPlacedScrewsTheTruthIsKnown) {
  json right = good_screw("right");
  right.erase("angle_error_deg");
  right.erase("entry_error_mm");
  EXPECT_THAT(verdict_of(report_of(good_screw("left"), right)).line,
              HasSubstr("2 of 2 screws placed; 1 of 1 measured within 2 mm and 5°"));
  json missed = good_screw("right");
  missed.erase("entry_error_mm");
  const Verdict verdict = verdict_of(report_of(good_screw("left"), missed));
  EXPECT_THAT(verdict.line, HasSubstr("1 of 2 within 2 mm and 5°"));
  EXPECT_THAT(verdict.warnings, ElementsAre(HasSubstr("L5 right: the trajectory missed the bone")));
}

TEST(ScrewsSection, HasThePlannedSizeAndWhatBecameOfEachScrew) {
  json right = good_screw("right");
  right["angle_error_deg"] = 5.4;
  right["clearance_mm"] = -0.3;
  right["grade"] = "B";
  right["planned"].erase("diameter_mm");
  const std::string html = screws_section(report_of(good_screw("left"), right));
  EXPECT_THAT(html, HasSubstr("<th scope=row>L5 left</th><td data-label=\"planned size "
                              "[mm]\">6.5\u00a0×\u00a040</td>"));
  EXPECT_THAT(html, HasSubstr(">11.2</td>"));
  EXPECT_THAT(html, HasSubstr(">2.9 A</td>"));
  EXPECT_THAT(html, HasSubstr(">1.2 ± 0.5°, 0.9 ± 0.6 mm</td>"));
  EXPECT_THAT(html, HasSubstr(">not stated</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=bad data-label=\"angle error [°]\">5.4"));
  EXPECT_THAT(html, HasSubstr("<td class=bad data-label=\"clearance, grade [mm]\">−0.3 B</td>"));
  const json open{{"side", "left"}, {"done", false}};
  EXPECT_THAT(screws_section(report_of(open, right)),
              HasSubstr("L5 left <small>not placed</small>"));
}

}  // namespace
}  // namespace orthonav::engine::verdict_test
