#pragma once

#include <optional>
#include <string>

#include "hal/voice/phrase_recognizer.h"

namespace orthonav::voice {

/// The evidence that a command was said after the wake word. Likelihood ratios are natural
/// logarithms, per 10 ms where nothing else is said.
struct CommandEvidence {
  std::string command;
  double evidence = 0.0;  ///< mean over the command, as `RecognizedWord::evidence`
  double least = 0.0;     ///< of its words
  int frames = 0;         ///< of 10 ms, over all its words
  double wake = 0.0;      ///< of the wake word
  int wake_frames = 0;    ///< of 10 ms
  double around = 0.0;    ///< `Recognition::evidence_around`
};

/// Takes the wake word and the command apart; nothing unless both were heard.
[[nodiscard]] std::optional<CommandEvidence> evidence_of(const Recognition& heard,
                                                         const std::string& wake_word);

/// The natural logarithm of the odds that this command was said, and nothing else: at zero it is as
/// likely as not. What counts as said: `SpotterOptions::least_log_odds`.
[[nodiscard]] double log_odds(const CommandEvidence& evidence);

}  // namespace orthonav::voice
