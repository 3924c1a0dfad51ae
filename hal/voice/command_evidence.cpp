#include "hal/voice/command_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hal/voice/command_weights.h"
#include "hal/voice/speech_segments.h"

namespace orthonav::voice {

namespace {

// A wake word or a command shorter than this, in frames, is hurried, or is none.
constexpr double kHurried = 35.0;
constexpr double kDrawn = 60.0;
// Less evidence around the words than this, and they were not all that was said. Where it is noisy,
// the noise lies around them too.
constexpr double kLeastAroundInQuiet = -90.0;
constexpr double kLeastAroundInNoise = -300.0;

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
  found.above_background_db = above_background_db;
  return found;
}

FeatureVector features_of(const CommandEvidence& evidence) {
  FeatureVector features{};
  for (std::size_t i = 0; i < kWeighedCommands.size(); ++i) {
    features[i] = evidence.command == kWeighedCommands[i] ? 1.0 : 0.0;
  }
  const double noisy = noisiness(evidence.above_background_db);
  const double frames = evidence.frames;
  const double wake_evidence = evidence.wake ? evidence.wake->evidence : 0.0;
  const double wake_frames = evidence.wake ? evidence.wake->frames : kHurried;
  const std::array<double, kCommandFeatures> others = {
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
  std::copy(others.begin(), others.end(), features.begin() + kWeighedCommands.size());
  return features;
}

double log_odds(const CommandEvidence& evidence) {
  const FeatureVector& weights = evidence.wake ? kWeightsAfterWakeWord : kWeightsAlone;
  const FeatureVector features = features_of(evidence);
  const double sum = std::inner_product(features.begin(), features.end(), weights.begin(), 0.0);
  const auto* own = features.begin() + kWeighedCommands.size();
  if (std::find(features.begin(), own, 1.0) != own) {
    return sum;
  }
  return sum + *std::min_element(weights.begin(), weights.begin() + kWeighedCommands.size());
}

}  // namespace orthonav::voice
