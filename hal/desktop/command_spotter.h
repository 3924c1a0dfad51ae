#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/api/result.h"
#include "hal/desktop/phrase_recognizer.h"
#include "hal/desktop/speech_cleaner.h"
#include "hal/desktop/speech_segments.h"

namespace orthonav::desktop {

/// When a command counts without the wake word before it.
enum class Waking {
  kAlways,   ///< never: every command needs the wake word
  kInNoise,  ///< where the voice stands out clearly from the background
  kNever     ///< always
};

struct SpotterOptions {
  std::vector<std::string> commands;  ///< lower case: "save", "move rod"
  std::string wake_word = "ortho";
  /// Single words do not reach one false accept in ten minutes of talk, even in a silent room
  /// (docs/voice.md).
  Waking waking = Waking::kAlways;
  /// A room is quiet where the loudest syllable stands out by so much.
  double quiet_above_db = 26.0;
  /// What a command's own words need in evidence (`RecognizedWord::evidence`) to count; chosen on
  /// voices and texts of their own (bench_voice --tuning). "delete" needs the most: it takes away.
  std::map<std::string, double> least_evidence = {
      {"start", -1.3}, {"accept", -1.1}, {"next", -1.5},    {"twin", -0.9},  {"done", -1.1},
      {"save", -0.8},  {"reject", -0.8}, {"move rod", 0.0}, {"delete", 0.0},
  };
  double least_evidence_of_others = 0.0;
  /// What the wake word needs, where the voice stands out by 35 dB and where by 20 dB; between them
  /// what lies between. Before "delete" it needs more.
  double least_evidence_of_wake_word = -0.7;
  double least_evidence_of_wake_word_in_noise = -1.2;
  double more_wake_evidence_to_delete = 0.4;
  double least_evidence_around = -90.0;  ///< `Recognition::evidence_around`
  /// What a command needs more where it is not addressed by the wake word.
  double more_evidence_alone = 1.2;
  SegmentOptions segments;
  CleanerOptions cleaner;
  std::filesystem::path acoustic_model = default_acoustic_model();

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

/// A command as it was spoken.
struct SpokenCommand {
  std::string text;         ///< one of the commands, without the wake word
  double confidence = 0.0;  ///< in [0, 1]; below 0.5 it rather was something else
  std::int64_t begin = 0;   ///< samples at `kSpeechRateHz` since the stream began
  std::int64_t end = 0;
};

/// Finds commands in a stream of sound: stretches of speech between two silences, short enough for
/// a command, cleaned and recognised. The same samples give the same commands, however they are cut
/// into calls. One thread at a time.
class CommandSpotter {
 public:
  /// Refuses options with problems, a model that is not there, and words without a pronunciation.
  static Result<std::unique_ptr<CommandSpotter>> create(const SpotterOptions& options);
  /// Takes samples at `kSpeechRateHz` and appends the commands that ended in them; those that are
  /// hardly likely are left out. Takes up to 0.1 s of work a tenth of a second before a segment
  /// ends, so that next to none is left where it ends.
  void push(std::span<const std::int16_t> samples, std::vector<SpokenCommand>& commands);

 private:
  SpotterOptions options_;
  SpeechSegmenter segmenter_;
  std::unique_ptr<PhraseRecognizer> recognizer_;
  std::vector<SpeechSegment> segments_;     // reused
  std::optional<SpokenCommand> candidate_;  ///< of a segment that may end soon

  explicit CommandSpotter(const SpotterOptions& options);
  [[nodiscard]] std::optional<SpokenCommand> judge(const SpeechSegment& segment);
  [[nodiscard]] double confidence_of(const std::string& command, double evidence,
                                     std::optional<double> wake_evidence,
                                     double above_background_db) const;
};

}  // namespace orthonav::desktop
