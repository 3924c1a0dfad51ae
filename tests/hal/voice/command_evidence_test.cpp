#include "hal/voice/command_evidence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/session/spoken_commands.h"
#include "hal/voice/command_weights.h"

namespace orthonav::voice {
namespace {

/// What "ortho save" sounds like when it was said, at half a second each.
CommandEvidence likely(const std::string& command = "save") {
  return {command, 0.6, 50, RecognizedWord{"ortho", 50, 0.4}, -10.0, 40.0};
}

double log_odds(const CommandEvidence& evidence) { return log_odds(evidence, kTrainedWeights); }

TEST(CommandEvidence, TakesTheWakeWordAndTheCommandApart) {
  const Recognition heard{{{"ortho", 40, 0.5}, {"move", 20, 1.0}, {"rod", 30, -0.5}}, -7.0};
  const auto evidence = evidence_of(heard, "ortho", 28.0);
  ASSERT_TRUE(evidence.has_value());
  EXPECT_EQ(evidence->command, "move rod");
  EXPECT_EQ(evidence->frames, 50);
  EXPECT_NEAR(evidence->evidence, (20.0 * 1.0 - 30.0 * 0.5) / 50.0, 1e-12);
  ASSERT_TRUE(evidence->wake.has_value());
  EXPECT_EQ(evidence->wake->frames, 40);
  EXPECT_EQ(evidence->evidence_around, -7.0);
  EXPECT_EQ(evidence->above_background_db, 28.0);
}

TEST(CommandEvidence, IsNoneOfTheWakeWordAloneNorOfNothing) {
  EXPECT_FALSE(evidence_of({{{"ortho", 40, 2.0}}, 0.0}, "ortho", 40.0).has_value());
  EXPECT_FALSE(evidence_of({}, "ortho", 40.0).has_value());
}

TEST(CommandEvidence, IsNoneWhereMoreWasSaid) {
  const std::vector<RecognizedWord> words = {{"ortho", 40, 0.5}, {"save", 40, 1.0}};
  EXPECT_TRUE(evidence_of({words, -60.0}, "ortho", 40.0).has_value());
  EXPECT_FALSE(evidence_of({words, -100.0}, "ortho", 40.0).has_value());
  EXPECT_TRUE(evidence_of({words, -100.0}, "ortho", 15.0).has_value()) << "it may be the noise";
  EXPECT_FALSE(evidence_of({words, -310.0}, "ortho", 15.0).has_value());
}

TEST(CommandEvidence, CountsWhereItIsGoodAndNotWhereItIsBad) {
  for (const std::string& command : engine::trained_commands()) {
    EXPECT_GT(log_odds(likely(command)), 0.0) << command;
    CommandEvidence poor = likely(command);
    poor.evidence = -2.5;
    EXPECT_LT(log_odds(poor), 0.0) << command << ": another word";
    poor = likely(command);
    poor.wake->evidence = -2.5;
    EXPECT_LT(log_odds(poor), 0.0) << command << ": another wake word";
  }
}

TEST(CommandEvidence, OfEveryKindSpeaksForTheCommand) {
  for (const double above_db : {18.0, 27.0, 50.0}) {
    CommandEvidence evidence = likely();
    evidence.above_background_db = above_db;
    const double before = log_odds(evidence);
    CommandEvidence better = evidence;
    better.evidence += 0.1;
    EXPECT_GT(log_odds(better), before);
    better = evidence;
    better.wake->evidence += 0.1;
    EXPECT_GT(log_odds(better), before);
    better = evidence;
    better.evidence_around += 5.0;
    EXPECT_GT(log_odds(better), before);
    CommandEvidence alone = evidence;
    alone.wake.reset();
    const double before_alone = log_odds(alone);
    EXPECT_LT(before_alone, before) << "a single word says less";
    alone.evidence += 0.1;
    EXPECT_GT(log_odds(alone), before_alone);
  }
}

TEST(CommandEvidence, OfAnotherWordOutweighsWhatIsLikelyOtherwise) {
  CommandEvidence evidence = likely();
  evidence.over_sounds = 0.5;
  EXPECT_GT(log_odds_over_other_words(evidence, 4.0), 0.0);
  evidence.over_sounds = -1.5;
  EXPECT_LT(log_odds_over_other_words(evidence, 4.0), 0.0);
  EXPECT_LT(log_odds_over_other_words(evidence, 9.0), 0.0) << "however well it fits by itself";
  evidence.wake.reset();
  EXPECT_EQ(log_odds_over_other_words(evidence, 4.0), 4.0) << "nothing was compared";
}

TEST(CommandEvidence, OfAHurriedWakeWordSaysLess) {
  CommandEvidence hurried = likely();
  hurried.wake->frames = 18;
  EXPECT_LT(log_odds(hurried), log_odds(likely()));
}

TEST(CommandEvidence, WasTrainedForEveryCommandOfTheWorkflow) {
  std::vector<std::string> trained;
  for (const CommandWeight& row : kTrainedWeights.commands) {
    trained.emplace_back(row.command);
  }
  EXPECT_THAT(trained, ::testing::UnorderedElementsAreArray(engine::trained_commands()))
      << "run tools/voice/train";
}

TEST(CommandEvidence, OfAnUnweighedCommandIsTakenForTheWorst) {
  double worst = 1e9;
  for (const std::string& command : engine::trained_commands()) {
    worst = std::min(worst, log_odds(likely(command)));
  }
  EXPECT_NEAR(log_odds(likely("zoom")), worst, 1e-9);
}

TEST(CommandEvidence, IsWeighedByTheRowOfItsCommand) {
  const std::array<CommandWeight, 2> rows = {{{"save", 2.0, -3.0}, {"zoom", 5.0, 7.0}}};
  const EvidenceWeights weights = {rows, {1.0}, {-1.0}};
  CommandEvidence evidence = likely("zoom");
  EXPECT_EQ(log_odds(evidence, weights), 6.0);
  EXPECT_EQ(log_odds(likely("start"), weights), 3.0) << "the lowest row's";
  evidence.wake.reset();
  EXPECT_EQ(log_odds(evidence, weights), 6.0);
}

TEST(CommandEvidence, WithoutAnyRowIsWeighedByWhatIsShared) {
  EXPECT_EQ(log_odds(likely(), EvidenceWeights{{}, {1.5}, {}}), 1.5);
}

}  // namespace
}  // namespace orthonav::voice
