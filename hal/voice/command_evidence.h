#pragma once

#include <array>
#include <optional>
#include <string>

#include "hal/voice/phrase_recognizer.h"

namespace orthonav::voice {

/// What speaks for a command having been said: what the recogniser answered of a stretch of speech,
/// and how that stood out of the room.
struct CommandEvidence {
  std::string command;
  double evidence = 0.0;  ///< of the command's own words, as `RecognizedWord::evidence`
  int frames = 0;         ///< of 10 ms, of these
  std::optional<RecognizedWord> wake;  ///< before them
  double evidence_around = 0.0;        ///< `Recognition::evidence_around`
  double above_background_db = 0.0;    ///< the loudest 50 ms
};

/// What the recogniser heard, taken apart; nothing where that is no command, or not all that was
/// said.
[[nodiscard]] std::optional<CommandEvidence> evidence_of(const Recognition& heard,
                                                         const std::string& wake_word,
                                                         double above_background_db);

/// What odds are a weighted sum of: a command of its own each, and these.
inline constexpr std::array kWeighedCommands = {"start", "save", "delete",   "accept", "reject",
                                                "next",  "done", "move rod", "twin"};
inline constexpr std::size_t kCommandFeatures = 13;
using FeatureVector = std::array<double, kWeighedCommands.size() + kCommandFeatures>;

/// A command that is not among the weighed ones has none of its own.
[[nodiscard]] FeatureVector features_of(const CommandEvidence& evidence);

/// The natural logarithm of the odds that the command was said, up to a constant: zero is where the
/// product draws the line. Logistic regression (voice_weights), one for commands after the wake
/// word and one for those alone; a command that is not among the weighed ones is taken for the one
/// that is most often said by mistake.
[[nodiscard]] double log_odds(const CommandEvidence& evidence);

}  // namespace orthonav::voice
