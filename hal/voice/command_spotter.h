#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "hal/voice/command_evidence.h"
#include "hal/voice/command_weights.h"
#include "hal/voice/phrase_recognizer.h"
#include "hal/voice/speech_cleaner.h"
#include "hal/voice/speech_segments.h"

namespace orthonav::voice {

/// When a command needs the wake word before it.
enum class Waking {
  kAlways,   ///< every command needs it
  kInNoise,  ///< not needed if the voice stands out clearly from the background
  kNever     ///< no command needs it
};

struct SpotterOptions {
  std::vector<std::string> commands;  ///< lower case: "save", "move rod"
  std::string wake_word = "ortho";
  /// Single words still cause more than one false accept in ten minutes of talk, even in a silent
  /// room (docs/voice.md).
  Waking waking = Waking::kAlways;
  /// A room counts as quiet if the loudest syllable is this much above the background.
  double quiet_above_db = 26.0;
  /// The trained weights. A command without trained weights still works, with the strictest of the
  /// others' weights.
  EvidenceWeights weights = kTrainedWeights;
  /// A command counts above this (`log_odds`).
  double least_log_odds = 0.0;
  /// "delete" destroys data, "accept" and "start" are acted upon at once: they need more.
  double more_log_odds_to_decide = 1.0;
  SegmentOptions segments;
  CleanerOptions cleaner;
  std::filesystem::path acoustic_model = default_acoustic_model();

  /// The phrases of the commands' grammar: each with the wake word and alone, regardless of which
  /// count, since a grammar without single words would take "save" for "ortho save".
  [[nodiscard]] std::vector<std::string> phrases() const;
  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// Cleans a segment and recognises it; nothing if it contains no command.
[[nodiscard]] std::optional<CommandEvidence> evidence_in(const SpeechSegment& segment,
                                                         const SpotterOptions& options,
                                                         PhraseRecognizer& recognizer);

/// A command as it was spoken.
struct SpokenCommand {
  std::string text;         ///< one of the commands, without the wake word
  double confidence = 0.0;  ///< in [0, 1]; below 0.5, something else is more likely
  std::int64_t begin = 0;   ///< samples at `kSpeechRateHz` since the stream began
  std::int64_t end = 0;
};

/// Finds commands in a stream of sound: stretches of speech between two silences, short enough for
/// a command, cleaned and recognised. The same samples give the same commands, however they are
/// split into calls. One thread at a time.
class CommandSpotter {
 public:
  /// Refuses invalid options, a missing model, and words without a pronunciation.
  static Result<std::unique_ptr<CommandSpotter>> create(const SpotterOptions& options);
  /// Takes samples at `kSpeechRateHz` and appends the commands that ended in them; very unlikely
  /// ones are left out. Does up to 0.1 s of work a tenth of a second before a segment ends, so that
  /// almost none is left at its end.
  void push(std::span<const std::int16_t> samples, std::vector<SpokenCommand>& commands);

 private:
  SpotterOptions options_;
  SpeechSegmenter segmenter_;
  std::unique_ptr<PhraseRecognizer> recognizer_;
  std::vector<SpeechSegment> segments_;     // reused
  std::optional<SpokenCommand> candidate_;  ///< of a segment that may end soon

  explicit CommandSpotter(const SpotterOptions& options);
  [[nodiscard]] std::optional<SpokenCommand> judge(const SpeechSegment& segment);
  [[nodiscard]] double confidence_of(const CommandEvidence& evidence) const;
};

}  // namespace orthonav::voice
