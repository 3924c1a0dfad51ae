#include "hal/voice/command_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hal/voice/speech_segments.h"

namespace orthonav::voice {

namespace {

// In frames of 10 ms: a shorter word was hurried, or was another word; a longer wake word was drawn
// out.
constexpr double kHurried = 35.0;
constexpr double kDrawn = 60.0;
// With less evidence for silence around the words than this, more than a command was said. In a
// noisy room the noise counts against silence too.
constexpr double kLeastAroundInQuiet = -90.0;
constexpr double kLeastAroundInNoise = -300.0;
// A logistic regression over commands and other words of the tuning voices (docs/voice-lab.md).
// Likelihood ratios beyond these limits say no more.
constexpr double kLeastOver = -4.0;
constexpr double kMostOver = 3.0;
constexpr double kOverWeight = 1.92;
constexpr double kOddsWeight = 0.143;
constexpr double kNoisyWeight = 0.58;
constexpr double kLine = 0.47;

}  // namespace

std::optional<CommandEvidence> evidence_of(const Recognition& heard, const std::string& wake_word,
                                           double above_background_db) {
  CommandEvidence found;
  for (const RecognizedWord& word : heard.words) {
    if (word.word == wake_word) {
      found.wake = word;
      continue;
    }
    found.command += (found.command.empty() ? "" : " ") + word.word;
    found.evidence += word.frames * word.evidence;
    found.frames += word.frames;
  }
  const double least_around =
      std::lerp(kLeastAroundInQuiet, kLeastAroundInNoise, noisiness(above_background_db));
  if (found.frames == 0 || heard.evidence_around < least_around) {
    return std::nullopt;
  }
  found.evidence /= found.frames;
  found.evidence_around = heard.evidence_around;
  found.over_sounds = heard.evidence_over_sounds;
  found.above_background_db = above_background_db;
  return found;
}

EvidenceFeatures features_of(const CommandEvidence& evidence) {
  const double noisy = noisiness(evidence.above_background_db);
  const double frames = evidence.frames;
  const double wake_evidence = evidence.wake ? evidence.wake->evidence : 0.0;
  const double wake_frames = evidence.wake ? evidence.wake->frames : kHurried;
  return {
      1.0,
      evidence.evidence,
      wake_evidence,
      evidence.wake ? std::min(evidence.evidence, wake_evidence) : 0.0,
      std::clamp(evidence.evidence_around, -200.0, 50.0) / 50.0,
      noisy,
      noisy * evidence.evidence,
      noisy * wake_evidence,
      frames / 50.0,
      std::max(0.0, kHurried - frames) / 20.0,
      wake_frames / 50.0,
      std::max(0.0, kHurried - wake_frames) / 20.0,
      std::max(0.0, wake_frames - kDrawn) / 20.0,
  };
}

double log_odds(const CommandEvidence& evidence, const EvidenceWeights& weights) {
  const auto weight = evidence.wake ? &CommandWeight::after_wake_word : &CommandWeight::alone;
  const EvidenceFeatures& shared = evidence.wake ? weights.after_wake_word : weights.alone;
  const EvidenceFeatures features = features_of(evidence);
  const auto sum_from = [&](double own) {
    return std::inner_product(features.begin(), features.end(), shared.begin(), own);
  };
  const auto row = std::ranges::find(weights.commands, evidence.command, &CommandWeight::command);
  if (row != weights.commands.end()) {
    return sum_from((*row).*weight);
  }
  const auto lowest = std::ranges::min_element(weights.commands, {}, weight);
  return sum_from(0.0) + (lowest == weights.commands.end() ? 0.0 : (*lowest).*weight);
}

double log_odds_over_other_words(const CommandEvidence& evidence, double log_odds) {
  if (!evidence.wake) {
    return log_odds;
  }
  return kLine + kOddsWeight * log_odds +
         kOverWeight * std::clamp(evidence.over_sounds, kLeastOver, kMostOver) +
         kNoisyWeight * noisiness(evidence.above_background_db);
}

}  // namespace orthonav::voice
