#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/voice/phrase_recognizer.h"

namespace orthonav::voice {

/// The evidence that a command was said: how well the recogniser's words fit a stretch of speech,
/// and how far it stands out from the background.
struct CommandEvidence {
  std::string command;
  double evidence = 0.0;  ///< mean of the command's own words, as `RecognizedWord::evidence`
  int frames = 0;         ///< of 10 ms, over all these words
  std::optional<RecognizedWord> wake;  ///< the wake word, if one preceded them
  double evidence_around = 0.0;        ///< `Recognition::evidence_around`
  double above_background_db = 0.0;    ///< of the loudest 50 ms
  double over_sounds = 0.0;            ///< `Recognition::evidence_over_sounds`
};

/// Separates the wake word from the command. Nothing if no command was heard, or if more than a
/// command was said.
[[nodiscard]] std::optional<CommandEvidence> evidence_of(const Recognition& heard,
                                                         const std::string& wake_word,
                                                         double above_background_db);

inline constexpr std::size_t kEvidenceFeatures = 13;
using EvidenceFeatures = std::array<double, kEvidenceFeatures>;

/// The features of which the log odds are a weighted sum, for any command; the first is the
/// constant 1.
[[nodiscard]] EvidenceFeatures features_of(const CommandEvidence& evidence);

/// The additional term of one command.
struct CommandWeight {
  std::string_view command;
  double after_wake_word = 0.0;
  double alone = 0.0;
};

/// The result of training (tools/voice/voice_weights.cpp): one logistic regression for commands
/// after the wake word and one for single words. `commands` borrows its rows.
struct EvidenceWeights {
  std::span<const CommandWeight> commands;
  EvidenceFeatures after_wake_word{};
  EvidenceFeatures alone{};
};

/// The natural logarithm of the odds that the command was said, up to a constant: at zero it counts
/// as said. A command without a row in `weights` gets the lowest weight of all rows, that of the
/// command most often heard by mistake.
[[nodiscard]] double log_odds(const CommandEvidence& evidence, const EvidenceWeights& weights);

/// The natural logarithm of the odds that this command and no other word followed the wake word, by
/// those odds and by how much better the command explains the sound than anything else: at zero it
/// counts as said. The odds themselves, if no wake word was heard.
[[nodiscard]] double log_odds_over_other_words(const CommandEvidence& evidence, double log_odds);

}  // namespace orthonav::voice
