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
#include "hal/voice/phrase_recognizer.h"
#include "hal/voice/speech_cleaner.h"
#include "hal/voice/speech_segments.h"

namespace orthonav::voice {

struct SpotterOptions {
  std::vector<std::string> commands;  ///< lower case
  /// Natural logarithm of the odds from which on a command counts: twelve to one. At three to one
  /// twice as many other words pass, and 4 % more commands are heard (docs/lab/voice.md).
  double least_log_odds = 2.5;
  std::filesystem::path acoustic_model = default_acoustic_model();

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A command as it was spoken.
struct SpokenCommand {
  std::string text;         ///< one of the commands, without the wake word
  double confidence = 0.0;  ///< in [0, 1]; below 0.5 it does not count
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
  /// Takes samples at `kSpeechRateHz` and appends the commands that ended in them, without those
  /// that are less likely than not. Does up to 0.1 s of work a tenth of a second before a segment
  /// ends, so that almost none is left at its end.
  void push(std::span<const std::int16_t> samples, std::vector<SpokenCommand>& commands);

 private:
  SpotterOptions options_;
  SpeechSegmenter segmenter_;
  std::unique_ptr<PhraseRecognizer> recognizer_;
  std::vector<SpeechSegment> segments_;     // reused
  std::optional<SpokenCommand> candidate_;  ///< of a segment that may end soon

  explicit CommandSpotter(const SpotterOptions& options);
  [[nodiscard]] std::optional<SpokenCommand> judge(const SpeechSegment& segment);
};

}  // namespace orthonav::voice
