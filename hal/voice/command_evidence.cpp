#include "hal/voice/command_evidence.h"

#include <algorithm>

namespace orthonav::voice {

namespace {

// A logistic regression over phrases and other sayings of the tuning voices (docs/lab/voice.md).
// The longer a command fits the sound, the less likely it is that another word sounds like it.
constexpr double kConstant = 3.0;
constexpr double kEvidenceWeight = 1.5;
constexpr double kLeastWeight = 0.5;
constexpr double kAroundWeight = 0.0285;
constexpr double kFramesWeight = 0.044;
// Beyond these, likelihood ratios say no more.
constexpr double kLeastEvidence = -8.0;
constexpr double kLeastAround = -300.0;
constexpr double kMaxAround = 50.0;
// The wake words of all tuning voices lie above -4.6 and last longer than this: otherwise it was
// not said.
constexpr double kLeastWake = -5.5;
constexpr int kLeastWakeFrames = 24;
constexpr double kNotSaid = -100.0;

}  // namespace

std::optional<CommandEvidence> evidence_of(const Recognition& heard, const std::string& wake_word) {
  if (heard.words.size() < 2 || heard.words.front().word != wake_word) {
    return std::nullopt;
  }
  CommandEvidence found;
  found.wake = heard.words.front().evidence;
  found.wake_frames = heard.words.front().frames;
  found.around = heard.evidence_around;
  for (std::size_t i = 1; i < heard.words.size(); ++i) {
    const RecognizedWord& word = heard.words[i];
    found.command += (i > 1 ? " " : "") + word.word;
    found.evidence += word.frames * word.evidence;
    found.least = i > 1 ? std::min(found.least, word.evidence) : word.evidence;
    found.frames += word.frames;
  }
  found.evidence /= found.frames;
  return found;
}

double log_odds(const CommandEvidence& evidence) {
  if (evidence.wake < kLeastWake || evidence.wake_frames < kLeastWakeFrames) {
    return kNotSaid;
  }
  return kConstant + kEvidenceWeight * std::max(evidence.evidence, kLeastEvidence) +
         kLeastWeight * std::max(evidence.least, kLeastEvidence) +
         kAroundWeight * std::clamp(evidence.around, kLeastAround, kMaxAround) +
         kFramesWeight * evidence.frames;
}

}  // namespace orthonav::voice
