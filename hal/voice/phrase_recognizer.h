#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

struct ps_decoder_s;

namespace orthonav::voice {

/// Where Debian's pocketsphinx-en-us puts its acoustic model.
[[nodiscard]] std::filesystem::path default_acoustic_model();

/// A word of a phrase.
struct RecognizedWord {
  std::string word;
  int frames = 0;  ///< of 10 ms
  /// How much better the word explains its stretch of sound than any other sounds: the natural
  /// logarithm of the likelihood ratio per 10 ms. Well below zero: something else was said.
  double evidence = 0.0;
};

/// The wake word and the command that a segment of speech, from one silence to the next, sounds
/// most like.
struct Recognition {
  std::vector<RecognizedWord> words;  ///< in their order; empty if none fits at all
  /// How much better silence explains the rest of the segment than other sounds: the natural
  /// logarithm of the likelihood ratio. Far below zero: more than the phrase was said.
  double evidence_around = 0.0;
};

/// Decides which command follows the wake word in a segment of speech: PocketSphinx with a grammar
/// of the commands, of usual answers and of phrases that begin like a command, compared with a
/// second grammar in which any sounds may follow one another. One thread at a time.
class PhraseRecognizer {
 public:
  /// Refuses a missing model, and commands with a word whose pronunciation is not known.
  static Result<std::unique_ptr<PhraseRecognizer>> create(const std::vector<std::string>& commands,
                                                          const std::string& wake_word,
                                                          const std::filesystem::path& model);
  /// Takes samples at `kSpeechRateHz`.
  [[nodiscard]] Recognition recognize(std::span<const std::int16_t> samples);

 private:
  struct Free {
    void operator()(ps_decoder_s* decoder) const;
  };
  /// A word or a single sound, and its frames.
  struct Part {
    std::string word;
    int first = 0;  ///< frame
    int last = 0;
    double score = 0.0;  ///< natural logarithm of its likelihood
  };
  std::unique_ptr<ps_decoder_s, Free> decoder_;
  std::string wake_word_;

  Status add_words();
  Status add_grammars(const std::vector<std::string>& commands);
  /// PocketSphinx's features of 10 ms of sound.
  using Cepstrum = std::array<float, 13>;
  std::vector<Part> decode(const char* search, std::vector<Cepstrum> cepstra);
  /// By PocketSphinx's front end; empty if there are too few samples.
  [[nodiscard]] std::vector<Cepstrum> cepstra_of(std::span<const std::int16_t> samples) const;
};

}  // namespace orthonav::voice
