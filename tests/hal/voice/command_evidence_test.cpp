#include "hal/voice/command_evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orthonav::voice {
namespace {

/// What "ortho save points" sounds like when it was said, at half a second each.
CommandEvidence likely() { return {"save points", -1.0, -1.5, 80, -1.0, 50, -10.0}; }

TEST(CommandEvidence, TakesTheWakeWordAndTheCommandApart) {
  const auto evidence =
      evidence_of({{{"ortho", 40, 0.5}, {"save", 20, 1.0}, {"points", 30, -0.5}}, -7.0}, "ortho");
  ASSERT_TRUE(evidence.has_value());
  EXPECT_EQ(evidence->command, "save points");
  EXPECT_EQ(evidence->frames, 50);
  EXPECT_NEAR(evidence->evidence, (20.0 * 1.0 - 30.0 * 0.5) / 50.0, 1e-12);
  EXPECT_EQ(evidence->least, -0.5);
  EXPECT_EQ(evidence->wake, 0.5);
  EXPECT_EQ(evidence->wake_frames, 40);
  EXPECT_EQ(evidence->around, -7.0);
}

TEST(CommandEvidence, NeedsTheWakeWordAndACommand) {
  EXPECT_FALSE(evidence_of({{{"ortho", 40, 2.0}}, 0.0}, "ortho").has_value());
  EXPECT_FALSE(evidence_of({{{"save", 40, 2.0}, {"points", 40, 2.0}}, 0.0}, "ortho").has_value());
  EXPECT_FALSE(evidence_of({}, "ortho").has_value());
}

TEST(CommandEvidence, CountsWhereItIsGoodAndNotWhereItIsBad) {
  EXPECT_GT(log_odds(likely()), 0.0);
  CommandEvidence poor = likely();
  poor.evidence = poor.least = -4.0;
  EXPECT_LT(log_odds(poor), 0.0) << "another word";
  poor = likely();
  poor.least = -12.0;
  poor.evidence = -2.5;
  EXPECT_LT(log_odds(poor), 0.0) << "one of its words was another";
  poor = likely();
  poor.wake = -6.0;
  EXPECT_LT(log_odds(poor), 0.0) << "another wake word";
  poor = likely();
  poor.wake_frames = 20;
  EXPECT_LT(log_odds(poor), 0.0) << "too short for the wake word";
  poor = likely();
  poor.around = -300.0;
  EXPECT_LT(log_odds(poor), 0.0) << "more was said";
  poor = likely();
  poor.evidence = -2.5;
  EXPECT_GT(log_odds(poor), 0.0);
  poor.frames = 40;
  EXPECT_LT(log_odds(poor), 0.0) << "a short command is likelier another word";
}

TEST(CommandEvidence, OfEveryKindSpeaksForTheCommand) {
  const double before = log_odds(likely());
  for (double CommandEvidence::*part :
       {&CommandEvidence::evidence, &CommandEvidence::least, &CommandEvidence::around}) {
    CommandEvidence better = likely();
    better.*part += 0.1;
    EXPECT_GT(log_odds(better), before);
  }
}

}  // namespace
}  // namespace orthonav::voice
