#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/voice/phrase_recognizer.h"

namespace orthonav::voice {

/// What speaks for a command having been said: how well the recogniser's words fit a stretch of
/// speech, and how far it stands out from the background.
struct CommandEvidence {
  std::string command;
  double evidence = 0.0;  ///< mean of the command's own words, as `RecognizedWord::evidence`
  int frames = 0;         ///< of 10 ms, that these words take
  std::optional<RecognizedWord> wake;  ///< the wake word, where one came before them
  double evidence_around = 0.0;        ///< `Recognition::evidence_around`
  double above_background_db = 0.0;    ///< of the loudest 50 ms
};

/// Separates the wake word from the command. Nothing where no command was heard, or where more
/// than a command was said.
[[nodiscard]] std::optional<CommandEvidence> evidence_of(const Recognition& heard,
                                                         const std::string& wake_word,
                                                         double above_background_db);

inline constexpr std::size_t kEvidenceFeatures = 13;
using EvidenceFeatures = std::array<double, kEvidenceFeatures>;

/// What the log odds are a weighted sum of, whichever command it is; the first is the constant 1.
[[nodiscard]] EvidenceFeatures features_of(const CommandEvidence& evidence);

/// What one command adds to the sum by itself.
struct CommandWeight {
  std::string_view command;
  double after_wake_word = 0.0;
  double alone = 0.0;
};

/// What training found (tools/voice/voice_weights.cpp): one logistic regression for commands after
/// the wake word and one for single words. The vocabulary is its own: `commands` borrows its rows.
struct EvidenceWeights {
  std::span<const CommandWeight> commands;
  EvidenceFeatures after_wake_word{};
  EvidenceFeatures alone{};
};

/// The natural logarithm of the odds that the command was said, up to a constant: at zero it counts
/// as said. A command without a row in `weights` gets the lowest weight of all rows, that of the
/// command most often heard by mistake.
[[nodiscard]] double log_odds(const CommandEvidence& evidence, const EvidenceWeights& weights);

}  // namespace orthonav::voice
